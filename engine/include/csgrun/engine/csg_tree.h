// The CSG tree: an immutable DAG of leaves, transforms, appearances and Booleans.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <csgrun/engine/error.h>
#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

/// Affine map x -> m[.][0..2] x + m[.][3], row-major, millimetres.
struct Affine {
  std::array<std::array<double, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  /// The map that applies `inner` first, then `outer`.
  static Affine compose(const Affine& outer, const Affine& inner);
  [[nodiscard]] glm::dvec3 apply(const glm::dvec3& p) const;
  bool operator==(const Affine&) const = default;
};

enum class BooleanOp : uint8_t { kUnion, kIntersection, kDifference, kSymmetricDifference };

/// The outer hull of a surface (Campen & Kobbelt 2010, section 6.2): all that cannot be reached
/// from infinity without crossing the surface.
struct OuterHull {
  /// Crossings from the back of the surface to its front are free: a body splits where it is
  /// thinner than nothing.
  bool orientation_sensitive = false;
  /// Enclosed places whose winding number says that they are outside stay empty; else they are
  /// filled.
  bool keep_voids = false;
  bool operator==(const OuterHull&) const = default;
};

enum class NodeKind : uint8_t { kEmpty, kLeaf, kTransform, kAppearance, kBoolean, kOuterHull };

class Node;
using NodePtr = std::shared_ptr<const Node>;

/// One node of the DAG. Immutable; shared freely; thread-safe. Freeing a chain of 100,000 nodes
/// uses constant stack.
class Node {
 public:
  [[nodiscard]] NodeKind kind() const { return kind_; }
  [[nodiscard]] BooleanOp op() const { return op_; }
  [[nodiscard]] const std::vector<NodePtr>& children() const { return children_; }
  [[nodiscard]] const Affine& transform() const { return *transform_; }
  [[nodiscard]] const Appearance& appearance() const { return *appearance_; }
  /// Of a kOuterHull.
  [[nodiscard]] const OuterHull& outer_hull() const { return outer_hull_; }
  [[nodiscard]] const std::shared_ptr<const PolygonMesh>& mesh() const { return mesh_; }
  [[nodiscard]] const SourceRef& where() const { return where_; }

  /// A solid without points. It still counts as an operand: empty minus a cube is empty.
  static NodePtr empty(SourceRef where = {});
  /// A leaf. The mesh must be closed and oriented (see validate_mesh).
  static NodePtr leaf(std::shared_ptr<const PolygonMesh> mesh, SourceRef where = {});
  static NodePtr transformed(const Affine& map, NodePtr child, SourceRef where = {});
  /// Gives every face of the child this appearance; the outermost one wins.
  static NodePtr painted(const Appearance& appearance, NodePtr child, SourceRef where = {});
  /// Union, intersection or symmetric difference of any number of operands; the difference is the
  /// first less all others. No operand: empty.
  static NodePtr boolean(BooleanOp op, std::vector<NodePtr> operands, SourceRef where = {});
  /// The outer hull of a surface: of the mesh itself, as it crosses itself, when the child is a
  /// leaf under transforms and appearances; else of the boundary of the child's solid.
  static NodePtr outer_hull(const OuterHull& options, NodePtr child, SourceRef where = {});

  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

 private:
  Node() = default;
  NodeKind kind_ = NodeKind::kEmpty;
  BooleanOp op_ = BooleanOp::kUnion;
  OuterHull outer_hull_;
  std::vector<NodePtr> children_;
  std::unique_ptr<Affine> transform_;
  std::unique_ptr<Appearance> appearance_;
  std::shared_ptr<const PolygonMesh> mesh_;
  SourceRef where_;
};

}  // namespace csgrun

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

/// What is made of solids that are evaluated for it. The normal form has leaves and transforms in
/// its place.
enum class Construction : uint8_t { kConvexHull, kMinkowskiSum, kResize };

/// New lengths of a bounding box, along each axis.
struct Resize {
  std::array<double, 3> size{0, 0, 0};  ///< mm; 0: the length stays
  /// Where `size` is 0: scaled as along the axis of the largest `size`.
  std::array<bool, 3> automatic{false, false, false};
  bool operator==(const Resize&) const = default;
};

enum class NodeKind : uint8_t {
  kEmpty,
  kLeaf,
  kTransform,
  kAppearance,
  kBoolean,
  kOuterHull,
  kConstruction
};

class Node;
using NodePtr = std::shared_ptr<const Node>;

/// One node of the DAG. Immutable; shared freely; thread-safe. Freeing a chain of 100,000 nodes
/// uses constant stack.
class Node {
 public:
  [[nodiscard]] NodeKind kind() const { return kind_; }
  [[nodiscard]] BooleanOp op() const { return op_; }
  [[nodiscard]] const std::vector<NodePtr>& children() const { return children_; }
  /// Of an intersection_as: the tree that is evaluated in its place; else null.
  [[nodiscard]] const NodePtr& same_solid() const { return same_solid_; }
  /// Of a difference_as: the leaf; else null.
  [[nodiscard]] const NodePtr& rounded_leaf() const { return rounded_leaf_; }
  [[nodiscard]] const Affine& transform() const { return *transform_; }
  [[nodiscard]] const Appearance& appearance() const { return *appearance_; }
  /// Of a kOuterHull.
  [[nodiscard]] const OuterHull& outer_hull() const { return outer_hull_; }
  /// Of a kConstruction.
  [[nodiscard]] Construction construction() const { return construction_; }
  /// Of a Construction::kResize.
  [[nodiscard]] const Resize& resize() const { return *resize_; }
  /// Whether it or a node below it that is evaluated is a construction.
  [[nodiscard]] bool has_constructions() const { return has_constructions_; }
  /// The same of Minkowski sums.
  [[nodiscard]] bool has_sums() const { return has_sums_; }
  [[nodiscard]] const std::shared_ptr<const PolygonMesh>& mesh() const { return mesh_; }
  [[nodiscard]] const SourceRef& where() const { return where_; }

  /// A solid without points. It still counts as an operand: empty minus a cube is empty.
  static NodePtr empty(SourceRef where = {});
  /// A leaf. The mesh must be closed and oriented (see check_mesh).
  static NodePtr leaf(std::shared_ptr<const PolygonMesh> mesh, SourceRef where = {});
  static NodePtr transformed(const Affine& map, NodePtr child, SourceRef where = {});
  /// Gives every face of the child this appearance; the outermost one wins.
  static NodePtr painted(const Appearance& appearance, NodePtr child, SourceRef where = {});
  /// Union, intersection or symmetric difference of any number of operands; the difference is the
  /// first less all others. No operand: empty.
  static NodePtr boolean(BooleanOp op, std::vector<NodePtr> operands, SourceRef where = {});
  /// An intersection whose faces and labels another tree has as well, one that is smaller: that is
  /// evaluated in its place. Who asks a tree for its colours sees the operands.
  static NodePtr intersection_as(std::vector<NodePtr> operands, NodePtr same, SourceRef where = {});
  /// A difference whose solid is, but for rounding to the grid, that of a leaf: hulls, Minkowski
  /// sums and lengths for resized, for which corners are rounded in any case, are made of the leaf.
  static NodePtr difference_as(std::vector<NodePtr> operands, NodePtr leaf, SourceRef where = {});
  /// The outer hull of a surface: of the mesh itself, as it crosses itself, when the child is a
  /// leaf under transforms and appearances; else of the boundary of the child's solid.
  static NodePtr outer_hull(const OuterHull& options, NodePtr child, SourceRef where = {});
  /// The least convex solid that holds all operands. Vertices of leaves count as they are on the
  /// grid; corners that Booleans made are rounded to it, with a note. Points in one plane give the
  /// empty solid, with a note. Its appearance is that of the first operand.
  static NodePtr convex_hull(std::vector<NodePtr> operands, SourceRef where = {});
  /// All sums of a point of each operand; empty operands do not count. Rounding, notes and
  /// appearance are those of convex_hull.
  static NodePtr minkowski_sum(std::vector<NodePtr> operands, SourceRef where = {});
  /// Scaled about the origin so that its bounding box has the lengths asked for.
  static NodePtr resized(const Resize& resize, NodePtr child, SourceRef where = {});

  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

 private:
  Node() = default;
  static std::shared_ptr<Node> made(NodeKind kind, std::vector<NodePtr> children, SourceRef where);

  NodeKind kind_ = NodeKind::kEmpty;
  BooleanOp op_ = BooleanOp::kUnion;
  Construction construction_ = Construction::kConvexHull;
  bool has_constructions_ = false;
  bool has_sums_ = false;
  OuterHull outer_hull_;
  std::vector<NodePtr> children_;
  NodePtr same_solid_, rounded_leaf_;
  std::unique_ptr<Affine> transform_;
  std::unique_ptr<Appearance> appearance_;
  std::unique_ptr<Resize> resize_;
  std::shared_ptr<const PolygonMesh> mesh_;
  SourceRef where_;
};

}  // namespace csgrun

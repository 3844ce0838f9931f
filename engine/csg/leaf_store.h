// Leaves on the grid, each distinct one made once, whatever number of instances a scene has.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "engine/bsp/self_resolution.h"
#include "engine/csg/appearance_table.h"
#include "engine/csg/frames.h"
#include "engine/csg/key.h"
#include "engine/csg/normal_form.h"
#include "engine/csg/quantise.h"

namespace csgrun {

/// What is asked of a mesh again and again.
struct MeshFacts {
  std::shared_ptr<const PolygonMesh> mesh;
  std::optional<Error> error;        ///< indices out of range, points that are not finite
  Key topology{};                    ///< everything but points and appearances
  std::array<double, 3> lo{}, hi{};  ///< of the points that faces use
  /// By axis: all points are at one of two heights, and no face is oblique to it, so that moving
  /// all at one height along the axis moves a cap and nothing else.
  std::array<bool, 3> prismatic{};
  FaceNumbers appearance;       ///< id per face
  uint32_t paint = kUnpainted;  ///< the only appearance of the mesh, if there is one
  uint32_t told = 0;            ///< bits by InsideRule: see LeafStore::is_news
};

/// A leaf instance on the grid: the geometry of `prepared` moved by `origin` in local axes.
struct QuantisedLeaf {
  Key key{};
  IVec3 origin{};
  std::shared_ptr<const PreparedLeaf> prepared;
  uint32_t paint = kUnpainted;  ///< of all faces; else the geometry has ids of its own
};

using BoundaryPtr = std::shared_ptr<const BoundaryMesh>;

/// Makes the boundary of what a leaf's surface encloses, in its local axes (see resolve_surface),
/// or knows it by its key.
using Resolver = std::function<Result<BoundaryPtr>(
    const Key&, const Operand&, std::span<const std::array<uint32_t, 2>>, InsideRule)>;

/// What is remembered of one leaf of the normal form.
struct LeafState {
  LinearSplit split;
  std::array<double, 3> world_lo{}, world_hi{};  ///< mm, of the transformed points
  std::optional<QuantisedLeaf> quantised;
  GridStep step;          ///< of `quantised`
  LeafRounding rounding;  ///< of `quantised`
};

class LeafStore {
 public:
  explicit LeafStore(AppearanceTable& appearances) : appearances_(appearances) {}

  const MeshFacts& facts(const std::shared_ptr<const PolygonMesh>& mesh);
  /// The state of a leaf of the normal form, by its index there.
  LeafState& state(uint32_t index, const NormalNode& leaf);
  /// Rounds and prepares a leaf. std::nullopt when it does not fit 40 bits.
  std::optional<QuantisedLeaf> quantise(uint32_t index, const NormalNode& leaf,
                                        const LeafRounding& rounding, const Quantiser& quantiser);
  /// The geometry of a good leaf in the axes of its frame.
  std::shared_ptr<const LeafGeometry> geometry(const QuantisedLeaf& leaf,
                                               const SignedPermutation& permutation);
  /// What the surface of a leaf encloses by a rule, in local axes, less the origin; made once for
  /// all instances. Errors: those of the resolver.
  Result<BoundaryPtr> resolved(const QuantisedLeaf& leaf, InsideRule rule, const Resolver& resolve);
  /// True the first time that something is to be said of a mesh and a rule, for all its instances.
  bool is_news(const PolygonMesh& mesh, InsideRule rule);
  [[nodiscard]] size_t bytes() const { return bytes_; }
  void clear();

 private:
  struct KeyAndAxes {
    Key key;
    SignedPermutation permutation;
    bool operator==(const KeyAndAxes&) const = default;
  };
  struct KeyAndAxesHash {
    size_t operator()(const KeyAndAxes& k) const {
      size_t h = k.key[0];
      for (int i = 0; i < 3; ++i)
        h = h * 31 + static_cast<size_t>(k.permutation.axis[i] * 2 + k.permutation.sign[i]);
      return h;
    }
  };

  AppearanceTable& appearances_;
  std::unordered_map<const PolygonMesh*, MeshFacts> facts_;
  std::unordered_map<uint32_t, LeafState> states_;
  std::unordered_map<Key, std::shared_ptr<const PreparedLeaf>, KeyHash> prepared_;
  std::unordered_map<KeyAndAxes, std::shared_ptr<const LeafGeometry>, KeyAndAxesHash> permuted_;
  std::unordered_map<Key, BoundaryPtr, KeyHash> resolved_;  // by resolved_key
  size_t bytes_ = 0;
};

/// What a leaf is once it is resolved.
Key resolved_key(const QuantisedLeaf& leaf, InsideRule rule);

}  // namespace csgrun

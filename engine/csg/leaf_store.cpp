#include "engine/csg/leaf_store.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <glm/vec2.hpp>

#include "engine/bsp/kernel.h"
#include "engine/csg/appearance_table.h"
#include "engine/mesh/mesh_lists.h"

namespace csgrun {
namespace {

/// What is wrong with the first corner whose point is missing or not finite.
const char* corner_fault(const PolygonMesh& mesh) {
  for (const uint32_t corner : mesh.corners) {
    if (corner >= mesh.points.size()) return "has a point index out of range";
    const glm::dvec3& p = mesh.points[corner];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return "has a point that is not finite";
    }
  }
  return nullptr;
}

/// The same for meshes in which all points of the list are good, that is nearly all, by a look at
/// each point instead of each corner.
const char* find_corner_fault(const PolygonMesh& mesh) {
  bool good = true;
  for (const uint32_t corner : mesh.corners) good = good & (corner < mesh.points.size());
  for (const glm::dvec3& p : mesh.points) {
    good = good & std::isfinite(p.x) & std::isfinite(p.y) & std::isfinite(p.z);
  }
  return good ? nullptr : corner_fault(mesh);
}

std::optional<Error> find_fault(const PolygonMesh& mesh) {
  const auto fault = [&](const char* what) {
    return Error{ErrorCode::kInvalidMesh, "the mesh of '" + mesh.kind + "' " + what, {}};
  };
  if (!has_sound_lists(mesh)) return fault("has lists of loops and faces that do not go together");
  const auto has_empty = [](const std::vector<uint32_t>& starts) {
    return std::adjacent_find(starts.begin(), starts.end()) != starts.end();
  };
  if (has_empty(mesh.face_starts) || has_empty(mesh.loop_starts))
    return fault("has a face without corners");
  if (const char* const what = find_corner_fault(mesh)) return fault(what);
  const size_t faces = mesh.face_count();
  if ((!mesh.surface.empty() && mesh.surface.size() != faces) ||
      (!mesh.appearance_of.empty() && mesh.appearance_of.size() != faces)) {
    return fault("has labels for another number of faces");
  }
  if (mesh.hull_of_points) {
    if (faces > 0) return fault("has faces beside its points");
    for (const glm::dvec3& p : mesh.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
        return fault("has a point that is not finite");
      }
    }
  }
  for (uint32_t a : mesh.appearance_of) {
    if (a >= mesh.appearances.size()) return fault("has an appearance index out of range");
  }
  for (const Appearance& a : mesh.appearances) {
    if (!is_in_range(a)) return fault("has a colour or material that is not from 0 to 1");
  }
  return std::nullopt;
}

/// See MeshFacts::prismatic. `lo` and `hi`: of the points that faces use.
std::array<bool, 3> prismatic_axes(const PolygonMesh& mesh, const std::array<double, 3>& lo,
                                   const std::array<double, 3>& hi) {
  const auto is_upright = [&](int axis, uint32_t face) {
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    const std::span<const uint32_t> corners(
        mesh.corners.data() + mesh.loop_starts[mesh.face_starts[face]],
        mesh.corners.data() + mesh.loop_starts[mesh.face_starts[face + 1]]);
    bool is_cap = true;
    std::vector<glm::dvec2> places;  // seen along the axis; of side faces there are two
    for (const uint32_t corner : corners) {
      const glm::dvec3& p = mesh.points[corner];
      is_cap &= p[axis] == mesh.points[corners[0]][axis];
      const glm::dvec2 place(p[j], p[k]);
      if (places.size() > 2 || std::find(places.begin(), places.end(), place) != places.end()) {
        continue;
      }
      places.push_back(place);
    }
    return is_cap || places.size() <= 2;
  };
  std::array<bool, 3> result{};
  for (int axis = 0; axis < 3; ++axis) {
    result[axis] = !mesh.corners.empty() &&
                   std::all_of(mesh.corners.begin(), mesh.corners.end(), [&](uint32_t corner) {
                     const double height = mesh.points[corner][axis];
                     return height == lo[axis] || height == hi[axis];
                   });
    for (uint32_t f = 0; result[axis] && f < mesh.face_count(); ++f) {
      result[axis] = is_upright(axis, f);
    }
  }
  return result;
}

size_t memory_of(const LeafGeometry& leaf) {
  return leaf.vertices.size() * sizeof(IVec3) + leaf.corners.size() * 4 +
         (leaf.face_count() + leaf.facet.stored() + leaf.surface.stored() +
          leaf.appearance.stored()) *
             4 +
         256;
}

bool same_rounding(const LeafRounding& a, const LeafRounding& b) {
  return a.in_world == b.in_world && a.scale == b.scale && a.offset == b.offset &&
         a.permutation == b.permutation && a.lo == b.lo && a.hi == b.hi &&
         (!a.in_world || a.map == b.map);
}

}  // namespace

const MeshFacts& LeafStore::facts(const std::shared_ptr<const PolygonMesh>& mesh) {
  const auto [found, is_new] = facts_.try_emplace(mesh.get());
  MeshFacts& facts = found->second;
  if (!is_new) return facts;
  facts.mesh = mesh;
  facts.error = find_fault(*mesh);
  if (facts.error) return facts;
  KeyBuilder builder("mesh");
  builder.list(mesh->corners).list(mesh->loop_starts).list(mesh->face_starts).list(mesh->surface);
  builder.number(mesh->keep_facets).number(mesh->convex).number(mesh->hull_of_points);
  facts.topology = builder.key();
  facts.lo.fill(std::numeric_limits<double>::infinity());
  facts.hi.fill(-std::numeric_limits<double>::infinity());
  const std::vector<uint8_t> is_used = find_used_points(*mesh);
  for (size_t p = 0; p < is_used.size(); ++p) {
    if (is_used[p] == 0) continue;
    for (int i = 0; i < 3; ++i) {
      facts.lo[i] = std::min(facts.lo[i], mesh->points[p][i]);
      facts.hi[i] = std::max(facts.hi[i], mesh->points[p][i]);
    }
  }
  facts.prismatic = prismatic_axes(*mesh, facts.lo, facts.hi);
  if (mesh->appearance_of.empty()) {
    facts.appearance = FaceNumbers::all(appearances_.intern(Appearance{}));
  } else {
    std::vector<uint32_t> ids(mesh->face_count());
    for (size_t f = 0; f < ids.size(); ++f) {
      ids[f] = appearances_.intern(mesh->appearances[mesh->appearance_of[f]]);
    }
    facts.appearance = std::move(ids);
  }
  if (mesh->hull_of_points) {
    facts.paint =
        appearances_.intern(mesh->appearances.empty() ? Appearance{} : mesh->appearances[0]);
  } else if (const auto common = facts.appearance.common(); common && mesh->face_count() > 0) {
    facts.paint = *common;
  }
  return facts;
}

LeafState& LeafStore::state(uint32_t index, const NormalNode& leaf) {
  const auto [found, is_new] = states_.try_emplace(index);
  LeafState& state = found->second;
  if (!is_new) return state;
  state.split = split_linear(leaf.map);
  state.world_lo.fill(std::numeric_limits<double>::infinity());
  state.world_hi.fill(-std::numeric_limits<double>::infinity());
  const PolygonMesh& mesh = *leaf.leaf->mesh();
  const MeshFacts& known = facts(leaf.leaf->mesh());
  // A map of axes onto axes maps the box; any other maps the points.
  int entries = 0;
  for (const auto& row : leaf.map.m) entries += (row[0] != 0) + (row[1] != 0) + (row[2] != 0);
  const auto extend = [&](const glm::dvec3& p) {
    const glm::dvec3 x = leaf.map.apply(p);
    for (int i = 0; i < 3; ++i) {
      state.world_lo[i] = std::min(state.world_lo[i], x[i]);
      state.world_hi[i] = std::max(state.world_hi[i], x[i]);
    }
  };
  if (mesh.corners.empty() && !mesh.hull_of_points) return state;
  if (entries <= 3) {
    extend({known.lo[0], known.lo[1], known.lo[2]});
    extend({known.hi[0], known.hi[1], known.hi[2]});
    if (state.split.framed) return state;
  }
  const std::vector<uint8_t> is_used = find_used_points(mesh);
  for (size_t p = 0; p < is_used.size(); ++p) {
    if (is_used[p] != 0) extend(mesh.points[p]);
  }
  return state;
}

std::optional<QuantisedLeaf> LeafStore::quantise(uint32_t index, const NormalNode& leaf,
                                                 const LeafRounding& rounding,
                                                 const Quantiser& quantiser) {
  LeafState& known = state(index, leaf);
  if (known.quantised && known.step == quantiser.step() &&
      same_rounding(known.rounding, rounding)) {
    return known.quantised;
  }
  const PolygonMesh& mesh = *leaf.leaf->mesh();
  const MeshFacts& mesh_facts = facts(leaf.leaf->mesh());
  auto points = round_points(mesh, rounding, quantiser);
  if (!points) return std::nullopt;

  QuantisedLeaf result;
  result.paint = leaf.paint != kUnpainted ? leaf.paint : mesh_facts.paint;
  // Points relative to the middle of their box: equal for all instances that are whole steps apart.
  IVec3 lo{INT64_MAX, INT64_MAX, INT64_MAX}, hi{INT64_MIN, INT64_MIN, INT64_MIN};
  const std::vector<uint8_t> is_used = find_used_points(mesh);
  for (size_t p = 0; p < is_used.size(); ++p) {
    if (is_used[p] == 0) continue;
    for (int i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], (*points)[p][i]);
      hi[i] = std::max(hi[i], (*points)[p][i]);
    }
  }
  if (lo[0] <= hi[0]) {
    for (int i = 0; i < 3; ++i) result.origin[i] = (lo[i] + hi[i]) >> 1;
  }
  for (IVec3& p : *points) {
    for (int i = 0; i < 3; ++i) p[i] -= result.origin[i];
  }
  const bool turn = rounding.in_world && known.split.determinant < 0;
  KeyBuilder builder("leaf");
  builder.numbers(mesh_facts.topology).number(turn);
  builder.number(result.paint != kUnpainted);
  if (result.paint == kUnpainted) {
    for (size_t f = 0; f < mesh.face_count(); ++f) {
      builder.numbers(appearances_.key(mesh_facts.appearance[f]));
    }
  }
  builder.number(static_cast<uint64_t>(mesh.corners.size()));
  // Points that no face uses do not count; they all stand at minus the origin.
  for (size_t p = 0, end = 0; p < points->size(); p = end) {
    while (end < points->size() && is_used[end] != 0) ++end;
    builder.bare_list(std::span<const IVec3>(*points).subspan(p, end - p));
    for (; end < points->size() && is_used[end] == 0; ++end) builder.number('-');
  }
  result.key = builder.key();

  auto& prepared = prepared_[result.key];
  if (!prepared) {
    auto made = std::make_shared<PreparedLeaf>(
        prepare_leaf(mesh, *points, turn,
                     result.paint == kUnpainted ? mesh_facts.appearance : FaceNumbers::all(0)));
    if (made->geometry) bytes_ += memory_of(*made->geometry);
    prepared = std::move(made);
  }
  result.prepared = prepared;
  known.quantised = result;
  known.step = quantiser.step();
  known.rounding = rounding;
  return result;
}

std::shared_ptr<const LeafGeometry> LeafStore::geometry(const QuantisedLeaf& leaf,
                                                        const SignedPermutation& permutation) {
  if (permutation.is_identity()) return leaf.prepared->geometry;
  auto& made = permuted_[{leaf.key, permutation}];
  if (!made) {
    made = std::make_shared<LeafGeometry>(permuted(*leaf.prepared->geometry, permutation));
    bytes_ += memory_of(*made);
  }
  return made;
}

Key resolved_key(const QuantisedLeaf& leaf, InsideRule rule) {
  return KeyBuilder("resolved").number(rule).numbers(leaf.key).key();
}

Result<BoundaryPtr> LeafStore::resolved(const QuantisedLeaf& leaf, InsideRule rule,
                                        const Resolver& resolve) {
  const Key key = resolved_key(leaf, rule);
  BoundaryPtr& made = resolved_[key];
  if (!made) {
    Operand surface;
    surface.leaf = leaf.prepared->geometry;
    auto boundary = resolve(key, surface, leaf.prepared->crossings, rule);
    if (!boundary) return boundary.error();
    made = *boundary;
    bytes_ += memory_bytes(*made);
  }
  return made;
}

bool LeafStore::is_news(const PolygonMesh& mesh, InsideRule rule) {
  uint32_t& told = facts_.at(&mesh).told;
  const uint32_t bit = 1u << static_cast<uint32_t>(rule);
  const bool news = (told & bit) == 0;
  told |= bit;
  return news;
}

void LeafStore::clear() {
  facts_.clear();
  states_.clear();
  prepared_.clear();
  permuted_.clear();
  resolved_.clear();
  bytes_ = 0;
}

}  // namespace csgrun

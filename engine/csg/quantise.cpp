#include "engine/csg/quantise.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <utility>

#include "engine/csg/leaf_faces.h"

namespace csgrun {
namespace {

using Int128 = __int128;

struct PointHash {
  size_t operator()(const IVec3& p) const {
    uint64_t h = 0;
    for (int64_t c : p) {
      h = (h ^ static_cast<uint64_t>(c)) * 0xff51afd7ed558ccdULL;
      h ^= h >> 32;
    }
    return static_cast<size_t>(h);
  }
};

/// Vertices without repetition, and the faces over them.
struct Merged {
  std::vector<IVec3> vertices;
  std::vector<LoopFace> faces;
  bool any = false;  // points became one
};

Merged merge_points(const PolygonMesh& mesh, const std::vector<IVec3>& points, bool turn,
                    const std::vector<uint32_t>& appearance) {
  constexpr uint32_t kNone = UINT32_MAX;
  Merged result;
  std::unordered_map<IVec3, uint32_t, PointHash> vertex_at;
  vertex_at.reserve(points.size());
  std::vector<uint32_t> vertex_of(points.size(), kNone);
  result.faces.reserve(mesh.face_count());
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    LoopFace face;
    face.facet = mesh.keep_facets ? static_cast<uint32_t>(f) + 1 : 0;
    face.surface = mesh.surface.empty() ? 0 : mesh.surface[f];
    face.appearance = appearance[f];
    for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
      std::vector<uint32_t> loop;
      for (uint32_t c = mesh.loop_starts[l]; c < mesh.loop_starts[l + 1]; ++c) {
        const uint32_t point = mesh.corners[c];
        if (vertex_of[point] == kNone) {
          const auto [found, is_new] =
              vertex_at.try_emplace(points[point], static_cast<uint32_t>(result.vertices.size()));
          if (is_new) result.vertices.push_back(points[point]);
          result.any |= !is_new;
          vertex_of[point] = found->second;
        }
        loop.push_back(vertex_of[point]);
      }
      if (turn) std::reverse(loop.begin(), loop.end());
      face.loops.push_back(std::move(loop));
    }
    result.faces.push_back(std::move(face));
  }
  return result;
}

/// Faces as arrays, over the vertices that they use, in order of first use.
LeafGeometry pack(const std::vector<IVec3>& vertices, const std::vector<LoopFace>& faces) {
  constexpr uint32_t kNone = UINT32_MAX;
  LeafGeometry leaf;
  std::vector<uint32_t> number(vertices.size(), kNone);
  for (const LoopFace& face : faces) {
    for (uint32_t v : face.loops[0]) {
      if (number[v] == kNone) {
        number[v] = static_cast<uint32_t>(leaf.vertices.size());
        leaf.vertices.push_back(vertices[v]);
      }
      leaf.corners.push_back(number[v]);
    }
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
    leaf.facet.push_back(face.facet);
    leaf.surface.push_back(face.surface);
    leaf.appearance.push_back(face.appearance);
  }
  return leaf;
}

/// The directed edges of a leaf by the vertex that they leave, then by the one that they reach.
class EdgeTable {
 public:
  struct Edge {
    uint32_t to, face;
    bool operator<(const Edge& o) const { return std::pair(to, face) < std::pair(o.to, o.face); }
  };

  explicit EdgeTable(const LeafGeometry& leaf) : starts_(leaf.vertices.size() + 1, 0) {
    for (uint32_t v : leaf.corners) ++starts_[v + 1];
    for (size_t v = 1; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
    edges_.resize(leaf.corners.size());
    std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (uint32_t f = 0; f < leaf.face_count(); ++f) {
      const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
      for (uint32_t c = begin; c < end; ++c) {
        const uint32_t to = leaf.corners[c + 1 < end ? c + 1 : begin];
        edges_[next[leaf.corners[c]]++] = {to, f};
      }
    }
    for (uint32_t v = 0; v + 1 < starts_.size(); ++v) {
      std::sort(edges_.begin() + starts_[v], edges_.begin() + starts_[v + 1]);
    }
  }

  [[nodiscard]] size_t vertex_count() const { return starts_.size() - 1; }
  [[nodiscard]] std::span<const Edge> leaving(uint32_t v) const {
    return {edges_.data() + starts_[v], starts_[v + 1] - starts_[v]};
  }
  /// The edges from one vertex to another.
  [[nodiscard]] std::span<const Edge> between(uint32_t from, uint32_t to) const {
    const auto all = leaving(from);
    const auto first =
        std::partition_point(all.begin(), all.end(), [to](const Edge& e) { return e.to < to; });
    auto last = first;
    while (last != all.end() && last->to == to) ++last;
    return {first, last};
  }
  /// Whether every directed edge occurs as often as its reverse.
  [[nodiscard]] bool is_balanced() const {
    for (uint32_t v = 0; v < vertex_count(); ++v) {
      const auto all = leaving(v);
      for (size_t i = 0; i < all.size();) {
        const auto same = between(v, all[i].to);
        if (between(all[i].to, v).size() != same.size()) return false;
        i += same.size();
      }
    }
    return true;
  }

 private:
  std::vector<uint32_t> starts_;
  std::vector<Edge> edges_;
};

/// Six times the volume, its sign exact while coordinates are below 2^30 (and there are fewer than
/// 2^33 corners); far leaves are huge, so that doubles decide.
double signed_volume(const LeafGeometry& leaf, const GridBox& box) {
  bool is_far = false;
  for (int i = 0; i < 3; ++i) {
    is_far |= box.lo[i] <= -(int64_t{1} << 30) || box.hi[i] >= int64_t{1} << 30;
  }
  Int128 exact = 0;
  double rounded = 0;
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    for (uint32_t c = begin + 1; c + 1 < end; ++c) {
      const IVec3& p = leaf.vertices[leaf.corners[begin]];
      const IVec3& q = leaf.vertices[leaf.corners[c]];
      const IVec3& r = leaf.vertices[leaf.corners[c + 1]];
      const auto minor = [&](int i, int j) {
        return static_cast<Int128>(q[i]) * r[j] - static_cast<Int128>(q[j]) * r[i];
      };
      for (int i = 0; i < 3; ++i) {
        const Int128 m = minor((i + 1) % 3, (i + 2) % 3);
        if (is_far) {
          rounded += static_cast<double>(p[i]) * static_cast<double>(m);
        } else {
          exact += p[i] * m;
        }
      }
    }
  }
  return is_far ? rounded : static_cast<double>(exact);
}

/// Whether no face has a neighbour in front of it. For the surface of one body of genus 0, which a
/// mesh that promises to be convex is, this is convexity.
bool is_locally_convex(const LeafGeometry& leaf, const EdgeTable& edges) {
  std::vector<CornerPlane> planes(leaf.face_count());
  for (size_t f = 0; f < planes.size(); ++f) {
    const uint32_t begin = leaf.face_starts[f];
    if (!corner_plane(leaf.vertices, &leaf.corners[begin], leaf.face_starts[f + 1] - begin,
                      planes[f])) {
      return false;
    }
  }
  for (uint32_t v = 0; v < edges.vertex_count(); ++v) {
    for (const EdgeTable::Edge& edge : edges.leaving(v)) {
      const auto reverse = edges.between(edge.to, v);
      if (reverse.size() != 1) return false;
      const uint32_t other = reverse[0].face;
      for (uint32_t c = leaf.face_starts[other]; c < leaf.face_starts[other + 1]; ++c) {
        if (planes[edge.face].side(leaf.vertices[leaf.corners[c]]) > 0) return false;
      }
    }
  }
  return true;
}

}  // namespace

std::optional<std::vector<IVec3>> round_points(const PolygonMesh& mesh,
                                               const LeafRounding& rounding,
                                               const Quantiser& quantiser) {
  std::vector<IVec3> points(mesh.points.size(), IVec3{0, 0, 0});
  std::vector<uint8_t> is_used(mesh.points.size(), 0);
  for (uint32_t corner : mesh.corners) is_used[corner] = 1;
  std::array<int, 3> sign;
  for (int i = 0; i < 3; ++i) {
    sign[rounding.permutation.axis[i]] = rounding.permutation.sign[i];
  }
  for (size_t p = 0; p < points.size(); ++p) {
    if (!is_used[p]) continue;
    glm::dvec3 x;
    if (rounding.in_world) {
      x = rounding.map.apply(mesh.points[p]);
    } else {
      for (int j = 0; j < 3; ++j) x[j] = rounding.scale[j] * mesh.points[p][j] + rounding.offset[j];
    }
    for (int j = 0; j < 3; ++j) {
      const auto rounded = quantiser(sign[j] < 0 ? -x[j] : x[j]);
      if (!rounded || *rounded >= kFarLimit || *rounded <= -kFarLimit) return std::nullopt;
      points[p][j] = sign[j] < 0 ? -*rounded : *rounded;
    }
  }
  return points;
}

PreparedLeaf prepare_leaf(const PolygonMesh& mesh, const std::vector<IVec3>& points, bool turn,
                          const std::vector<uint32_t>& appearance) {
  PreparedLeaf result;
  Merged merged = merge_points(mesh, points, turn, appearance);
  make_convex_faces(merged.vertices, mesh.convex, merged.any, merged.faces);
  auto leaf = std::make_shared<LeafGeometry>(pack(merged.vertices, merged.faces));
  if (leaf->face_count() == 0) return result;
  result.box.lo = result.box.hi = leaf->vertices[0];
  for (const IVec3& v : leaf->vertices) {
    for (int i = 0; i < 3; ++i) {
      result.box.lo[i] = std::min(result.box.lo[i], v[i]);
      result.box.hi[i] = std::max(result.box.hi[i], v[i]);
    }
  }
  const EdgeTable edges(*leaf);
  if (!edges.is_balanced()) {
    result.status = PreparedLeaf::Status::kOpen;
    return result;
  }
  // Rounding can close a gap that is narrower than a step, whatever was promised of the original
  // mesh; convexity is seen from the faces themselves.
  leaf->convex = mesh.convex && is_locally_convex(*leaf, edges);
  if (!leaf->convex) {
    if (const auto found = find_self_intersection(*leaf)) {
      result.status = PreparedLeaf::Status::kSelfIntersecting;
      result.intersection = *found;
      return result;
    }
  }
  const double volume = signed_volume(*leaf, result.box);
  if (volume == 0) return result;
  if (volume < 0) {
    result.status = PreparedLeaf::Status::kInsideOut;
    return result;
  }
  result.status = PreparedLeaf::Status::kGood;
  result.geometry = std::move(leaf);
  return result;
}

LeafGeometry permuted(const LeafGeometry& leaf, const SignedPermutation& permutation) {
  LeafGeometry result = leaf;
  for (IVec3& v : result.vertices) v = permutation.apply(v);
  if (permutation.determinant() < 0) {
    for (size_t f = 0; f < leaf.face_count(); ++f) {
      std::reverse(result.corners.begin() + result.face_starts[f],
                   result.corners.begin() + result.face_starts[f + 1]);
    }
  }
  return result;
}

}  // namespace csgrun

#include "engine/csg/convex_leaf.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>
#include <utility>

#include "engine/base/scratch.h"
#include "engine/csg/collinear_triangles.h"
#include "engine/csg/leaf_faces.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

constexpr uint32_t kNone = UINT32_MAX;

uint64_t hash(const IVec3& p) {
  uint64_t h = 0;
  for (const int64_t c : p)
    h = (std::rotl(h, 29) ^ static_cast<uint64_t>(c)) * 0xff51afd7ed558ccdULL;
  return h ^ h >> 32;
}

/// For each point the first one that equals it; nothing if no two are equal. The table is larger
/// than what is near the processor: its lines are asked for before they are needed.
std::vector<uint32_t> find_equal(const std::vector<IVec3>& points) {
  constexpr size_t kAhead = 16;
  Scratch scratch;
  const auto table = scratch.array<uint32_t>(std::bit_ceil(2 * points.size() + 1), kNone);  // open
  const auto first = scratch.array<uint32_t>(points.size());
  const size_t mask = table.size() - 1;
  std::array<size_t, kAhead> places{};
  bool any = false;
  const auto prepare = [&](size_t point) {
    const size_t at = hash(points[point]) & mask;
    places[point % kAhead] = at;
    __builtin_prefetch(&table[at], 1);
  };
  for (size_t p = 0; p < std::min(kAhead, points.size()); ++p) prepare(p);
  for (uint32_t p = 0; p < points.size(); ++p) {
    size_t at = places[p % kAhead];
    if (p + kAhead < points.size()) prepare(p + kAhead);
    while (table[at] != kNone && points[table[at]] != points[p]) at = (at + 1) & mask;
    if (table[at] == kNone) table[at] = p;
    first[p] = table[at];
    any |= table[at] != p;
  }
  if (!any) return {};
  return {first.begin(), first.end()};
}

/// Gives points numbers in the order in which they are asked for, equal points the same one.
class Numbering {
 public:
  Numbering(const std::vector<IVec3>& points, Scratch& scratch)
      : points_(points),
        equal_(find_equal(points)),
        number_(scratch.array<uint32_t>(points.size(), kNone)),
        vertices_(points.size() + 1) {}  // room for one that is not added, too

  uint32_t operator()(uint32_t point) {
    uint32_t& number = number_[equal_.empty() ? point : equal_[point]];
    // Whether it was asked for before is chance: no branch on that.
    const uint32_t known = number;
    vertices_[count_] = points_[point];
    number = known == kNone ? count_ : known;
    count_ += static_cast<uint32_t>(known == kNone);
    return number;
  }
  /// Whether different points of a list are equal.
  [[nodiscard]] bool merges(std::span<const uint32_t> points) const {
    if (equal_.empty()) return false;
    std::vector<uint32_t> met(points_.size(), kNone);
    return std::any_of(points.begin(), points.end(), [&](uint32_t point) {
      const uint32_t other = std::exchange(met[equal_[point]], point);
      return other != kNone && other != point;
    });
  }
  /// Those that have numbers, and maybe more.
  [[nodiscard]] const std::vector<IVec3>& vertices() const { return vertices_; }
  std::vector<IVec3> take_vertices() {
    vertices_.resize(count_);
    return std::move(vertices_);
  }

 private:
  const std::vector<IVec3>& points_;
  std::vector<uint32_t> equal_;       ///< see find_equal; empty if no two are
  const std::span<uint32_t> number_;  ///< by the first of those that are equal
  std::vector<IVec3> vertices_;       ///< of each number, and one more
  uint32_t count_ = 0;
};

bool has_area(const IVec3& a, const IVec3& b, const IVec3& c) {
  const IVec3 u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

/// The numbers of the first `count` faces but for those that are left out; twice those of faces
/// that were split. Both ascend.
std::vector<uint32_t> numbers_of_parts(const FaceNumbers& numbers, size_t count,
                                       std::span<const LeftOut> left_out,
                                       std::span<const uint32_t> split) {
  std::vector<uint32_t> kept;
  kept.reserve(count - left_out.size() + split.size());
  for (size_t f = 0, next = 0, next_split = 0; f < count; ++f) {
    if (next < left_out.size() && left_out[next].face == f) {
      ++next;
      continue;
    }
    kept.push_back(numbers[f]);
    if (next_split == split.size() || split[next_split] != f) continue;
    kept.push_back(numbers[f]);
    ++next_split;
  }
  return kept;
}

/// Leaves out vertices that no face uses, and puts the others in the order of their first use.
void renumber(LeafGeometry& leaf) {
  std::vector<uint32_t> number(leaf.vertices.size(), kNone);
  std::vector<IVec3> used;
  used.reserve(leaf.vertices.size());
  for (uint32_t& corner : leaf.corners) {
    uint32_t& known = number[corner];
    if (known == kNone) {
      known = static_cast<uint32_t>(used.size());
      used.push_back(leaf.vertices[corner]);
    }
    corner = known;
  }
  leaf.vertices = std::move(used);
}

}  // namespace

std::optional<ConvexFaces> take_convex_faces(const PolygonMesh& mesh,
                                             const std::vector<IVec3>& points, bool turn,
                                             const FaceNumbers& appearance) {
  const GridBox box = box_of_points(points);
  if (mesh.loop_count() != mesh.face_count() || !is_compact(box)) return std::nullopt;
  std::optional<ConvexFaces> result(std::in_place);
  LeafGeometry& leaf = result->leaf;
  const size_t faces = mesh.face_count();
  leaf.corners.resize(mesh.corners.size());
  leaf.face_starts.reserve(faces + 1);
  std::vector<LeftOut> left_out;
  std::vector<uint32_t> split, corners;  // faces of four corners that became two; those of one face
  Scratch scratch;
  Numbering number(points, scratch);
  uint32_t next = 0;
  const auto add = [&](std::span<const uint32_t> loop) {
    for (const uint32_t point : loop) leaf.corners[next++] = number(point);
    leaf.face_starts.push_back(next);
  };
  for (uint32_t f = 0; f < faces; ++f) {
    if (mesh.face_starts[f] != f) return std::nullopt;  // not one loop
    const uint32_t begin = mesh.loop_starts[f], end = mesh.loop_starts[f + 1], count = end - begin;
    if (count == 3) {
      uint32_t* const loop = leaf.corners.data() + next;
      for (uint32_t i = 0; i < 3; ++i) {
        loop[i] = number(mesh.corners[turn ? end - 1 - i : begin + i]);
      }
      const auto& v = number.vertices();
      if (!has_area(v[loop[0]], v[loop[1]], v[loop[2]])) {
        left_out.push_back({f, {loop[0], loop[1], loop[2]}});
        continue;
      }
      next += 3;
      leaf.face_starts.push_back(next);
      continue;
    }
    corners.assign(mesh.corners.begin() + begin, mesh.corners.begin() + end);
    if (turn) std::reverse(corners.begin(), corners.end());
    if (is_convex_polygon(points, corners)) {
      add(corners);
      continue;
    }
    if (!mesh.convex || count != 4) return std::nullopt;
    const auto triangles = split_bent_quad(points, corners);
    if (!triangles) return std::nullopt;
    leaf.corners.resize(leaf.corners.size() + 2);
    for (const auto& triangle : *triangles) add(triangle);
    split.push_back(f);
  }
  // A triangle on a line may have a corner on an edge of a bent face, which then has five.
  if (!left_out.empty() && !split.empty()) return std::nullopt;
  leaf.corners.resize(next);
  if (mesh.keep_facets) leaf.facet = FaceNumbers::ascending(1);
  if (!mesh.surface.empty()) leaf.surface = mesh.surface;
  leaf.appearance = appearance;
  if (!left_out.empty() || !split.empty()) {
    for (FaceNumbers* numbers : {&leaf.facet, &leaf.surface, &leaf.appearance}) {
      const auto common = numbers->common();
      *numbers =
          common ? FaceNumbers::all(*common) : numbers_of_parts(*numbers, faces, left_out, split);
    }
  }
  leaf.vertices = number.take_vertices();
  if (!split_at_collinear(leaf, left_out)) return std::nullopt;
  if (!left_out.empty()) renumber(leaf);
  result->merged = !left_out.empty() || number.merges(mesh.corners);
  result->box = leaf.vertices.size() == points.size() ? box : box_of_points(leaf.vertices);
  return result;
}

bool has_reversed_pair(const LeafGeometry& leaf, const std::vector<uint32_t>& opposite) {
  return with_face_of(leaf, [&](auto face_of) {
    for (uint32_t f = 0; f < leaf.face_count(); ++f) {
      const std::span edges(opposite.data() + leaf.face_starts[f],
                            opposite.data() + leaf.face_starts[f + 1]);
      const uint32_t other = face_of(edges[0]);
      if (leaf.face_starts[other + 1] - leaf.face_starts[other] == edges.size() &&
          std::all_of(edges.begin(), edges.end(),
                      [&](uint32_t edge) { return face_of(edge) == other; })) {
        return true;
      }
    }
    return false;
  });
}

}  // namespace csgrun

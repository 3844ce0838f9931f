#include "engine/csg/convex_leaf.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>
#include <utility>

#include "engine/base/none.h"
#include "engine/base/scratch.h"
#include "engine/csg/collinear_triangles.h"
#include "engine/csg/leaf_faces.h"
#include "engine/mesh/leaf_shape.h"

namespace csgrun {
namespace {

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
        numbered_(scratch.array<uint32_t>(points.size() + 1)) {}

  uint32_t operator()(uint32_t point) { return number_of(first_of(point), count_); }
  /// Appends the numbers of the corners of triangles, which are turned over or not.
  void number_triangles(std::span<const uint32_t> corners, bool turn, uint32_t* numbers) {
    uint32_t count = count_;
    const size_t first = turn ? 2 : 0, last = 2 - first;
    const auto number_each = [&](auto&& first_of) {
      for (size_t c = 0; c < corners.size(); c += 3) {
        numbers[c] = number_of(first_of(corners[c + first]), count);
        numbers[c + 1] = number_of(first_of(corners[c + 1]), count);
        numbers[c + 2] = number_of(first_of(corners[c + last]), count);
      }
    };
    if (equal_.empty()) {
      number_each([](uint32_t point) { return point; });
    } else {
      number_each([this](uint32_t point) { return equal_[point]; });
    }
    count_ = count;
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
  /// Those that have numbers.
  [[nodiscard]] std::vector<IVec3> vertices() const {
    std::vector<IVec3> vertices(count_);
    for (size_t v = 0; v < vertices.size(); ++v) vertices[v] = points_[numbered_[v]];
    return vertices;
  }

 private:
  [[nodiscard]] uint32_t first_of(uint32_t point) const {
    return equal_.empty() ? point : equal_[point];
  }
  uint32_t number_of(uint32_t point, uint32_t& count) {
    // Whether it was asked for before is chance: no branch on that. What is known is below.
    const uint32_t number = std::min(number_[point], count);
    number_[point] = number;
    numbered_[count] = point;
    count += static_cast<uint32_t>(number == count);
    return number;
  }

  const std::vector<IVec3>& points_;
  std::vector<uint32_t> equal_;         ///< see find_equal; empty if no two are
  const std::span<uint32_t> number_;    ///< by the first of those that are equal
  const std::span<uint32_t> numbered_;  ///< the point of each number, and room for one more
  uint32_t count_ = 0;
};

bool have_area(const IVec3& a, const IVec3& b, const IVec3& c) {
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

bool consists_of_triangles(const PolygonMesh& mesh) {
  if (mesh.corners.size() != 3 * mesh.face_count()) return false;
  uint32_t differences = 0;  // in bits: the processor takes several faces at once
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    differences |= (mesh.face_starts[f] ^ f) | (mesh.loop_starts[f] ^ 3 * f);
  }
  return differences == 0;
}

/// Puts the faces of a mesh into a leaf.
struct FaceTaker {
  const PolygonMesh& mesh;
  const std::vector<IVec3>& points;
  const bool turn;
  Numbering& number;
  LeafGeometry& leaf;
  std::vector<LeftOut> left_out = {};
  std::vector<uint32_t> split = {};  ///< faces of four corners that became two

  /// REQUIRES: a mesh of triangles.
  void take_triangles() {
    std::vector<uint32_t>& corners = leaf.corners;
    corners.resize(mesh.corners.size());
    number.number_triangles(mesh.corners, turn, corners.data());
    const auto has_area = [&](uint32_t first) {
      const uint32_t* const c = mesh.corners.data() + first;
      return have_area(points[c[0]], points[c[1]], points[c[2]]);
    };
    uint32_t next = 0;
    while (next < corners.size() && has_area(next)) next += 3;  // mostly all have
    for (uint32_t c = next; c < corners.size(); c += 3) {
      const std::array<uint32_t, 3> loop{corners[c], corners[c + 1], corners[c + 2]};
      if (!has_area(c)) {
        left_out.push_back({c / 3, loop});
        continue;
      }
      std::copy(loop.begin(), loop.end(), corners.begin() + next);
      next += 3;
    }
    corners.resize(next);
    leaf.face_starts.resize(next / 3 + 1);
    for (uint32_t f = 0; f < leaf.face_starts.size(); ++f) leaf.face_starts[f] = 3 * f;
  }

  /// False when some face cannot be taken.
  bool take_faces() {
    const size_t faces = mesh.face_count();
    leaf.corners.reserve(mesh.corners.size());
    leaf.face_starts.reserve(faces + 1);
    std::vector<uint32_t> loop;  // of one face
    for (uint32_t f = 0; f < faces; ++f) {
      if (mesh.face_starts[f] != f) return false;  // not one loop
      loop.assign(mesh.corners.begin() + mesh.loop_starts[f],
                  mesh.corners.begin() + mesh.loop_starts[f + 1]);
      if (turn) std::reverse(loop.begin(), loop.end());
      if (loop.size() == 3 && !have_area(points[loop[0]], points[loop[1]], points[loop[2]])) {
        LeftOut face{f, {}};
        for (size_t i = 0; i < 3; ++i) face.corners[i] = number(loop[i]);
        left_out.push_back(face);
        continue;
      }
      if (loop.size() == 3 || is_convex_polygon(points, loop)) {
        add(loop);
        continue;
      }
      if (!mesh.convex || loop.size() != 4) return false;
      const auto triangles = split_bent_quad(points, loop);
      if (!triangles) return false;
      for (const auto& triangle : *triangles) add(triangle);
      split.push_back(f);
    }
    return true;
  }

 private:
  void add(std::span<const uint32_t> loop) {
    for (const uint32_t point : loop) leaf.corners.push_back(number(point));
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  }
};

}  // namespace

std::optional<ConvexFaces> take_convex_faces(const PolygonMesh& mesh,
                                             const std::vector<IVec3>& points, bool turn,
                                             const FaceNumbers& appearance) {
  const GridBox box = box_of_points(points);
  if (mesh.loop_count() != mesh.face_count() || !is_compact(box)) return std::nullopt;
  std::optional<ConvexFaces> result(std::in_place);
  LeafGeometry& leaf = result->leaf;
  Scratch scratch;
  Numbering number(points, scratch);
  FaceTaker taker{mesh, points, turn, number, leaf};
  if (consists_of_triangles(mesh)) {
    taker.take_triangles();
  } else if (!taker.take_faces()) {
    return std::nullopt;
  }
  const std::vector<LeftOut>& left_out = taker.left_out;
  const std::vector<uint32_t>& split = taker.split;
  // A triangle on a line may have a corner on an edge of a bent face, which then has five.
  if (!left_out.empty() && !split.empty()) return std::nullopt;
  if (mesh.keep_facets) leaf.facet = FaceNumbers::ascending(1);
  if (!mesh.surface.empty()) leaf.surface = mesh.surface;
  leaf.appearance = appearance;
  if (!left_out.empty() || !split.empty()) {
    for (FaceNumbers* numbers : {&leaf.facet, &leaf.surface, &leaf.appearance}) {
      const auto common = numbers->common();
      *numbers = common ? FaceNumbers::all(*common)
                        : numbers_of_parts(*numbers, mesh.face_count(), left_out, split);
    }
  }
  leaf.vertices = number.vertices();
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

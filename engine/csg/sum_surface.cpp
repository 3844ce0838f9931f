#include "engine/csg/sum_surface.h"

#include <algorithm>
#include <compare>
#include <cstdlib>
#include <span>
#include <unordered_map>
#include <utility>

#include "engine/csg/point_hash.h"
#include "engine/csg/wide_normal.h"

namespace csgrun {
namespace {

constexpr size_t kMostParts = size_t{1} << 24;

/// A face of a cell, but for its sense.
struct Part {
  enum Kind : uint32_t { kVertexAndFace, kFaceAndVertex, kEdges, kVertexAndFan };
  Kind kind;
  /// A vertex and a face, of A and B in the order of the kind; or the ends of an edge of A and
  /// those of an edge of B, the lower number first; or a vertex of A and such ends, with the middle
  /// of B. (That may be an end, too: it counts as B's last vertex.)
  std::array<uint32_t, 4> names{};
  auto operator<=>(const Part&) const = default;
};

struct CountedPart {
  Part part;
  int32_t count;
};

class Parts {
 public:
  Parts(const LeafGeometry& a, const LeafGeometry& b) : a_(a), b_(b) {}

  void add(const SumCells& cells) {
    for (const uint32_t v : cells.peaks) {
      for (uint32_t g = 0; g < b_.face_count(); ++g) add_vertex_and_face(v, g, 1);
    }
    for (const uint32_t w : cells.pits) {
      for (uint32_t f = 0; f < a_.face_count(); ++f) add_face_and_vertex(f, w, 1);
    }
    // The face is the top of its prism at the lower end of an edge of A, at the higher one of B.
    for (const SumPrism& prism : cells.a_edges) {
      add_vertex_and_face(prism.low, prism.face, 1);
      add_vertex_and_face(prism.high, prism.face, -1);
      each_edge(b_, prism.face, [&](uint32_t from, uint32_t to) {
        add_edges(prism.high, prism.low, from, to, -1);
      });
    }
    for (const SumPrism& prism : cells.b_edges) {
      add_face_and_vertex(prism.face, prism.high, 1);
      add_face_and_vertex(prism.face, prism.low, -1);
      each_edge(a_, prism.face,
                [&](uint32_t from, uint32_t to) { add_edges(from, to, prism.low, prism.high, 1); });
    }
  }

  /// What A itself has in common with those of faces is left out.
  void add(const SumSweeps& sweeps, uint32_t middle) {
    for (const SumSweeps::Face& sweep : sweeps.faces) {
      if (sweep.count > 1) {
        add_top(sweep.face, std::span(sweeps.farthest).subspan(sweep.first, sweep.count), middle);
        continue;
      }
      const uint32_t w = sweeps.farthest[sweep.first];
      add_face_and_vertex(sweep.face, w, 1);
      each_edge(a_, sweep.face,
                [&](uint32_t from, uint32_t to) { add_edges(from, to, middle, w, 1); });
    }
    for (const SumSweeps::Edge& sweep : sweeps.edges) {
      add_edges(sweep.from, sweep.to, middle, sweep.b_from, -1);
      add_edges(sweep.from, sweep.to, middle, sweep.b_to, 1);
      add_edges(sweep.to, sweep.from, sweep.b_from, sweep.b_to, 1);
      add_fan(sweep.from, sweep.b_from, sweep.b_to, -1);
      add_fan(sweep.to, sweep.b_from, sweep.b_to, 1);
    }
    for (const SumSweeps::Vertex& sweep : sweeps.vertices) {
      add_vertex_and_face(sweep.vertex, sweep.face, 1);
      each_edge(b_, sweep.face,
                [&](uint32_t from, uint32_t to) { add_fan(sweep.vertex, from, to, -1); });
    }
  }

  /// Sums of a face of A and an edge or a face of B that are parallel: corners of each.
  std::vector<std::vector<std::array<uint32_t, 2>>> tops;

  /// The parts that are left, each once, and how often it is there.
  std::vector<CountedPart> left() {
    std::sort(parts_.begin(), parts_.end(),
              [](const CountedPart& p, const CountedPart& q) { return p.part < q.part; });
    std::vector<CountedPart> result;
    for (size_t i = 0; i < parts_.size();) {
      CountedPart sum{parts_[i].part, 0};
      for (; i < parts_.size() && parts_[i].part == sum.part; ++i) sum.count += parts_[i].count;
      if (sum.count != 0) result.push_back(sum);
    }
    return result;
  }

  template <class Visit>
  static void each_edge(const LeafGeometry& leaf, uint32_t face, Visit visit) {
    const uint32_t begin = leaf.face_starts[face], end = leaf.face_starts[face + 1];
    for (uint32_t c = begin; c < end; ++c) {
      visit(leaf.corners[c], leaf.corners[c + 1 < end ? c + 1 : begin]);
    }
  }

 private:
  void add_vertex_and_face(uint32_t v, uint32_t g, int32_t count) {
    parts_.push_back({{Part::kVertexAndFace, {v, g, 0, 0}}, count});
  }
  void add_face_and_vertex(uint32_t f, uint32_t w, int32_t count) {
    parts_.push_back({{Part::kFaceAndVertex, {f, w, 0, 0}}, count});
  }
  /// The parallelogram that runs first along an edge of A, then along one of B.
  void add_edges(uint32_t a_from, uint32_t a_to, uint32_t b_from, uint32_t b_to, int32_t count) {
    if (a_from > a_to) std::swap(a_from, a_to), count = -count;
    if (b_from > b_to) std::swap(b_from, b_to), count = -count;
    parts_.push_back({{Part::kEdges, {a_from, a_to, b_from, b_to}}, count});
  }

  void add_fan(uint32_t v, uint32_t from, uint32_t to, int32_t count) {
    if (from > to) std::swap(from, to), count = -count;
    parts_.push_back({{Part::kVertexAndFan, {v, from, to, 0}}, count});
  }

  /// The sum of a face and of what is parallel to it, and the sides of what it sweeps.
  void add_top(uint32_t face, std::span<const uint32_t> farthest, uint32_t middle) {
    const auto corners =
        std::span(a_.corners)
            .subspan(a_.face_starts[face], a_.face_starts[face + 1] - a_.face_starts[face]);
    const Vec128 normal = WideNormal::of(a_, face).exact;
    const auto lowest = [](std::span<const uint32_t> loop, const LeafGeometry& leaf) {
      size_t low = 0;
      for (size_t i = 1; i < loop.size(); ++i) {
        if (leaf.vertices[loop[i]] < leaf.vertices[loop[low]]) low = i;
      }
      return low;
    };
    // Both run from their lowest corners on, whichever edge comes first in the turn.
    const size_t a_low = lowest(corners, a_), b_low = lowest(farthest, b_);
    const auto a_at = [&](size_t i) { return corners[(a_low + i) % corners.size()]; };
    const auto b_at = [&](size_t j) { return farthest[(b_low + j) % farthest.size()]; };
    std::vector<std::array<uint32_t, 2>>& top = tops.emplace_back();
    for (size_t i = 0, j = 0; i < corners.size() || j < farthest.size();) {
      const uint32_t v = a_at(i), w = b_at(j);
      top.push_back({v, w});
      if (j == farthest.size() ||
          (i < corners.size() && comes_first(a_.vertices[v], a_.vertices[a_at(i + 1)],
                                             b_.vertices[w], b_.vertices[b_at(j + 1)], normal))) {
        add_edges(v, a_at(++i), middle, w, 1);
      } else {
        add_fan(v, w, b_at(++j), -1);
      }
    }
  }

  /// Whether p to q comes before r to s, or beside it, in a turn to the left that begins with what
  /// leads up; both in planes with this normal.
  static bool comes_first(const IVec3& p, const IVec3& q, const IVec3& r, const IVec3& s,
                          const Vec128& normal) {
    const bool is_up = p < q, other_is_up = r < s;
    if (is_up != other_is_up) return is_up;
    const IVec3 end{p[0] + s[0] - r[0], p[1] + s[1] - r[1], p[2] + s[2] - r[2]};
    const Vec128 turn = cross(p, q, end);
    for (size_t k = 0; k < 3; ++k) {
      if (turn[k] != 0) return (turn[k] > 0) == (normal[k] > 0);
    }
    return true;
  }

  const LeafGeometry &a_, &b_;
  std::vector<CountedPart> parts_;
};

class Surface {
 public:
  Surface(const LeafGeometry& a, const LeafGeometry& b) : a_(a), b_(b) {}

  void add(const CountedPart& counted) {
    const auto& n = counted.part.names;
    loop_.clear();
    switch (counted.part.kind) {
      case Part::kVertexAndFace:
        Parts::each_edge(b_, n[1], [&](uint32_t w, uint32_t) { loop_.push_back(point(n[0], w)); });
        break;
      case Part::kFaceAndVertex:
        Parts::each_edge(a_, n[0], [&](uint32_t v, uint32_t) { loop_.push_back(point(v, n[1])); });
        break;
      case Part::kEdges:
        loop_ = {point(n[0], n[2]), point(n[1], n[2]), point(n[1], n[3]), point(n[0], n[3])};
        break;
      case Part::kVertexAndFan:
        loop_ = {point(n[0], middle()), point(n[0], n[1]), point(n[0], n[2])};
        break;
    }
    if (counted.count < 0) std::reverse(loop_.begin(), loop_.end());
    for (int32_t i = 0; i < std::abs(counted.count); ++i) add_loop();
  }
  void add(const std::vector<std::array<uint32_t, 2>>& sums) {
    loop_.clear();
    for (const auto& [v, w] : sums) loop_.push_back(point(v, w));
    add_loop();
  }

  SumSurface made;

 private:
  [[nodiscard]] uint32_t middle() const { return static_cast<uint32_t>(b_.vertices.size()) - 1; }
  void add_loop() {
    made.corners.insert(made.corners.end(), loop_.begin(), loop_.end());
    made.face_starts.push_back(static_cast<uint32_t>(made.corners.size()));
  }
  uint32_t point(uint32_t v, uint32_t w) {
    IVec3 sum;
    for (int i = 0; i < 3; ++i) sum[i] = a_.vertices[v][i] + b_.vertices[w][i];
    const auto [found, is_new] =
        number_.try_emplace(sum, static_cast<uint32_t>(made.points.size()));
    if (is_new) made.points.push_back(sum);
    return found->second;
  }

  const LeafGeometry &a_, &b_;
  std::unordered_map<IVec3, uint32_t, PointHash> number_;
  std::vector<uint32_t> loop_;
};

/// How many faces the cells have.
size_t count_faces(const LeafGeometry& a, const LeafGeometry& b, const SumCells& cells) {
  const auto corners = [](const LeafGeometry& leaf, const SumPrism& prism) {
    return leaf.face_starts[prism.face + 1] - leaf.face_starts[prism.face];
  };
  size_t count = cells.peaks.size() * b.face_count() + cells.pits.size() * a.face_count();
  for (const SumPrism& prism : cells.a_edges) count += 2 + corners(b, prism);
  for (const SumPrism& prism : cells.b_edges) count += 2 + corners(a, prism);
  return count;
}

size_t count_faces(const LeafGeometry& a, const LeafGeometry& b, const SumSweeps& sweeps) {
  size_t count = a.face_count() + a.corners.size() + sweeps.farthest.size();
  count += 5 * sweeps.edges.size();
  for (const SumSweeps::Vertex& sweep : sweeps.vertices) {
    count += 1 + b.face_starts[sweep.face + 1] - b.face_starts[sweep.face];
  }
  return count;
}

}  // namespace

std::optional<SumSurface> sum_surface(const LeafGeometry& a, const LeafGeometry& b,
                                      const SumCells& cells) {
  if (count_faces(a, b, cells) > kMostParts) return std::nullopt;
  Parts parts(a, b);
  parts.add(cells);
  Surface surface(a, b);
  for (const CountedPart& part : parts.left()) surface.add(part);
  return std::move(surface.made);
}

std::optional<SumSurface> sum_surface(const LeafGeometry& a, const LeafGeometry& b,
                                      const SumSweeps& sweeps) {
  if (count_faces(a, b, sweeps) > kMostParts) return std::nullopt;
  LeafGeometry with_middle = b;
  with_middle.vertices.push_back(sweeps.middle);
  Parts parts(a, with_middle);
  parts.add(sweeps, static_cast<uint32_t>(b.vertices.size()));
  Surface surface(a, with_middle);
  for (const CountedPart& part : parts.left()) surface.add(part);
  for (const auto& top : parts.tops) surface.add(top);
  return std::move(surface.made);
}

}  // namespace csgrun

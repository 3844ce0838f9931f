#include "engine/csg/sum_sweeps.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/csg/wide_normal.h"
#include "engine/mesh/edge_table.h"
#include "engine/mesh/face_normal.h"

namespace csgrun {
namespace {

std::span<const uint32_t> corners_of(const LeafGeometry& leaf, uint32_t face) {
  return std::span(leaf.corners)
      .subspan(leaf.face_starts[face], leaf.face_starts[face + 1] - leaf.face_starts[face]);
}

std::vector<WideNormal> normals_of(const LeafGeometry& leaf) {
  std::vector<WideNormal> result;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) result.push_back(WideNormal::of(leaf, f));
  return result;
}

/// The mean of the vertices, rounded, if that is strictly inside.
std::optional<IVec3> middle_of(const LeafGeometry& convex, const std::vector<WideNormal>& normals) {
  IVec3 middle;
  const auto count = static_cast<int64_t>(convex.vertices.size());
  for (size_t k = 0; k < 3; ++k) {
    Int128 sum = 0;
    for (const IVec3& p : convex.vertices) sum += p[k];
    middle[k] = static_cast<int64_t>(sum / count);
  }
  for (uint32_t g = 0; g < convex.face_count(); ++g) {
    const IVec3& on = convex.vertices[corners_of(convex, g)[0]];
    if (normals[g].side(difference(middle, on)) >= 0) return std::nullopt;
  }
  return middle;
}

class SweepFinder {
 public:
  SweepFinder(const LeafGeometry& a, const LeafGeometry& b)
      : a_(a),
        b_(b),
        a_normals_(normals_of(a)),
        b_normals_(normals_of(b)),
        a_table_(a),
        b_table_(b) {}

  std::optional<SumSweeps> find() {
    const auto middle = middle_of(b_, b_normals_);
    if (!middle) return std::nullopt;
    made_.middle = *middle;
    for (uint32_t f = 0; f < a_.face_count(); ++f) {
      if (!add_face(f)) return std::nullopt;
    }
    list_b_edges();
    has_convex_edge_.assign(a_.vertices.size(), 0);
    for (uint32_t v = 0; v < a_.vertices.size(); ++v) {
      for (const EdgeTable::Edge& run : a_table_.leaving(v)) {
        const auto back = a_table_.between(run.to, v);
        if (back.size() != 1 || a_table_.between(v, run.to).size() != 1) return std::nullopt;
        if (v < run.to && is_convex(run, back[0])) add_edge(v, run, back[0].face);
      }
    }
    for (uint32_t v = 0; v < a_.vertices.size(); ++v) {
      if (has_convex_edge_[v] != 0) add_vertex(v);
    }
    return std::move(made_);
  }

 private:
  struct BEdge {
    uint32_t from, to, left, right;
  };
  struct Leaving {
    IVec3 along;
    bool is_convex;
  };

  /// False if several vertices of B are farthest, and no edge or face of it has them.
  bool add_face(uint32_t f) {
    // Products are within 2^-49 of their sizes, as in WideNormal::side.
    const WideNormal& normal = a_normals_[f];
    double size = 0, most = -HUGE_VAL;
    heights_.clear();
    for (const IVec3& p : b_.vertices) {
      double height = 0;
      for (size_t k = 0; k < 3; ++k) {
        const double product = normal.near[k] * static_cast<double>(p[k]);
        height += product;
        size = std::max(size, std::fabs(product));
      }
      heights_.push_back(height);
      most = std::max(most, height);
    }
    candidates_.clear();
    for (uint32_t w = 0; w < heights_.size(); ++w) {
      if (heights_[w] >= most - size * 0x1p-46) candidates_.push_back(w);
    }
    SumSweeps::Face sweep{f, static_cast<uint32_t>(made_.farthest.size()), 0};
    if (candidates_.size() > 1) keep_farthest(normal);
    if (candidates_.size() > 1 && is_in_a_pit(f)) candidates_ = {candidates_[0]};
    if (candidates_.size() > 2) candidates_ = face_over(candidates_);
    sweep.count = static_cast<uint32_t>(candidates_.size());
    made_.farthest.insert(made_.farthest.end(), candidates_.begin(), candidates_.end());
    made_.faces.push_back(sweep);
    return sweep.count > 0;
  }

  /// Whether the angles at the edges of a face are all more than 180 degrees.
  [[nodiscard]] bool is_in_a_pit(uint32_t f) const {
    const auto corners = corners_of(a_, f);
    for (size_t i = 0; i < corners.size(); ++i) {
      const uint32_t from = corners[i], to = corners[(i + 1) % corners.size()];
      const auto back = a_table_.between(to, from);
      if (back.size() != 1 || bend({to, f}, back[0]) <= 0) return false;
    }
    return true;
  }

  void keep_farthest(const WideNormal& normal) {
    uint32_t best = candidates_[0];
    for (const uint32_t w : candidates_) {
      if (normal.side(difference(b_.vertices[w], b_.vertices[best])) > 0) best = w;
    }
    std::erase_if(candidates_, [&](uint32_t w) {
      return normal.side(difference(b_.vertices[w], b_.vertices[best])) < 0;
    });
  }

  /// The corners of the face of B whose vertices these are, as it runs; none if there is no such.
  [[nodiscard]] std::vector<uint32_t> face_over(const std::vector<uint32_t>& vertices) const {
    for (const EdgeTable::Edge& run : b_table_.leaving(vertices[0])) {
      const auto corners = corners_of(b_, run.face);
      if (corners.size() == vertices.size() &&
          std::all_of(corners.begin(), corners.end(), [&](uint32_t w) {
            return std::binary_search(vertices.begin(), vertices.end(), w);
          })) {
        return {corners.begin(), corners.end()};
      }
    }
    return {};
  }

  void list_b_edges() {
    for (uint32_t w = 0; w < b_.vertices.size(); ++w) {
      for (const EdgeTable::Edge& run : b_table_.leaving(w)) {
        if (w > run.to) continue;
        const auto back = b_table_.between(run.to, w);
        if (!back.empty()) b_edges_.push_back({w, run.to, run.face, back[0].face});
      }
    }
  }

  /// -1 if the angle between the faces of an edge is less than 180 degrees, +1 if it is more.
  [[nodiscard]] int bend(const EdgeTable::Edge& run, const EdgeTable::Edge& back) const {
    const WideNormal& normal = a_normals_[run.face];
    for (const uint32_t v : corners_of(a_, back.face)) {
      const int side = normal.side(difference(a_.vertices[v], a_.vertices[run.to]));
      if (side != 0) return side;
    }
    return 0;
  }
  [[nodiscard]] bool is_convex(const EdgeTable::Edge& run, const EdgeTable::Edge& back) const {
    return bend(run, back) < 0;
  }

  [[nodiscard]] std::span<const uint32_t> farthest(uint32_t face) const {
    return std::span(made_.farthest).subspan(made_.faces[face].first, made_.faces[face].count);
  }
  [[nodiscard]] bool have_one_farthest(uint32_t f, uint32_t g) const {
    return farthest(f).size() == 1 && farthest(g).size() == 1 && farthest(f)[0] == farthest(g)[0];
  }

  void add_edge(uint32_t from, const EdgeTable::Edge& run, uint32_t right) {
    has_convex_edge_[from] = has_convex_edge_[run.to] = 1;
    if (have_one_farthest(run.face, right)) return;
    const WideNormal &left_normal = a_normals_[run.face], &right_normal = a_normals_[right];
    const IVec3 along = difference(a_.vertices[run.to], a_.vertices[from]);
    for (const BEdge& edge : b_edges_) {
      // The great circles of normals cross where both arcs are, in the same sense: they cross, too,
      // where one is and what is opposite to the other.
      const IVec3 b_along = difference(b_.vertices[edge.to], b_.vertices[edge.from]);
      const int sense = right_normal.side(b_along);
      if (sense == 0 || left_normal.side(b_along) != -sense) continue;
      if (b_normals_[edge.left].side(along) * sense < 0) continue;
      if (b_normals_[edge.right].side(along) * sense > 0) continue;
      made_.edges.push_back(sense > 0 ? SumSweeps::Edge{from, run.to, edge.from, edge.to}
                                      : SumSweeps::Edge{from, run.to, edge.to, edge.from});
    }
  }

  void add_vertex(uint32_t v) {
    leaving_.clear();
    const auto runs = a_table_.leaving(v);
    bool one_farthest = true;
    for (const EdgeTable::Edge& run : runs) {
      leaving_.push_back({difference(a_.vertices[run.to], a_.vertices[v]),
                          is_convex(run, a_table_.between(run.to, v)[0])});
      one_farthest = one_farthest && have_one_farthest(run.face, runs[0].face);
    }
    if (one_farthest) return;
    for (uint32_t g = 0; g < b_.face_count(); ++g) {
      if (is_behind(b_normals_[g])) made_.vertices.push_back({v, g});
    }
  }

  /// Whether all edges that leave are behind, and the highest of them, or one that may be, convex.
  [[nodiscard]] bool is_behind(const WideNormal& normal) const {
    for (const Leaving& edge : leaving_) {
      if (normal.side(edge.along) > 0) return false;
    }
    double highest = -HUGE_VAL, highest_convex = -HUGE_VAL;
    const double length = std::hypot(normal.near[0], normal.near[1], normal.near[2]);
    for (const Leaving& edge : leaving_) {
      std::array<double, 3> d{};
      for (size_t k = 0; k < 3; ++k) d[k] = static_cast<double>(edge.along[k]);
      const double slope = (normal.near[0] * d[0] + normal.near[1] * d[1] + normal.near[2] * d[2]) /
                           (length * std::hypot(d[0], d[1], d[2]));
      highest = std::max(highest, slope);
      if (edge.is_convex) highest_convex = std::max(highest_convex, slope);
    }
    constexpr double kRoom = 1e-9;  // slopes are within 1e-14
    return highest_convex >= highest - kRoom;
  }

  const LeafGeometry &a_, &b_;
  const std::vector<WideNormal> a_normals_, b_normals_;
  const EdgeTable a_table_, b_table_;
  std::vector<BEdge> b_edges_;
  std::vector<uint8_t> has_convex_edge_;  ///< per vertex of A
  SumSweeps made_;
  std::vector<double> heights_;
  std::vector<uint32_t> candidates_;
  std::vector<Leaving> leaving_;
};

}  // namespace

std::optional<SumSweeps> sum_sweeps(const LeafGeometry& a, const LeafGeometry& b) {
  return SweepFinder(a, b).find();
}

}  // namespace csgrun

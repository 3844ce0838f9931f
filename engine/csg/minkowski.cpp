#include "engine/csg/minkowski.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <optional>
#include <utility>

#include "engine/bsp/union_find.h"
#include "engine/csg/convex_hull.h"
#include "engine/csg/grid.h"
#include "engine/csg/grid_solid.h"
#include "engine/csg/quantise.h"
#include "engine/csg/sum_cells.h"
#include "engine/csg/sum_sweeps.h"

namespace csgrun {
namespace {

/// So many points are kept at most before their hull is taken.
constexpr size_t kMostWaiting = size_t{1} << 20;
/// Pairs of corners: so many are summed at most, or looked at for cells.
constexpr double kMostSums = 0x1p26, kMostPairs = 0x1p30;

IVec3 sum(const IVec3& a, const IVec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

std::vector<IVec3> sums(const std::vector<IVec3>& a, const std::vector<IVec3>& b) {
  std::vector<IVec3> result;
  for (const IVec3& p : a) {
    for (const IVec3& q : b) result.push_back(sum(p, q));
    if (result.size() < kMostWaiting) continue;
    // What is flat so far stays as it is: it may become a body.
    std::vector<IVec3> extreme = convex_hull(result).vertices;
    if (!extreme.empty()) result = std::move(extreme);
  }
  return result;
}

std::vector<IVec3> corners(const LeafGeometry& boundary, uint32_t face) {
  std::vector<IVec3> result;
  for (uint32_t c = boundary.face_starts[face]; c < boundary.face_starts[face + 1]; ++c) {
    result.push_back(boundary.vertices[boundary.corners[c]]);
  }
  return result;
}

/// A vertex of each connected surface.
std::vector<IVec3> anchors(const LeafGeometry& boundary) {
  UnionFind surface(boundary.vertices.size());
  for (uint32_t f = 0; f < boundary.face_count(); ++f) {
    const uint32_t first = boundary.face_starts[f];
    for (uint32_t c = first; c < boundary.face_starts[f + 1]; ++c) {
      surface.join(boundary.corners[first], boundary.corners[c]);
    }
  }
  std::vector<IVec3> result;
  for (uint32_t v = 0; v < boundary.vertices.size(); ++v) {
    if (surface.find(v) == v) result.push_back(boundary.vertices[v]);
  }
  return result;
}

/// The sum of unions of two operands: as parts if it is the last one, else as summands.
class Sums {
 public:
  Sums(const GridStep& step, bool is_last) : step_(step), is_last_(is_last) {}

  /// False if there are too many cells.
  bool add(const Summand& a, const Summand& b) {
    if (a.is_simple && b.is_simple) return add_cells(a, b);
    // What a face of a solid adds along itself is within what the others add. Of two flat ones it
    // may be all.
    keeps_flat_ = is_flat(a) && is_flat(b);
    if (a.is_convex && b.is_convex) {
      add_hull(sums(a.points, b.points));
    } else if (b.is_convex) {
      add_faces(a, b);
    } else if (a.is_convex) {
      add_faces(b, a);
    } else {
      for (const IVec3& anchor : anchors(b.boundary)) add_moved(a, anchor);
      for (const IVec3& anchor : anchors(a.boundary)) add_moved(b, anchor);
      for (uint32_t f = 0; f < a.boundary.face_count(); ++f) {
        const std::vector<IVec3> face = corners(a.boundary, f);
        for (uint32_t g = 0; g < b.boundary.face_count(); ++g) {
          add_hull(sums(face, corners(b.boundary, g)));
        }
      }
    }
    return true;
  }

  std::vector<SumPart> parts;
  std::vector<Summand> summands;
  std::vector<SumPart> flat_parts;  ///< without a volume, beside those that have one

 private:
  bool add_cells(const Summand& a, const Summand& b) {
    if (is_last_ && a.is_convex != b.is_convex) {
      const Summand &solid = a.is_convex ? b : a, &convex = a.is_convex ? a : b;
      if (const auto sweeps = sum_sweeps(solid.boundary, convex.boundary)) {
        return add_surface(sum_surface(solid.boundary, convex.boundary, *sweeps));
      }
    }
    const SumCells cells = sum_cells(a.boundary, b.boundary);
    if (a.is_convex && b.is_convex) {
      auto surface = sum_surface(a.boundary, b.boundary, cells);
      if (surface) add_hull(surface->points);
      return surface.has_value();
    }
    if (is_last_) return add_surface(sum_surface(a.boundary, b.boundary, cells));
    for (const uint32_t v : cells.peaks) add_moved(b, a.boundary.vertices[v]);
    for (const uint32_t w : cells.pits) add_moved(a, b.boundary.vertices[w]);
    for (const SumPrism& prism : cells.a_edges) add_prism(a.boundary, prism, b.boundary);
    for (const SumPrism& prism : cells.b_edges) add_prism(b.boundary, prism, a.boundary);
    return true;
  }

  bool add_surface(std::optional<SumSurface> surface) {
    if (surface) parts.emplace_back(*std::move(surface));
    return surface.has_value();
  }

  void add_prism(const LeafGeometry& edges, const SumPrism& prism, const LeafGeometry& faces) {
    add_hull(
        sums({edges.vertices[prism.low], edges.vertices[prism.high]}, corners(faces, prism.face)));
  }

  void add_hull(const std::vector<IVec3>& points) {
    std::vector<IVec3> extreme = convex_hull(points).vertices;
    if (!extreme.empty() && is_last_) {
      parts.emplace_back(std::move(extreme));
    } else if (!extreme.empty()) {
      summands.push_back(convex_summand(std::move(extreme)));
    } else if (keeps_flat_ && is_last_) {
      flat_parts.emplace_back(points);
    } else if (keeps_flat_) {
      summands.push_back(convex_summand(points));
    }
  }

  void add_faces(const Summand& a, const Summand& convex) {
    add_moved(a, convex.points[0]);
    for (uint32_t f = 0; f < a.boundary.face_count(); ++f) {
      add_hull(sums(corners(a.boundary, f), convex.points));
    }
  }

  void add_moved(const Summand& a, const IVec3& by) {
    if (a.is_convex) {
      add_hull(sums(a.points, {by}));
      return;
    }
    const glm::dvec3 mm = to_millimetres({by}, step_)[0];
    Affine map;
    for (int i = 0; i < 3; ++i) map.m[i][3] = mm[i];
    NodePtr node = Node::transformed(map, a.node, a.node->where());
    if (is_last_) {
      parts.emplace_back(std::move(node));
      return;
    }
    Summand& moved = summands.emplace_back(a);
    for (IVec3& p : moved.boundary.vertices) p = sum(p, by);
    moved.node = std::move(node);
  }

  static bool is_flat(const Summand& s) { return s.is_convex && s.boundary.face_count() == 0; }

  const GridStep& step_;
  const bool is_last_;
  bool keeps_flat_ = false;
};

/// Whether no more is looked at, or summed, for a pair than is allowed.
bool are_few_enough(const Summand& a, const Summand& b) {
  const auto count = [](const Summand& s) {
    return static_cast<double>(std::max(s.points.size(), s.boundary.corners.size()));
  };
  return count(a) * count(b) <= (a.is_simple && b.is_simple ? kMostPairs : kMostSums);
}

/// The largest coordinate.
int64_t reach(const std::vector<Summand>& summands) {
  int64_t result = 0;
  for (const Summand& summand : summands) {
    for (const auto* points : {&summand.points, &summand.boundary.vertices}) {
      for (const IVec3& p : *points) {
        for (const int64_t x : p) result = std::max(result, std::abs(x));
      }
    }
  }
  return result;
}

}  // namespace

Summand convex_summand(std::vector<IVec3> points) {
  Summand result;
  result.boundary = convex_hull(points);
  result.is_simple = result.boundary.face_count() > 0;
  if (result.is_simple) points = result.boundary.vertices;
  result.points = std::move(points);
  result.is_convex = true;
  return result;
}

Summand solid_summand(const PolygonMesh& mesh, const std::vector<IVec3>& points, NodePtr node) {
  Summand result;
  const PreparedLeaf leaf = prepare_leaf(mesh, points, false, FaceNumbers::all(0));
  if (leaf.geometry) result.boundary = *leaf.geometry;
  result.is_simple = leaf.status == PreparedLeaf::Status::kGood;
  result.node = std::move(node);
  return result;
}

Result<std::vector<SumPart>> minkowski_sum(std::vector<std::vector<Summand>> operands,
                                           const GridStep& step) {
  // Sums of convex solids are convex, and what is not makes many pieces: these come last.
  std::stable_partition(operands.begin(), operands.end(), [](const std::vector<Summand>& list) {
    return list.size() == 1 && list[0].is_convex;
  });
  const Error too_many{ErrorCode::kLimit,
                       "minkowski: the operands have too many faces: more than 2^30 pairs of "
                       "corners, or pieces with more than 2^24 faces; sum rounder shapes with "
                       "fewer facets",
                       {}};
  for (size_t i = 1;; ++i) {
    const std::vector<Summand>&first = operands[0], &second = operands[i];
    // Signs and hulls of sums are taken in widths that allow for no more (wide_cross.h).
    if (reach(first) + reach(second) >= kFarLimit) {
      return Error{ErrorCode::kOutOfRange, "reaches too far from the origin for the grid", {}};
    }
    Sums sums(step, i + 1 == operands.size());
    for (const Summand& a : first) {
      for (const Summand& b : second) {
        if (!are_few_enough(a, b) || !sums.add(a, b)) return too_many;
      }
    }
    if (i + 1 == operands.size())
      return std::move(sums.parts.empty() ? sums.flat_parts : sums.parts);
    operands[0] = std::move(sums.summands);
  }
}

}  // namespace csgrun

// Faces that cross others, cut whole: winding numbers of boxes are counted by hand.
#include "engine/bsp/cut_surface.h"

#include <atomic>
#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "engine/mesh/leaf_check.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::test {
namespace {

struct Box {
  IVec3 lo, hi;
  bool is_turned;  ///< inside out
};
using Spot = std::array<double, 3>;

/// The surface of several boxes, and what there is to know to cut it.
struct Surface {
  explicit Surface(const std::vector<Box>& boxes) {
    std::vector<Loop> loops;
    for (const Box& box : boxes) {
      auto own = box_loops(box.lo, box.hi);
      if (box.is_turned) turn_over(own);
      loops.insert(loops.end(), own.begin(), own.end());
    }
    init(loops);
  }
  explicit Surface(const std::vector<Loop>& loops) { init(loops); }

  void init(const std::vector<Loop>& loops) {
    auto leaf = std::make_shared<LeafGeometry>(*make_leaf(loops));
    leaf->opposite = pair_edges(*leaf).opposite;
    operands.push_back(operand_of(leaf));
    crossings = find_self_intersections(*leaf);
    crosses.assign(leaf->face_count(), 0);
    for (const auto& [f, g] : crossings) crosses[f] = crosses[g] = 1;
    job.emplace(operands);
  }
  /// Edges that several boxes have are no pairs.
  [[nodiscard]] bool is_paired() const { return !operands[0].leaf->opposite.empty(); }
  std::optional<CutSurface> cut(const KernelOptions& options = {}) {
    auto result = cut_surface(*job, *operands[0].leaf, crossings, crosses, options, stats);
    EXPECT_TRUE(result);
    return result ? std::move(*result) : std::nullopt;
  }

  std::vector<Operand> operands;
  std::vector<std::array<uint32_t, 2>> crossings;
  std::vector<uint8_t> crosses;
  std::optional<Job> job;
  EvaluateStats stats;
};

int32_t winding_at(const std::vector<Box>& boxes, const Spot& p) {
  int32_t winding = 0;
  for (const Box& b : boxes) {
    bool inside = true;
    for (size_t k = 0; k < 3; ++k) {
      inside = inside && static_cast<double>(b.lo[k]) < p[k] && p[k] < static_cast<double>(b.hi[k]);
    }
    if (inside) winding += b.is_turned ? -1 : 1;
  }
  return winding;
}

struct FaceSpot {
  Spot middle{};
  int axis = 0;  ///< across the face
  double area = 0;
};
/// Of a rectangle.
FaceSpot spot_of(const std::vector<Spot>& corners) {
  FaceSpot spot;
  Spot lo = corners[0], hi = corners[0];
  for (const Spot& p : corners) {
    for (size_t k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
  }
  spot.area = 1;
  for (size_t k = 0; k < 3; ++k) {
    spot.middle[k] = (lo[k] + hi[k]) / 2;
    if (lo[k] == hi[k]) {
      spot.axis = static_cast<int>(k);
    } else {
      spot.area *= hi[k] - lo[k];
    }
  }
  return spot;
}

/// The unit squares that the faces of boxes cover.
size_t covered_squares(const std::vector<Box>& boxes) {
  std::set<std::tuple<size_t, int64_t, int64_t, int64_t>> squares;
  for (const Box& b : boxes) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int64_t i = b.lo[u]; i < b.hi[u]; ++i) {
        for (int64_t j = b.lo[v]; j < b.hi[v]; ++j) {
          squares.emplace(axis, b.lo[axis], i, j);
          squares.emplace(axis, b.hi[axis], i, j);
        }
      }
    }
  }
  return squares.size();
}

/// What is wrong with a surface that was cut; adds up its area.
void check(const std::vector<Box>& boxes, Surface& surface, const CutSurface& cut) {
  double area = 0;
  const auto look = [&](const std::vector<Spot>& corners, PlaneId support, int32_t front,
                        int32_t back, size_t which) {
    const FaceSpot spot = spot_of(corners);
    area += spot.area;
    const Plane plane = surface.job->planes().oriented(support);
    const double up = plane.a + plane.b + plane.c > 0 ? 0.25 : -0.25;
    Spot before = spot.middle, behind = spot.middle;
    before[static_cast<size_t>(spot.axis)] += up;
    behind[static_cast<size_t>(spot.axis)] -= up;
    EXPECT_EQ(front, winding_at(boxes, before)) << which;
    EXPECT_EQ(back, winding_at(boxes, behind)) << which;
  };
  ASSERT_EQ(cut.winding_of_polygon.size(), surface.job->polygons().size());
  for (uint32_t p = 0; p < surface.crosses.size(); ++p) {
    if (surface.crosses[p]) continue;
    surface.job->ensure_support(p);
    const JobPolygon& polygon = surface.job->polygons()[p];
    std::vector<Spot> corners;
    for (const uint32_t v : surface.job->corners(polygon)) {
      corners.push_back(surface.job->rounded(v));
    }
    look(corners, polygon.support, cut.winding_of_polygon[p], cut.winding_of_polygon[p] + 1, p);
  }
  ASSERT_EQ(cut.pieces.pieces.size(), cut.windings_of_piece.size());
  for (size_t i = 0; i < cut.pieces.pieces.size(); ++i) {
    const FragmentSet::Piece& piece = cut.pieces.pieces[i];
    EXPECT_TRUE(surface.crosses[piece.polygon]);
    std::vector<Spot> corners;
    for (uint32_t c = piece.first; c < piece.first + piece.count; ++c) {
      corners.push_back(cut.pieces.points[cut.pieces.corner_point[c]].rounded);
    }
    look(corners, piece.plane, cut.windings_of_piece[i][0], cut.windings_of_piece[i][1], i);
  }
  EXPECT_EQ(area, static_cast<double>(covered_squares(boxes)));
}

std::vector<Box> random_boxes(Random& random) {
  std::vector<Box> boxes(static_cast<size_t>(random.integer(1, 4)));
  for (Box& b : boxes) {
    for (size_t k = 0; k < 3; ++k) {
      b.lo[k] = random.integer(0, 8);
      b.hi[k] = b.lo[k] + random.integer(1, 9);
    }
    b.is_turned = random.integer(0, 2) == 0;
  }
  return boxes;
}

TEST(CutSurface, WindingNumbersOfBoxesAreCounted) {
  size_t cut = 0, crossing = 0;
  for (int i = 0; i < 600; ++i) {
    Random random(20000 + i);
    const std::vector<Box> boxes = random_boxes(random);
    Surface surface(boxes);
    if (!surface.is_paired()) continue;
    const auto result = surface.cut();
    if (!result) continue;
    ++cut;
    crossing += !surface.crossings.empty();
    SCOPED_TRACE(i);
    check(boxes, surface, *result);
  }
  EXPECT_GT(cut, 400u);
  EXPECT_GT(crossing, 200u);
}

const std::vector<Box> kTwo{{{0, 0, 0}, {6, 6, 6}, false}, {{3, 2, 1}, {9, 5, 4}, false}};

TEST(CutSurface, APolygonIsCutOnlyWhereOthersCrossIt) {
  Surface surface(kTwo);
  const auto result = surface.cut();
  ASSERT_TRUE(result);
  // One face of the first box is pierced by four of the second.
  EXPECT_EQ(surface.crossings.size(), 4u);
  EXPECT_EQ(result->pieces.pieces.size(), 9u + 4 * 2);
  EXPECT_GT(surface.stats.cells, 0u);
}

TEST(CutSurface, StopsWhenCancelled) {
  std::atomic<bool> cancel = false;
  KernelOptions options;
  options.cancel = &cancel;
  EXPECT_TRUE(Surface(kTwo).cut(options));
  cancel = true;
  EXPECT_FALSE(Surface(kTwo).cut(options));
}

/// A slab that n posts pierce, each with four planes; all of them stand in lines of their own.
std::vector<Box> slab_with_posts(int64_t n) {
  std::vector<Box> boxes{{{-1, -1, 0}, {5 * n, 5 * n, 2}, false}};
  for (int64_t i = 0; i < n; ++i)
    boxes.push_back({{5 * i, 5 * i, -3}, {5 * i + 2, 5 * i + 3, 9}, false});
  return boxes;
}

TEST(CutSurface, LeavesPolygonsThatManyPlanesCut) {
  constexpr auto kMost = static_cast<int64_t>(kMostCuts / 4);
  const auto boxes = slab_with_posts(kMost);
  Surface surface(boxes);
  const auto result = surface.cut();
  ASSERT_TRUE(result);
  check(boxes, surface, *result);
  EXPECT_FALSE(Surface(slab_with_posts(kMost + 1)).cut());
}

// A surface of which every polygon crosses another one has no polygon to start from.
TEST(CutSurface, LeavesWhatHangsTogetherWithNoWholePolygon) {
  const std::vector<IVec3> p{{0, 0, 0}, {20, 1, 0}, {1, 20, 0}, {2, 3, 20}};
  std::vector<Loop> loops = hull_loops(p);
  const std::vector<Loop> other =
      hull_loops({{12, 12, 11}, {-8, 11, 12}, {11, -8, 11}, {9, 9, -8}});
  loops.insert(loops.end(), other.begin(), other.end());
  Surface surface(loops);
  ASSERT_TRUE(surface.is_paired());
  ASSERT_EQ(std::count(surface.crosses.begin(), surface.crosses.end(), 1), 8);
  EXPECT_FALSE(surface.cut());
}

}  // namespace
}  // namespace csgrun::test

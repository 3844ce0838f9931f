// Faces that cross others, cut whole: winding numbers are counted, of boxes and of other convex
// solids.
#include "engine/bsp/cut_surface.h"

#include <atomic>
#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "engine/base/vec3d.h"
#include "engine/bsp/non_manifold.h"
#include "engine/bsp/union_find.h"
#include "engine/mesh/leaf_check.h"
#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_solids.h"

namespace csgrun::test::cut_surface_test {
namespace {

struct Box {
  IVec3 lo, hi;
  bool is_turned;  ///< inside out
};
using Spot = Vec3d;
using csgrun::cross;  // beside those of rational vectors
using csgrun::dot;
using csgrun::minus;

std::vector<Loop> loops_of(const std::vector<Box>& boxes) {
  std::vector<Loop> loops;
  for (const Box& box : boxes) {
    auto own = box_loops(box.lo, box.hi);
    if (box.is_turned) turn_over(own);
    loops.insert(loops.end(), own.begin(), own.end());
  }
  return loops;
}

/// The surface of several boxes, and what there is to know to cut it.
struct Surface {
  explicit Surface(const std::vector<Box>& boxes) : Surface(loops_of(boxes)) {}
  explicit Surface(const std::vector<Loop>& loops) {
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
    const LeafGeometry& leaf = *operands[0].leaf;
    if (!is_paired()) opposite = find_non_manifold(leaf).opposite;
    auto result = cut_surface(*job, leaf, is_paired() ? leaf.opposite : opposite, crossings,
                              crosses, options, stats);
    EXPECT_TRUE(result);
    return result ? std::move(*result) : std::nullopt;
  }

  std::vector<Operand> operands;
  std::vector<std::array<uint32_t, 2>> crossings;
  std::vector<uint8_t> crosses;
  std::vector<uint32_t> opposite;  ///< unless the leaf is paired
  std::optional<Job> job;
  EvaluateStats stats;
};

std::vector<Spot> corners_of(const FragmentSet& set, const FragmentSet::Piece& piece) {
  std::vector<Spot> corners;
  for (uint32_t c = piece.first; c < piece.first + piece.count; ++c) {
    corners.push_back(set.points[set.corner_point[c]].rounded);
  }
  return corners;
}

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

/// How many pieces are those of cells.
size_t left_to_cells(const CutSurface& cut) {
  size_t count = 0;
  for (size_t i = 1; i < cut.pieces.size(); ++i) count += cut.pieces[i].set.pieces.size();
  return count;
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
  for (const CutSurface::Pieces& part : cut.pieces) {
    ASSERT_EQ(part.set.pieces.size(), part.windings.size());
    for (size_t i = 0; i < part.set.pieces.size(); ++i) {
      const FragmentSet::Piece& piece = part.set.pieces[i];
      EXPECT_TRUE(surface.crosses[piece.polygon]);
      look(corners_of(part.set, piece), piece.plane, part.windings[i][0], part.windings[i][1], i);
    }
  }
  // Cells have walls anywhere; all other cuts are on the grid.
  EXPECT_NEAR(area, static_cast<double>(covered_squares(boxes)), left_to_cells(cut) > 0 ? 1e-9 : 0);
}

/// On grids of all sizes: of few steps, most faces lie in the planes of others.
std::vector<Box> random_boxes(Random& random) {
  std::vector<Box> boxes(static_cast<size_t>(random.integer(1, 4)));
  const int64_t size = random.integer(2, 8);
  for (Box& b : boxes) {
    for (size_t k = 0; k < 3; ++k) {
      b.lo[k] = random.integer(0, size);
      b.hi[k] = b.lo[k] + random.integer(1, size + 1);
    }
    b.is_turned = random.integer(0, 2) == 0;
  }
  return boxes;
}

/// So many random cases, in parts that are quick.
class RandomCuts : public ::testing::TestWithParam<int> {
 protected:
  static constexpr int kCases = 100;
  static int first() { return GetParam() * kCases; }
};
INSTANTIATE_TEST_SUITE_P(Parts, RandomCuts, ::testing::Range(0, 8));

/// Convex.
struct Solid {
  std::vector<Loop> loops;  ///< counter-clockwise from outside
  bool is_turned = false;   ///< inside out
};

Spot spot(const IVec3& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}
/// As long as twice the area.
Spot normal_of(const std::vector<Spot>& p) {
  Spot n{};
  for (size_t i = 1; i + 1 < p.size(); ++i) {
    const Spot part = cross(minus(p[i], p[0]), minus(p[i + 1], p[0]));
    for (size_t k = 0; k < 3; ++k) n[k] += part[k];
  }
  return n;
}
Spot middle_of(const std::vector<Spot>& p) {
  Spot m{};
  for (const Spot& corner : p) {
    for (size_t k = 0; k < 3; ++k) m[k] += corner[k] / static_cast<double>(p.size());
  }
  return m;
}
/// Of what is rounded: all that is not zero is far greater, on grids of few steps.
constexpr double kNothing = 1e-9;

/// Just beside a point, on the side that `way` points to.
int32_t winding_beside(const std::vector<Solid>& solids, const Spot& p, const Spot& way) {
  int32_t winding = 0;
  for (const Solid& s : solids) {
    const bool is_inside = std::all_of(s.loops.begin(), s.loops.end(), [&](const Loop& loop) {
      std::vector<Spot> corners;
      for (const IVec3& v : loop) corners.push_back(spot(v));
      const Spot n = normal_of(corners);
      const double above = dot(n, minus(p, corners[0]));
      return std::fabs(above) > kNothing ? above < 0 : dot(n, way) < 0;
    });
    if (is_inside) winding += s.is_turned ? -1 : 1;
  }
  return winding;
}

/// So that vertices are in cells of their own, each in one.
constexpr int64_t kScale = 1009;

Spot scaled(const Spot& p) { return {p[0] / kScale, p[1] / kScale, p[2] / kScale}; }

double length(const Spot& p) { return std::sqrt(dot(p, p)); }

std::vector<std::vector<Spot>> polygons_of(const Job& job) {
  std::vector<std::vector<Spot>> polygons;
  for (const JobPolygon& polygon : job.polygons()) {
    auto& corners = polygons.emplace_back();
    for (const uint32_t v : job.corners(polygon)) corners.push_back(scaled(job.rounded(v)));
  }
  return polygons;
}

/// Whether a point is in a polygon, so far from its edges at least.
bool holds(const std::vector<Spot>& polygon, const Spot& p, double inside) {
  const Spot n = normal_of(polygon);
  if (std::fabs(dot(n, minus(p, polygon[0]))) > kNothing) return false;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Spot along = minus(polygon[(i + 1) % polygon.size()], polygon[i]);
    if (dot(n, cross(along, minus(p, polygon[i]))) < inside) return false;
  }
  return true;
}

/// What is wrong with a surface of convex solids that was cut. With what lies upon them, the pieces
/// make up all that the polygons cover.
void check(const std::vector<Solid>& solids, Surface& surface, const CutSurface& cut) {
  const Job& job = *surface.job;
  const auto polygons = polygons_of(job);
  double covered = 0, found = 0;
  for (const auto& corners : polygons) covered += length(normal_of(corners));
  const auto look = [&](const std::vector<Spot>& corners, uint32_t polygon, int32_t front,
                        int32_t back, bool is_cut) {
    const Spot n = normal_of(corners), middle = middle_of(corners);
    EXPECT_TRUE(!is_cut || dot(n, normal_of(polygons[polygon])) > 0);
    EXPECT_EQ(front, winding_beside(solids, middle, n)) << polygon;
    EXPECT_EQ(back, winding_beside(solids, middle, {-n[0], -n[1], -n[2]})) << polygon;
    for (uint32_t p = 0; p < polygons.size(); ++p) {
      if (!holds(polygons[p], middle, kNothing)) continue;
      EXPECT_TRUE(!is_cut || p >= polygon);  // the first one has the pieces
      EXPECT_TRUE(p == polygon || surface.crosses[polygon]);
      found += length(n);
    }
  };
  ASSERT_EQ(cut.winding_of_polygon.size(), polygons.size());
  for (uint32_t p = 0; p < polygons.size(); ++p) {
    if (surface.crosses[p]) continue;
    look(polygons[p], p, cut.winding_of_polygon[p], cut.winding_of_polygon[p] + 1, true);
  }
  for (const CutSurface::Pieces& part : cut.pieces) {
    ASSERT_EQ(part.set.pieces.size(), part.windings.size());
    for (size_t i = 0; i < part.set.pieces.size(); ++i) {
      const FragmentSet::Piece& piece = part.set.pieces[i];
      EXPECT_TRUE(surface.crosses[piece.polygon]);
      std::vector<Spot> corners = corners_of(part.set, piece);
      for (Spot& corner : corners) corner = scaled(corner);
      look(corners, piece.polygon, part.windings[i][0], part.windings[i][1],
           &part == &cut.pieces[0]);
    }
  }
  EXPECT_NEAR(found, covered, kNothing * covered);
}

/// On a grid of few steps: corners on edges and faces, edges along others, and common planes.
std::vector<Solid> random_solids(Random& random) {
  std::vector<Solid> solids(static_cast<size_t>(random.integer(1, 3)));
  const int64_t size = random.integer(2, 5);
  for (Solid& s : solids) {
    while (s.loops.empty()) {
      std::vector<IVec3> points(static_cast<size_t>(random.integer(4, 7)));
      for (IVec3& p : points) {
        for (auto& c : p) c = random.integer(0, size);
      }
      s.loops = hull_loops(points);
    }
    s.is_turned = random.integer(0, 2) == 0;
  }
  return solids;
}

std::vector<Loop> loops_of(const std::vector<Solid>& solids) {
  std::vector<Loop> loops;
  for (const Solid& solid : solids) {
    auto own = solid.loops;
    if (solid.is_turned) turn_over(own);
    loops.insert(loops.end(), own.begin(), own.end());
  }
  for (Loop& loop : loops) {
    for (IVec3& p : loop) {
      for (auto& c : p) c *= kScale;
    }
  }
  return loops;
}

/// The same. Which comes first, and where it starts, is no matter: any does.
std::vector<Loop> shuffled_loops(Random& random, const std::vector<Solid>& solids) {
  std::vector<Loop> loops;
  for (Loop loop : loops_of(solids)) {
    const auto start = random.integer(0, static_cast<int64_t>(loop.size()) - 1);
    std::rotate(loop.begin(), loop.begin() + start, loop.end());
    loops.insert(loops.begin() + random.integer(0, static_cast<int64_t>(loops.size())), loop);
  }
  return loops;
}

/// How polygons hang together: over edges, near the ends of which there is no third polygon where
/// both cross others.
struct Connection {
  explicit Connection(const Surface& surface) : sets(surface.crosses.size()) {
    const auto polygons = polygons_of(*surface.job);
    const LeafGeometry& leaf = *surface.operands[0].leaf;
    std::vector<uint32_t> face_of(leaf.corners.size());
    for (uint32_t f = 0; f < polygons.size(); ++f) {
      for (uint32_t c = leaf.face_starts[f]; c < leaf.face_starts[f + 1]; ++c) face_of[c] = f;
    }
    for (uint32_t c = 0; c < face_of.size(); ++c) {
      const uint32_t f = face_of[c], g = face_of[leaf.opposite[c]];
      const size_t edge = c - leaf.face_starts[f], count = polygons[f].size();
      const Spot &from = polygons[f][edge], &to = polygons[f][(edge + 1) % count];
      const bool both_cross = surface.crosses[f] && surface.crosses[g];
      if (!both_cross || !has_third(polygons, f, g, from, to)) sets.join(f, g);
    }
    for (uint32_t f = 0; f < polygons.size(); ++f) {
      all.insert(sets.find(f));
      if (!surface.crosses[f]) known.insert(sets.find(f));
    }
  }
  static bool has_third(const std::vector<std::vector<Spot>>& polygons, uint32_t f, uint32_t g,
                        const Spot& from, const Spot& to) {
    constexpr double kNear = 1e-4;
    Spot p = from;
    for (size_t k = 0; k < 3; ++k) p[k] += kNear * (to[k] - from[k]);
    for (uint32_t h = 0; h < polygons.size(); ++h) {
      if (h != f && h != g && holds(polygons[h], p, -kNothing)) return true;
    }
    return false;
  }
  UnionFind sets;
  std::set<uint32_t> all, known;  ///< sets, and those with a polygon that crosses nothing
};

/// What few planes cut needs no cells, whether it hangs together with what crosses nothing or not:
/// that is counted.
struct Seen {
  int crossing = 0, alone = 0;
};
void look(Random& random, const std::vector<Solid>& solids, Seen& seen) {
  Surface surface(shuffled_loops(random, solids));
  KernelOptions options;
  options.cell_limit = 4;
  const auto result = surface.cut(options);
  if (!result) {
    ADD_FAILURE() << "contradicts itself";
    return;
  }
  check(solids, surface, *result);
  EXPECT_EQ(left_to_cells(*result), 0u);
  EXPECT_EQ(surface.stats.solved_cells, 0u);
  seen.crossing += !surface.crossings.empty();
  if (!surface.is_paired()) return;
  const Connection connection(surface);
  seen.alone += connection.known != connection.all;
}

TEST_P(RandomCuts, WindingNumbersOfBoxesAreCounted) {
  Seen seen;
  for (int i = first(); i < first() + kCases; ++i) {
    SCOPED_TRACE(i);
    auto random = Random::of_case(20000, static_cast<uint64_t>(i));
    std::vector<Solid> solids;
    for (const Box& b : random_boxes(random)) {
      solids.push_back({box_loops(b.lo, b.hi), b.is_turned});
    }
    look(random, solids, seen);
  }
  EXPECT_GT(seen.crossing, kCases / 4);
  EXPECT_GT(seen.alone, kCases / 10);
}

TEST_P(RandomCuts, WindingNumbersOfConvexSolidsAreCounted) {
  Seen seen;
  for (int i = first(); i < first() + kCases; ++i) {
    SCOPED_TRACE(i);
    auto random = Random::of_case(30000, static_cast<uint64_t>(i));
    look(random, random_solids(random), seen);
  }
  EXPECT_GT(seen.crossing, kCases / 6);
  EXPECT_GT(seen.alone, kCases / 10);
}

const std::vector<Box> kTwo{{{0, 0, 0}, {6, 6, 6}, false}, {{3, 2, 1}, {9, 5, 4}, false}};

TEST(CutSurface, APolygonIsCutOnlyWhereOthersCrossIt) {
  Surface surface(kTwo);
  const auto result = surface.cut();
  ASSERT_TRUE(result);
  // One face of the first box is pierced by four of the second.
  EXPECT_EQ(surface.crossings.size(), 4u);
  EXPECT_EQ(result->pieces[0].set.pieces.size(), 9u + 4 * 2);
  EXPECT_EQ(left_to_cells(*result), 0u);
  EXPECT_EQ(surface.stats.cells, 0u);  // rays tell
}

TEST(CutSurface, StopsWhenCancelled) {
  std::atomic<bool> cancel = false;
  KernelOptions options;
  options.cancel = &cancel;
  EXPECT_TRUE(Surface(kTwo).cut(options));
  cancel = true;
  EXPECT_FALSE(Surface(kTwo).cut(options));
}

// Nothing crosses: one ray tells.
TEST(CutSurface, StopsWhenCancelledBeforeARay) {
  Surface surface(std::vector<Box>{kTwo[0]});
  std::atomic<bool> cancel = true;
  KernelOptions options;
  options.cancel = &cancel;
  const LeafGeometry& leaf = *surface.operands[0].leaf;
  const auto result = cut_surface(*surface.job, leaf, leaf.opposite, surface.crossings,
                                  surface.crosses, options, surface.stats);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kCancelled);
}

/// With one of the faces as two triangles.
std::vector<Loop> with_triangles(std::vector<Loop> loops, size_t face) {
  const Loop q = loops[face];
  loops[face] = {q[0], q[1], q[2]};
  loops.push_back({q[0], q[2], q[3]});
  return loops;
}

// Where the edge of two polygons of one plane stands in the middle of a piece's edge.
TEST(CutSurface, TellsWhatIsCrossedByAPartOfAPlane) {
  for (size_t face = 0; face < 6; ++face) {
    const std::vector<Solid> solids{{box_loops({0, 0, 0}, {6, 6, 6}), false},
                                    {box_loops({1, 4, 2}, {2, 9, 3}), false},
                                    {with_triangles(box_loops({3, 2, 1}, {9, 5, 4}), face), false}};
    Surface surface(loops_of(solids));
    const auto result = surface.cut();
    ASSERT_TRUE(result);
    check(solids, surface, *result);
    EXPECT_EQ(left_to_cells(*result), 0u) << face;
    EXPECT_FALSE(result->pieces[0].set.pieces.empty()) << face;
  }
}

// The diagonal of a bottom that stands on a top cuts it as well, though nothing rises from there.
TEST(CutSurface, LayersAreToldPolygonByPolygon) {
  for (const bool is_turned : {false, true}) {
    const std::vector<Solid> solids{
        {box_loops({0, 0, 0}, {6, 6, 6}), false},
        {with_triangles(box_loops({2, 2, 6}, {8, 4, 8}), 0), is_turned}};
    Surface surface(loops_of(solids));
    const auto result = surface.cut();
    ASSERT_TRUE(result);
    check(solids, surface, *result);
  }
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
  EXPECT_EQ(left_to_cells(*result), 0u);
  // The top and the bottom of the slab, and no more.
  const auto more = slab_with_posts(kMost + 1);
  Surface larger(more);
  const auto rest = larger.cut();
  ASSERT_TRUE(rest);
  check(more, larger, *rest);
  std::set<uint32_t> left;
  for (size_t i = 1; i < rest->pieces.size(); ++i) {
    for (const FragmentSet::Piece& piece : rest->pieces[i].set.pieces) left.insert(piece.polygon);
  }
  EXPECT_EQ(left.size(), 2u);
}

// A surface of which every polygon crosses another one has no polygon to start from: pieces do.
TEST(CutSurface, StartsFromPiecesWhereNoPolygonIsWhole) {
  const std::vector<Solid> solids{
      {hull_loops({{0, 0, 0}, {20, 1, 0}, {1, 20, 0}, {2, 3, 20}}), false},
      {hull_loops({{12, 12, 11}, {-8, 11, 12}, {11, -8, 11}, {9, 9, -8}}), false}};
  Surface surface(loops_of(solids));
  ASSERT_TRUE(surface.is_paired());
  ASSERT_EQ(std::count(surface.crosses.begin(), surface.crosses.end(), 1), 8);
  const auto result = surface.cut();
  ASSERT_TRUE(result);
  check(solids, surface, *result);
  EXPECT_EQ(left_to_cells(*result), 0u);
  EXPECT_GT(result->pieces[0].set.pieces.size(), 16u);
}

}  // namespace
}  // namespace csgrun::test::cut_surface_test

// Which faces are untouched, whatever became of each: against their definition, face by face.
#include "engine/bsp/untouched.h"

#include <map>
#include <set>

#include <gtest/gtest.h>

#include "engine/mesh/opposite_edges.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::untouched_test {
namespace {

using test::Loop;

std::shared_ptr<LeafGeometry> leaf_of(const std::vector<Loop>& loops, bool keep_facets) {
  auto leaf = std::make_shared<LeafGeometry>(*test::make_leaf(loops, keep_facets));
  // The first face has not the first vertex.
  const auto count = static_cast<uint32_t>(leaf->vertices.size());
  std::rotate(leaf->vertices.begin(), leaf->vertices.begin() + 1, leaf->vertices.end());
  for (uint32_t& v : leaf->corners) v = (v + count - 1) % count;
  leaf->opposite = pair_edges(*leaf).opposite;
  leaf->may_touch = false;
  return leaf;
}

/// The surface of a cube in n x n squares a side: two triangles each, or one square.
std::vector<Loop> tiled_cube(test::Random& random, const IVec3& lo, int64_t n, bool with_squares) {
  std::vector<Loop> loops;
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const int64_t side : {int64_t{0}, n}) {
      for (int64_t i = 0; i < n; ++i) {
        for (int64_t j = 0; j < n; ++j) {
          const auto at = [&](int64_t x, int64_t y) {
            IVec3 p = lo;
            p[axis] += side, p[(axis + 1) % 3] += side ? x : y, p[(axis + 2) % 3] += side ? y : x;
            return p;
          };
          const IVec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          if (with_squares && random.integer(0, 9) == 0) {
            loops.push_back({a, b, c, d});
          } else if (random.integer(0, 1)) {
            loops.insert(loops.end(), {{a, b, c}, {a, c, d}});
          } else {
            loops.insert(loops.end(), {{b, c, d}, {a, b, d}});
          }
        }
      }
    }
  }
  return loops;
}

/// A leaf of any kind that counts.
std::shared_ptr<LeafGeometry> any_leaf(test::Random& random) {
  const auto kind = random.integer(0, 4);
  if (kind == 0) {  // convex, and nobody's facets
    std::vector<Loop> loops;
    while (loops.empty()) {
      std::vector<IVec3> points(static_cast<size_t>(random.integer(5, 24)));
      for (IVec3& p : points) {
        for (int64_t& c : p) c = random.integer(-4, 4);
      }
      loops = test::hull_loops(points);
    }
    // Some of its faces in triangles.
    std::vector<Loop> parts;
    for (const Loop& loop : loops) {
      if (random.integer(0, 2) == 0) {
        parts.push_back(loop);
      } else {
        for (size_t i = 1; i + 1 < loop.size(); ++i)
          parts.push_back({loop[0], loop[i], loop[i + 1]});
      }
    }
    auto leaf = leaf_of(parts, false);
    leaf->convex = true;
    return leaf;
  }
  std::vector<Loop> loops = tiled_cube(random, {0, 0, 0}, 4, kind == 1);
  if (kind == 2) {  // with a corner in common
    const IVec3 common{4, 4, 4};
    const std::vector<Loop> more = tiled_cube(random, common, 2, false);
    loops.insert(loops.end(), more.begin(), more.end());
    // In the first faces or the last ones: so its number is near zero, or the last but one.
    const bool is_last = random.integer(0, 1) != 0;
    std::stable_partition(loops.begin(), loops.end(), [&](const Loop& loop) {
      return (std::find(loop.begin(), loop.end(), common) == loop.end()) == is_last;
    });
    if (is_last) {
      // Numbers go down by one: a face whose first corner is that of number 0 makes it the last.
      const auto first = std::find_if(loops.begin(), loops.end(), [&](const Loop& loop) {
        return std::find(loop.begin(), loop.end(), common) != loop.end();
      });
      std::iter_swap(loops.begin(), first);
      std::rotate(loops[0].begin(), std::find(loops[0].begin(), loops[0].end(), common),
                  loops[0].end());
    }
  }
  // Bent, so that not all are level: some, or nearly none.
  for (Loop& loop : loops) {
    for (IVec3& p : loop) {
      const IVec3 q = p;
      p[0] = 100 * q[0] + q[1] * q[1] + (kind == 4 ? q[2] * q[2] : 0);
      if (kind != 3) continue;
      p[1] = 100 * q[1] + q[2] * q[2] + q[0] * q[0] * q[0];
      p[2] = 100 * q[2] + q[0] * q[0] + q[1] * q[1] * q[1];
    }
  }
  auto leaf = leaf_of(loops, true);
  // A few facets of several faces.
  if (kind == 3) {
    std::vector<uint32_t> facets = leaf->facet.list(leaf->face_count());
    for (size_t f = 1; f < facets.size(); ++f) {
      if (random.integer(0, 20) == 0) facets[f] = facets[f - 1];
    }
    leaf->facet = facets;
  }
  return leaf;
}

enum Fate { kNot, kKept, kFlipped };

/// A leaf and what became of its faces.
class Faces {
 public:
  Faces(const LeafGeometry& leaf, const std::vector<Fate>& fates) : leaf_(leaf), fates_(fates) {
    for (uint32_t f = 0; f < leaf.face_count(); ++f) {
      ++facet_size_[leaf.facet[f]];
      for (const uint32_t v : corners(f)) at_[v].push_back(f);
    }
    for (const auto& [v, around] : at_) is_one_fan_[v] = is_one_fan(v);
  }

  [[nodiscard]] std::vector<uint32_t> untouched(Fate fate) const {
    std::vector<uint32_t> faces;
    for (uint32_t f = 0; f < leaf_.face_count(); ++f) {
      if (fates_[f] == fate && is_apart(f)) faces.push_back(f);
    }
    return faces;
  }
  /// Vertices that some of these faces have, and others too.
  [[nodiscard]] std::vector<uint32_t> shared(const std::vector<uint32_t>& faces) const {
    std::vector<uint32_t> vertices;
    for (const auto& [v, around] : at_) {
      const auto own = std::count_if(around.begin(), around.end(), [&](uint32_t f) {
        return std::binary_search(faces.begin(), faces.end(), f);
      });
      if (own > 0 && own < static_cast<long>(around.size())) vertices.push_back(v);
    }
    return vertices;
  }

 private:
  [[nodiscard]] std::vector<uint32_t> corners(uint32_t f) const {
    return {leaf_.corners.begin() + leaf_.face_starts[f],
            leaf_.corners.begin() + leaf_.face_starts[f + 1]};
  }
  [[nodiscard]] std::set<std::pair<uint32_t, uint32_t>> edges(uint32_t f) const {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    const auto c = corners(f);
    for (size_t i = 0; i < c.size(); ++i) {
      const uint32_t a = c[i], b = c[(i + 1) % c.size()];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
    return edges;
  }
  /// Whether two faces have an edge in common; one at a vertex, if that is given.
  [[nodiscard]] bool are_neighbours(uint32_t f, uint32_t g, uint32_t vertex = ~0u) const {
    for (const auto& e : edges(f)) {
      if (edges(g).count(e) && (vertex == ~0u || e.first == vertex || e.second == vertex)) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] bool is_one_fan(uint32_t v) const {
    const std::vector<uint32_t>& around = at_.at(v);
    std::set<uint32_t> reached{around[0]};
    for (bool grows = true; grows;) {
      grows = false;
      for (const uint32_t g : around) {
        for (const uint32_t f : around) {
          if (reached.count(f) && !reached.count(g) && are_neighbours(f, g, v)) {
            grows = reached.insert(g).second;
          }
        }
      }
    }
    return reached.size() == around.size();
  }
  [[nodiscard]] bool is_level(uint32_t f, uint32_t g) const {
    const auto c = corners(f);
    const auto at = [&](uint32_t v) { return leaf_.vertices[v]; };
    const IVec3 normal =
        test::cross_of(test::sub(at(c[1]), at(c[0])), test::sub(at(c[2]), at(c[0])));
    for (const uint32_t v : corners(g)) {
      if (test::dot_of(normal, test::sub(at(v), at(c[0]))) != 0) return false;
    }
    return true;
  }
  [[nodiscard]] bool is_apart(uint32_t f) const {
    if (corners(f).size() != 3) return false;
    const bool has_facets = leaf_.facet[f] != 0;
    bool all_whole = true;
    for (const uint32_t v : corners(f)) {
      if (!is_one_fan_.at(v)) return false;
      for (const uint32_t g : at_.at(v)) {
        if (has_facets && (corners(g).size() != 3 || facet_size_.at(leaf_.facet[g]) != 1)) {
          return false;
        }
        all_whole = all_whole && fates_[g] == fates_[f];
      }
    }
    if (has_facets && all_whole) return true;
    for (const uint32_t v : corners(f)) {
      for (const uint32_t g : at_.at(v)) {
        if (g != f && are_neighbours(f, g) && is_level(f, g)) return false;
      }
    }
    return true;
  }

  const LeafGeometry& leaf_;
  const std::vector<Fate>& fates_;
  std::map<uint32_t, int> facet_size_;
  std::map<uint32_t, std::vector<uint32_t>> at_;  ///< faces, by vertex
  std::map<uint32_t, bool> is_one_fan_;
};

/// Fates that most neighbours have in common; polygons that were met are there, too.
std::vector<Fate> random_fates(test::Random& random, const Job& job, uint32_t operand,
                               std::vector<WholePolygon>& whole) {
  std::vector<Fate> fates;
  const double border = static_cast<double>(random.integer(-300, 500));
  const auto low = static_cast<Fate>(random.integer(0, 2)),
             high = static_cast<Fate>(random.integer(0, 2));
  for (uint32_t p = job.polygon_start(operand); p < job.polygon_start(operand + 1); ++p) {
    Fate fate = job.rounded(job.corners(job.polygons()[p])[0])[0] < border ? low : high;
    if (random.integer(0, 30) == 0) fate = static_cast<Fate>(random.integer(0, 2));
    const bool is_met = random.integer(0, 30) == 0;
    if (fate != kNot) whole.push_back({p, fate == kFlipped, is_met});
    fates.push_back(is_met ? kNot : fate);
  }
  return fates;
}

TEST(UntouchedFaces, AreWhatTheirDefinitionSays) {
  test::Random random(1211);
  size_t untouched = 0, others = 0, shared = 0, parts_of_frames = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Operand> operands;
    const auto count = static_cast<uint32_t>(random.integer(1, 3));
    for (uint32_t o = 0; o < count; ++o) {
      operands.push_back(test::operand_of(any_leaf(random)));
      operands.back().translation = {random.integer(-9, 9), 0, 0};
      operands.back().first_source = 10 + o;
      if (random.integer(0, 1)) operands.back().appearance = 3 + o;
      if (random.integer(0, 3) == 0) operands.back().frame = test::random_frame(random);
    }
    const Job job(operands);
    std::vector<WholePolygon> whole;
    std::vector<UntouchedPart> expected;
    std::set<uint32_t> taken;
    for (uint32_t o = 0; o < count; ++o) {
      const std::vector<Fate> fates = random_fates(random, job, o, whole);
      const LeafGeometry& leaf = *operands[o].leaf;
      const FrameMap map(operands[o].frame);
      if (map.is_mirrored()) continue;
      const Faces faces(leaf, fates);
      for (const Fate fate : {kKept, kFlipped}) {
        UntouchedPart part;
        part.leaf = operands[o].leaf;
        part.source = o;
        part.flipped = fate == kFlipped;
        part.faces = faces.untouched(fate);
        if (part.faces.empty()) continue;
        for (const uint32_t v : faces.shared(part.faces)) {
          part.shared.push_back({v, job.vertex_start(o) + v});
        }
        for (uint32_t v = 0; !map.is_identity() && v < leaf.vertices.size(); ++v) {
          part.world.push_back(job.rounded(job.vertex_start(o) + v));
        }
        for (const uint32_t f : part.faces) taken.insert(job.polygon_start(o) + f);
        untouched += part.faces.size();
        shared += part.shared.size();
        parts_of_frames += !map.is_identity();
        expected.push_back(part);
      }
    }
    std::vector<WholePolygon> left = whole;
    const auto parts = take_untouched(job, operands, {}, left);
    ASSERT_EQ(parts.size(), expected.size()) << round;
    for (size_t i = 0; i < parts.size(); ++i) {
      const Operand& operand = operands[expected[i].source];
      EXPECT_EQ(parts[i].leaf, operand.leaf);
      EXPECT_EQ(parts[i].translation, operand.translation);
      EXPECT_EQ(parts[i].source, operand.first_source);
      EXPECT_EQ(parts[i].appearance, operand.appearance);
      EXPECT_EQ(parts[i].map.is_identity(), operand.frame.is_identity);
      EXPECT_EQ(parts[i].flipped, expected[i].flipped);
      ASSERT_EQ(parts[i].faces, expected[i].faces) << round;
      ASSERT_EQ(parts[i].shared.size(), expected[i].shared.size()) << round;
      for (size_t s = 0; s < parts[i].shared.size(); ++s) {
        EXPECT_EQ(parts[i].shared[s].vertex, expected[i].shared[s].vertex);
        EXPECT_EQ(parts[i].shared[s].point, expected[i].shared[s].point);
      }
      EXPECT_EQ(parts[i].world, expected[i].world);
    }
    std::vector<uint32_t> polygons, expected_left;
    for (const WholePolygon& w : left) polygons.push_back(w.polygon);
    for (const WholePolygon& w : whole) {
      if (!taken.count(w.polygon)) expected_left.push_back(w.polygon);
    }
    ASSERT_EQ(polygons, expected_left);
    others += left.size();
  }
  EXPECT_GT(untouched, 1000u);
  EXPECT_GT(others, 1000u);
  EXPECT_GT(shared, 500u);
  EXPECT_GT(parts_of_frames, 5u);
}

// Leaves of which nobody knows enough, and a part of a result, are left as they are.
TEST(UntouchedFaces, AreNoneOfOtherOperands) {
  test::Random random(1212);
  const auto good = leaf_of(tiled_cube(random, {0, 0, 0}, 3, false), true);
  const auto count = [](const std::vector<Operand>& operands) {
    const Job job(operands);
    std::vector<WholePolygon> whole;
    for (uint32_t p = 0; p < job.polygons().size(); ++p) whole.push_back({p, false, false});
    size_t faces = 0;
    for (const UntouchedPart& part : take_untouched(job, operands, {}, whole)) {
      faces += part.faces.size();
    }
    return faces;
  };
  const auto changed = [&](auto change) {
    auto leaf = std::make_shared<LeafGeometry>(*good);
    change(*leaf);
    return count({test::operand_of(leaf)});
  };
  EXPECT_EQ(changed([](LeafGeometry&) {}), good->face_count());
  EXPECT_EQ(changed([](LeafGeometry& leaf) { leaf.may_touch = true; }), 0u);
  EXPECT_EQ(changed([](LeafGeometry& leaf) { leaf.opposite.clear(); }), 0u);
  std::vector<uint32_t> mixed = good->facet.list(good->face_count());
  std::swap(mixed[4], mixed[9]);
  EXPECT_EQ(changed([&](LeafGeometry& leaf) { leaf.facet = mixed; }), 0u);
  // Bent, without facets: none is level with another, but they are not known to be convex.
  const auto no_facets = [](LeafGeometry& leaf) {
    leaf.facet = FaceNumbers();
    for (size_t v = 0; v < leaf.vertices.size(); ++v) {
      IVec3& p = leaf.vertices[v];
      p[0] = 1000 * p[0] - p[1] * p[1] - p[2] * p[2];
      p[1] = 1000 * p[1] - p[2] * p[2] - (p[0] / 1000) * (p[0] / 1000);
      p[2] = 1000 * p[2] - (p[1] / 1000) * (p[1] / 1000) - (p[0] / 1000) * (p[0] / 1000);
    }
  };
  EXPECT_EQ(changed(no_facets), 0u);
  EXPECT_GT(changed([&](LeafGeometry& leaf) {
              no_facets(leaf);
              leaf.convex = true;
            }),
            20u);
  // The last face alone, which is level with no other.
  const std::vector<Operand> one{test::operand_of(
      leaf_of(test::hull_loops({{0, 0, 0}, {9, 0, 1}, {0, 9, 2}, {1, 2, 9}}), true))};
  const Job job(one);
  const auto last = static_cast<uint32_t>(job.polygons().size() - 1);
  std::vector<WholePolygon> whole{{last, false, false}};
  const auto parts = take_untouched(job, one, {}, whole);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].faces, std::vector<uint32_t>{last});
  EXPECT_EQ(parts[0].shared.size(), 3u);
  Operand result;
  result.boundary = *test::evaluate(test::leaf(0), {test::operand_of(good)});
  EXPECT_EQ(count({result}), 0u);
  EXPECT_EQ(count({result, test::operand_of(good)}), good->face_count());
}

// Two tetrahedra with a corner in common, which any number may name: all their other faces are
// apart.
TEST(UntouchedFaces, AreNoneAtACornerWithTwoFans) {
  const std::vector<Loop> one = test::hull_loops({{0, 0, 0}, {9, 1, 2}, {2, 9, 1}, {1, 2, 9}}),
                          other =
                              test::hull_loops({{0, 0, 0}, {-9, 1, -2}, {-2, 9, 1}, {-1, 2, -9}});
  for (uint32_t turn = 0; turn < 7; ++turn) {
    std::vector<Loop> loops = one;
    loops.insert(loops.end(), other.begin(), other.end());
    auto leaf = std::make_shared<LeafGeometry>(*leaf_of(loops, true));
    ASSERT_EQ(leaf->vertices.size(), 7u);
    ASSERT_FALSE(leaf->opposite.empty());
    std::rotate(leaf->vertices.begin(), leaf->vertices.begin() + turn, leaf->vertices.end());
    for (uint32_t& v : leaf->corners) v = (v + 7 - turn) % 7;
    const std::vector<Operand> operands{test::operand_of(leaf)};
    const Job job(operands);
    std::vector<WholePolygon> whole;
    for (uint32_t p = 0; p < 8; ++p) whole.push_back({p, false, false});
    const auto parts = take_untouched(job, operands, {}, whole);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].faces.size(), 2u) << turn;
    for (const uint32_t f : parts[0].faces) {
      for (const uint32_t v : parts[0].triangle(f)) {
        EXPECT_NE(leaf->vertices[v], (IVec3{0, 0, 0})) << turn;
      }
    }
  }
}

// A square of a facet that is kept may leave out its corners, so that nothing is apart there: also
// where what is beside it became of different things, square and triangles in any order.
TEST(UntouchedFaces, AreNoneBesideFacesThatMayHaveNoCorners) {
  const std::vector<Loop> pyramid{{{0, 0, 0}, {0, 9, 0}, {9, 9, 0}, {9, 0, 0}},
                                  {{0, 0, 0}, {9, 0, 0}, {4, 5, 7}},
                                  {{9, 0, 0}, {9, 9, 0}, {4, 5, 7}},
                                  {{9, 9, 0}, {0, 9, 0}, {4, 5, 7}},
                                  {{0, 9, 0}, {0, 0, 0}, {4, 5, 7}}};
  for (size_t turn = 0; turn < 5; ++turn) {
    std::vector<Loop> loops = pyramid;
    std::rotate(loops.begin(), loops.begin() + static_cast<long>(turn), loops.end());
    for (uint32_t kept = 0; kept < 32; ++kept) {
      const std::vector<Operand> operands{test::operand_of(leaf_of(loops, true))};
      const Job job(operands);
      std::vector<WholePolygon> whole;
      for (uint32_t p = 0; p < 5; ++p) {
        if (kept >> p & 1) whole.push_back({p, false, false});
      }
      EXPECT_TRUE(take_untouched(job, operands, {}, whole).empty()) << turn << " kept " << kept;
    }
  }
}

}  // namespace
}  // namespace csgrun::untouched_test

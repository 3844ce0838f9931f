// Contacts of all pairs, and what is counted on the way, against pairs that are looked at one by
// one.
#include "engine/bsp/find_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "engine/bsp/pair_cells.h"
#include "engine/bsp/sign_stats.h"
#include "engine/bsp/wide_triangles.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::find_contacts_test {
namespace {

bool overlap(const PolygonBox& a, const PolygonBox& b) {
  for (size_t k = 0; k < 3; ++k) {
    if (a.lo[k] > b.hi[k] || b.lo[k] > a.hi[k]) return false;
  }
  return true;
}

using Pairs = std::vector<std::pair<uint32_t, uint32_t>>;

/// What looking at all pairs of a job, one after another, gives.
struct OneByOne {
  Pairs contacts;
  std::vector<uint8_t> touched, in_flat_corner;
  EvaluateStats stats;

  explicit OneByOne(const std::vector<Operand>& operands) {
    Job job(operands);
    touched.assign(job.vertex_count(), 0);
    in_flat_corner.assign(job.polygons().size(), 0);
    PairTest test(job), with_planes(job);
    Pairs unsure;
    Contact contact{};
    const auto take = [&](Meeting meeting, const PairTest& by) {
      if (meeting == Meeting::kContact) contacts.emplace_back(contact.p, contact.q);
      if (meeting == Meeting::kFlatCorner) {
        in_flat_corner[contact.p] = in_flat_corner[contact.q] = 1;
      }
      std::vector<uint32_t> vertices;
      if (!contact.is_plain) by.add_touching_vertices(contact, vertices);
      for (const uint32_t v : vertices) touched[v] = 1;
    };
    for (uint32_t q = 0; q < job.polygons().size(); ++q) {
      for (uint32_t p = 0; p < q; ++p) {
        if (job.polygons()[p].operand == job.polygons()[q].operand) continue;
        if (!overlap(job.boxes()[p], job.boxes()[q])) continue;
        const Meeting meeting = test.run(p, q, nullptr, contact);
        if (meeting == Meeting::kUndecided) {
          unsure.emplace_back(p, q);
        } else if (meeting != Meeting::kApart) {
          take(meeting, test);
        }
      }
    }
    for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
    CellGeometry planes(job.planes(), &job);
    for (const auto& [p, q] : unsure) {
      const Meeting meeting = with_planes.run(p, q, &planes, contact);
      if (meeting != Meeting::kApart) take(meeting, with_planes);
    }
    add_signs(stats, planes.counters);
    stats.sign_filter += test.signs().filtered;
    stats.sign_exact[1] += test.signs().exact;  // 128 bits
    std::sort(contacts.begin(), contacts.end());
  }
};

/// In how many cells some pair is not plainly apart.
uint64_t critical_cells(const Job& job, const PairCells& cells) {
  uint64_t count = 0;
  CellPairs pairs({});
  PairTest test(job);
  for (const PairCells::Cell& cell : cells.cells) {
    bool any = false;
    pairs.visit(job, cells, cell, [&](uint32_t p, uint32_t q) {
      Contact contact{};
      any = any || test.run(p, q, nullptr, contact) != Meeting::kApart;
    });
    count += any;
  }
  return count;
}

TEST(FindContacts, GivesAndCountsWhatPairsDo) {
  test::Random random(1301);
  uint64_t filtered = 0, exact = 0, by_planes = 0, critical = 0, contacts = 0, sifted = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<Operand> operands;
    for (int o = 0; o < 3; ++o) {
      operands.push_back(test::operand_of(test::random_leaf(random)));
      // Far out doubles say less, in a frame they are not exact.
      for (int64_t& t : operands.back().translation) {
        t = random.integer(-2, 2) + (i % 3 == 1 ? 1 << 27 : 0);
      }
    }
    if (i % 3 == 2) {
      const Frame frame = test::random_frame(random);
      for (Operand& o : operands) o.frame = frame;
    }
    const OneByOne expected(operands);
    Job job(operands);
    KernelOptions options;
    options.cell_limit = static_cast<uint32_t>(random.integer(1, 9));
    EvaluateStats stats;
    stats.sign_filter = 1000, stats.sign_symbolic = 2000, stats.critical_cells = 3000;
    stats.sign_exact[1] = 4000;
    const Contacts found = find_contacts(job, {}, options, stats);
    Pairs pairs;
    for (const Contact& c : found.contacts) pairs.emplace_back(c.p, c.q);
    std::sort(pairs.begin(), pairs.end());
    ASSERT_EQ(pairs, expected.contacts) << i;
    ASSERT_EQ(found.touched, expected.touched) << i;
    ASSERT_EQ(found.in_flat_corner, expected.in_flat_corner) << i;
    const PairCells cells = find_pair_cells(job, {}, options);
    const bool is_sifted = std::any_of(cells.cells.begin(), cells.cells.end(),
                                       [](const auto& c) { return c.count >= kCrowd; });
    const auto agrees = [&](uint64_t counted, uint64_t all) {
      return is_sifted ? counted <= all : counted == all;
    };
    sifted += is_sifted;
    EXPECT_TRUE(agrees(stats.sign_filter, 1000 + expected.stats.sign_filter)) << i;
    EXPECT_TRUE(agrees(stats.sign_symbolic, 2000 + expected.stats.sign_symbolic)) << i;
    for (size_t t = 0; t < stats.sign_exact.size(); ++t) {
      const uint64_t all = (t == 1 ? 4000 : 0) + expected.stats.sign_exact[t];
      EXPECT_TRUE(agrees(stats.sign_exact[t], all)) << i;
    }
    EXPECT_EQ(stats.critical_cells, 3000 + critical_cells(job, cells)) << i;
    EXPECT_EQ(stats.solved_cells, cells.cells.size()) << i;
    EXPECT_EQ(stats.surface_cells, cells.surface) << i;
    EXPECT_EQ(stats.cells, cells.visited) << i;
    filtered += expected.stats.sign_filter;
    (i % 3 == 2 ? by_planes : exact) +=
        std::accumulate(expected.stats.sign_exact.begin(), expected.stats.sign_exact.end(), 0ull);
    critical += stats.critical_cells - 3000;
    contacts += pairs.size();
  }
  EXPECT_GT(filtered, 1000u);
  EXPECT_GT(exact, 1000u);
  EXPECT_GT(by_planes, 100u);
  EXPECT_GT(critical, 100u);
  EXPECT_GT(contacts, 1000u);
  EXPECT_GT(sifted, 1u);
  EXPECT_LT(sifted, 30u);
}

/// A closed surface of small triangles: a ball of so many rings, with bumps.
LeafGeometry bumpy_ball(test::Random& random, int64_t radius, uint32_t rings) {
  LeafGeometry leaf;
  const uint32_t around = 2 * rings;
  const auto add = [&](double polar, double turn) {
    const double r = static_cast<double>(radius + random.integer(-radius / 50, radius / 50));
    leaf.vertices.push_back({std::llround(r * std::sin(polar) * std::cos(turn)),
                             std::llround(r * std::sin(polar) * std::sin(turn)),
                             std::llround(r * std::cos(polar))});
  };
  constexpr double kPi = 3.14159265358979;
  for (uint32_t ring = 1; ring < rings; ++ring) {
    for (uint32_t i = 0; i < around; ++i) add(kPi * ring / rings, 2 * kPi * i / around);
  }
  add(0, 0);
  add(kPi, 0);
  const uint32_t top = (rings - 1) * around, bottom = top + 1;
  const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
    leaf.corners.insert(leaf.corners.end(), {a, b, c});
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  };
  for (uint32_t i = 0; i < around; ++i) {
    const uint32_t next = (i + 1) % around;
    triangle(top, i, next);
    for (uint32_t ring = 0; ring + 2 < rings; ++ring) {
      const uint32_t a = ring * around, b = a + around;
      triangle(a + i, b + i, b + next);
      triangle(a + i, b + next, a + next);
    }
    triangle(bottom, top - around + next, top - around + i);
  }
  return leaf;
}

/// A cone from a ring, aslant: triangles as long as the whole, to the tip and to the middle below.
LeafGeometry slanting_cone(test::Random& random, int64_t radius, uint32_t around) {
  LeafGeometry leaf;
  const int64_t a = random.integer(1, radius), b = random.integer(1, radius);
  for (uint32_t i = 0; i < around; ++i) {
    const double turn = 6.28318530717959 * i / around;
    const double x = std::cos(turn) * static_cast<double>(radius),
                 y = std::sin(turn) * static_cast<double>(radius);
    leaf.vertices.push_back({std::llround(x), std::llround(y), std::llround(x / 2 - y / 3)});
  }
  leaf.vertices.push_back({a, b, 2 * radius});
  leaf.vertices.push_back({0, 0, 0});
  for (uint32_t i = 0; i < around; ++i) {
    const uint32_t next = (i + 1) % around;
    for (const auto& t : {std::array{i, next, around}, std::array{next, i, around + 1}}) {
      leaf.corners.insert(leaf.corners.end(), t.begin(), t.end());
      leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
    }
  }
  return leaf;
}

// Long triangles that stand aslant have much of the other surface in their boxes: they are held
// against it one by one.
TEST(FindContacts, WideTrianglesMeetWhatPairsDo) {
  uint64_t wide_ones = 0, visited = 0, overlaps = 0, both = 0, contacts = 0;
  for (int i = 0; i < 24; ++i) {
    test::Random random(5600 + i);
    const int64_t radius = random.integer(1000, 100000000);
    std::vector<LeafGeometry> leaves{bumpy_ball(random, radius, 16),
                                     slanting_cone(random, radius, 60)};
    if (i % 3 == 2) leaves[0] = slanting_cone(random, radius, 90);
    if (i % 2 == 1) std::swap(leaves[0], leaves[1]);
    std::vector<Operand> operands;
    for (LeafGeometry& leaf : leaves) {
      operands.push_back(test::operand_of(std::make_shared<LeafGeometry>(std::move(leaf))));
      for (int64_t& t : operands.back().translation) t = random.integer(-radius / 4, radius / 4);
    }
    const OneByOne expected(operands);
    Job job(operands);
    const WideTriangles wide(job);
    std::vector<uint8_t> covered(job.polygons().size());
    for (uint8_t& c : covered) c = random.integer(0, 1) != 0;
    std::array<Pairs, 2> pairs;
    for (const bool with_covered : {false, true}) {
      for (const uint32_t p : wide.list()) {
        wide.visit_pairs(job, with_covered ? covered : std::vector<uint8_t>(), p,
                         [&](uint32_t first, uint32_t second) {
                           EXPECT_LT(first, second);
                           pairs[with_covered].emplace_back(first, second);
                         });
      }
      std::sort(pairs[with_covered].begin(), pairs[with_covered].end());
      // Each of them once.
      EXPECT_EQ(std::unique(pairs[with_covered].begin(), pairs[with_covered].end()),
                pairs[with_covered].end());
    }
    std::erase_if(pairs[0], [&](const auto& p) { return covered[p.first] && covered[p.second]; });
    EXPECT_EQ(pairs[0], pairs[1]);
    for (const uint32_t p : wide.list()) {
      for (uint32_t q = 0; q < job.polygons().size(); ++q) {
        overlaps += job.polygons()[q].operand != job.polygons()[p].operand &&
                    overlap(job.boxes()[p], job.boxes()[q]);
      }
    }
    for (const auto& covering : {std::vector<uint8_t>(), covered}) {
      Pairs meeting = expected.contacts;
      if (!covering.empty()) {
        std::erase_if(meeting,
                      [&](const auto& p) { return covered[p.first] && covered[p.second]; });
      }
      EvaluateStats stats;
      Pairs found;
      PlainlyCovered plainly;
      plainly.polygons = covering;
      for (const Contact& c : find_contacts(job, plainly, {}, stats).contacts) {
        found.emplace_back(c.p, c.q);
      }
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, meeting) << i;
    }
    contacts += expected.contacts.size();
    visited += pairs[1].size();
    wide_ones += wide.list().size();
    both += !wide.list().empty() && wide.list().front() < job.polygon_start(1) &&
            wide.list().back() >= job.polygon_start(1);
  }
  EXPECT_GT(wide_ones, 500u);
  EXPECT_GT(both, 1u);
  EXPECT_GT(contacts, 1000u);
  EXPECT_GT(overlaps, 5 * visited);
}

TEST(FindContacts, WideTrianglesNeedOneOtherOperandAndBoxesThatEnd) {
  test::Random random(77);
  const auto cone = std::make_shared<LeafGeometry>(slanting_cone(random, 100000, 60));
  const auto ball = std::make_shared<LeafGeometry>(bumpy_ball(random, 100000, 16));
  std::vector<Operand> operands{test::operand_of(ball), test::operand_of(cone)};
  EXPECT_FALSE(WideTriangles(Job(operands)).list().empty());
  EXPECT_TRUE(WideTriangles(Job({operands[1], operands[1], operands[0]})).list().empty());
  EXPECT_TRUE(WideTriangles(Job({operands[1]})).list().empty());
  // Boxes end there, on either side; what is of one operand only does no good, either.
  for (size_t axis = 0; axis < 3; ++axis) {
    for (const int64_t far : {int64_t{1} << 30, -(int64_t{1} << 30)}) {
      for (const bool both : {true, false}) {
        operands[0].translation = operands[1].translation = {0, 0, 0};
        operands[1].translation[axis] = far;
        if (both) operands[0].translation[axis] = far;
        EXPECT_TRUE(WideTriangles(Job(operands)).list().empty());
      }
    }
  }
}

// Fans around one corner that lie on one another: each sliver meets the one on it and the two
// beside that one, and of the others it has but the corner.
TEST(FindContacts, OfFansOnOneAnother) {
  constexpr uint32_t kSlivers = 40;
  for (const int64_t lean : {0, 1, -3}) {
    std::vector<test::Loop> below, above;
    const auto rim = [&](int64_t i) { return IVec3{i, 60, lean * i}; };
    for (int64_t i = 0; i < kSlivers; ++i) {
      below.push_back({{0, 0, 0}, rim(i), rim(i + 1)});
      above.push_back({{0, 0, 0}, rim(i + 1), rim(i)});
    }
    const std::vector<Operand> operands{test::operand_of(test::make_leaf(below)),
                                        test::operand_of(test::make_leaf(above))};
    const Job job(operands);
    Job other(operands);
    EvaluateStats stats;
    const Contacts found = find_contacts(other, {}, {}, stats);
    EXPECT_EQ(found.contacts.size(), 3 * kSlivers - 2);
    EXPECT_EQ(found.in_flat_corner, std::vector<uint8_t>(2 * kSlivers, 1));
    EXPECT_EQ(found.touched, std::vector<uint8_t>(job.vertex_count(), 1));
  }
}

}  // namespace
}  // namespace csgrun::find_contacts_test

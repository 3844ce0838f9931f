// Contacts of all pairs, and what is counted on the way, against pairs that are looked at one by
// one.
#include "engine/bsp/find_contacts.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "engine/bsp/pair_cells.h"
#include "engine/bsp/sign_stats.h"
#include "tests/support/kernel_case.h"
#include "tests/support/random_frames.h"

namespace csgrun {
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
  std::vector<uint8_t> touched;
  EvaluateStats stats;

  explicit OneByOne(const std::vector<Operand>& operands) {
    Job job(operands);
    touched.assign(job.vertex_count(), 0);
    PairTest test(job), with_planes(job);
    Pairs unsure;
    Contact contact{};
    const auto take = [&](const PairTest& by) {
      contacts.emplace_back(contact.p, contact.q);
      std::vector<uint32_t> vertices;
      if (!contact.is_plain) by.add_touching_vertices(contact, vertices);
      for (const uint32_t v : vertices) touched[v] = 1;
    };
    for (uint32_t q = 0; q < job.polygons().size(); ++q) {
      for (uint32_t p = 0; p < q; ++p) {
        if (job.polygons()[p].operand == job.polygons()[q].operand) continue;
        if (!overlap(job.boxes()[p], job.boxes()[q])) continue;
        const Meeting meeting = test.run(p, q, nullptr, contact);
        if (meeting == Meeting::kContact) take(test);
        if (meeting == Meeting::kUndecided) unsure.emplace_back(p, q);
      }
    }
    for (uint32_t p = 0; p < job.polygons().size(); ++p) job.ensure_planes(p);
    CellGeometry planes(job.planes(), &job);
    for (const auto& [p, q] : unsure) {
      if (with_planes.run(p, q, &planes, contact) == Meeting::kContact) take(with_planes);
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

}  // namespace
}  // namespace csgrun

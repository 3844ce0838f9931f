#include "engine/bsp/find_contacts.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/bsp/near_faces.h"
#include "engine/bsp/near_pairs.h"
#include "engine/bsp/pair_cells.h"
#include "engine/bsp/parallel_runs.h"
#include "engine/bsp/sign_stats.h"
#include "engine/bsp/wide_triangles.h"

namespace csgrun {
namespace {

/// The contacts of so many runs are copied by one thread.
constexpr size_t kRunsAtOnce = 32;

/// What one run of cells gives.
struct Found {
  std::vector<Contact> contacts;
  std::vector<uint32_t> touching;  ///< vertices
  std::vector<std::pair<uint32_t, uint32_t>> unsure;
  uint64_t critical = 0;
  uint64_t filtered = 0, exact = 0;  ///< signs
};

/// What one thread works with.
struct Looker {
  PairTest test;
  CellPairs pairs;
};

/// Tests the pairs of a cell, or of a wide triangle, which each(visit) calls visit(p, q) for.
template <class Each>
void look_at(PairTest& test, Each&& each, Found& out) {
  bool critical = false;
  Contact contact;
  each([&](uint32_t p, uint32_t q) {
    const Meeting meeting = test.run(p, q, nullptr, contact);
    if (meeting == Meeting::kApart) return;
    critical = true;
    if (meeting == Meeting::kUndecided) {
      out.unsure.emplace_back(p, q);
      return;
    }
    out.contacts.push_back(contact);
    if (!contact.is_plain) test.add_touching_vertices(contact, out.touching);
  });
  out.critical += critical;
}

/// Pairs that need planes, which are made one after another.
void decide_unsure(Job& job, const std::vector<Found>& found, Contacts& result,
                   EvaluateStats& stats) {
  bool any = false;
  for (const Found& f : found) {
    for (const auto& [p, q] : f.unsure) {
      job.ensure_planes(p);
      job.ensure_planes(q);
      any = true;
    }
  }
  if (!any) return;
  CellGeometry planes(job.planes(), &job);
  PairTest test(job);
  Contact contact;
  std::vector<uint32_t> touching;
  for (const Found& f : found) {
    for (const auto& [p, q] : f.unsure) {
      if (test.run(p, q, &planes, contact) != Meeting::kContact) continue;
      result.contacts.push_back(contact);
      if (!contact.is_plain) test.add_touching_vertices(contact, touching);
    }
  }
  for (const uint32_t v : touching) result.touched[v] = 1;
  add_signs(stats, planes.counters);
}

}  // namespace

Contacts find_contacts(Job& job, std::span<const uint8_t> covered, const KernelOptions& options,
                       EvaluateStats& stats) {
  const NearPairs* const near = job.near_faces() ? job.near_faces()->pairs.get() : nullptr;
  std::optional<WideTriangles> wide;
  PairCells cells;
  if (!near) {
    wide.emplace(job);
    cells = find_pair_cells(job, covered, options, wide->is_wide());
  }
  // What is looked at: cells of polygons, wide triangles, cells of pairs.
  const std::array<size_t, 3> counts{cells.cells.size(), wide ? wide->list().size() : 0,
                                     near ? near->starts.size() - 1 : 0};
  std::array<size_t, 4> first_run{};
  for (size_t k = 0; k < 3; ++k) first_run[k + 1] = first_run[k] + run_count(counts[k]);
  std::vector<Found> found(first_run[3]);
  const auto look = [&](Looker& looker, size_t kind, size_t i, Found& out) {
    const auto each = [&](auto visit) {
      if (kind == 0) return looker.pairs.visit(job, cells, cells.cells[i], visit);
      if (kind == 1) return wide->visit_pairs(job, covered, wide->list()[i], visit);
      for (uint32_t p = near->starts[i]; p < near->starts[i + 1]; ++p) {
        const auto [first, second] = near->pairs[p];
        if (covered.empty() || !covered[first] || !covered[second]) visit(first, second);
      }
    };
    look_at(looker.test, each, out);
  };
  for_each_run(
      found.size(), options,
      [&] {
        return Looker{PairTest(job), CellPairs(covered)};
      },
      [&](Looker& looker, size_t run) {
        Found& out = found[run];
        const PairTest& test = looker.test;
        const uint64_t filtered = test.signs().filtered, exact = test.signs().exact;
        size_t kind = 0;
        while (run >= first_run[kind + 1]) ++kind;
        const size_t begin = (run - first_run[kind]) * kCellsPerRun,
                     end = std::min(counts[kind], begin + kCellsPerRun);
        for (size_t i = begin; i < end; ++i) look(looker, kind, i, out);
        out.filtered = test.signs().filtered - filtered;
        out.exact = test.signs().exact - exact;
      });
  stats.cells += cells.visited + counts[1] + (near ? near->visited : 0);
  stats.solved_cells += counts[0] + counts[1] + counts[2];
  stats.surface_cells += cells.surface + counts[1] + (near ? near->surface : 0);
  Contacts result;
  result.touched.assign(job.vertex_count(), 0);
  std::vector<size_t> starts(found.size());  // of the contacts of each run
  size_t total = 0;
  for (size_t run = 0; run < found.size(); ++run) {
    starts[run] = std::exchange(total, total + found[run].contacts.size());
  }
  result.contacts.resize(total);
  for_each_part(found.size(), kRunsAtOnce, [&](size_t, size_t begin, size_t end) {
    for (size_t run = begin; run < end; ++run) {
      std::copy(found[run].contacts.begin(), found[run].contacts.end(),
                result.contacts.begin() + static_cast<long>(starts[run]));
    }
  });
  for (const Found& f : found) {
    for (const uint32_t v : f.touching) result.touched[v] = 1;
    stats.critical_cells += f.critical;
    stats.sign_filter += f.filtered;
    stats.sign_exact[1] += f.exact;
  }
  decide_unsure(job, found, result, stats);
  return result;
}

}  // namespace csgrun

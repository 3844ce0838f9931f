#include "engine/bsp/find_contacts.h"

#include <algorithm>
#include <array>
#include <utility>

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
  const WideTriangles wide(job);
  const PairCells cells = find_pair_cells(job, covered, options, wide.is_wide());
  const size_t cell_runs = run_count(cells.cells.size()), wide_runs = run_count(wide.list().size());
  std::vector<Found> found(cell_runs + wide_runs);
  const auto each_of_run = [](size_t count, size_t run, auto&& visit) {
    const size_t end = std::min(count, (run + 1) * kCellsPerRun);
    for (size_t i = run * kCellsPerRun; i < end; ++i) visit(i);
  };
  for_each_run(
      found.size(), options,
      [&] {
        return Looker{PairTest(job), CellPairs(covered)};
      },
      [&](Looker& looker, size_t run) {
        Found& out = found[run];
        PairTest& test = looker.test;
        const uint64_t filtered = test.signs().filtered, exact = test.signs().exact;
        if (run < cell_runs) {
          each_of_run(cells.cells.size(), run, [&](size_t c) {
            look_at(
                test, [&](auto visit) { looker.pairs.visit(job, cells, cells.cells[c], visit); },
                out);
          });
        } else {
          each_of_run(wide.list().size(), run - cell_runs, [&](size_t i) {
            look_at(
                test, [&](auto visit) { wide.visit_pairs(job, covered, wide.list()[i], visit); },
                out);
          });
        }
        out.filtered = test.signs().filtered - filtered;
        out.exact = test.signs().exact - exact;
      });
  stats.cells += cells.visited + wide.list().size();
  stats.solved_cells += cells.cells.size() + wide.list().size();
  stats.surface_cells += cells.surface + wide.list().size();
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

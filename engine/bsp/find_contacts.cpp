#include "engine/bsp/find_contacts.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <span>
#include <utility>

#include "engine/bsp/near_faces.h"
#include "engine/bsp/near_pairs.h"
#include "engine/bsp/pair_cells.h"
#include "engine/bsp/parallel_runs.h"
#include "engine/bsp/point_index.h"
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

/// The pairs that may meet, in lots: of a cell of polygons, of a wide triangle, or of a cell for
/// which they were found before there was a job.
class Candidates {
 public:
  Candidates(const Job& job, const PlainlyCovered& plainly, const KernelOptions& options)
      : job_(job), plainly_(plainly), covered_(plainly.polygons) {
    if (job.near_faces()) near_ = job.near_faces()->pairs.get();
    if (near_) {
      near_cells_ = near_->starts.size() - 1;
      return;
    }
    wide_.emplace(job);
    // There are no wide triangles but among two operands, and nothing is hidden there.
    cells_ = find_pair_cells(job, covered_, options,
                             plainly.hidden.empty() ? wide_->is_wide() : plainly.hidden);
  }

  [[nodiscard]] size_t lots() const { return cells_.cells.size() + wide_count() + near_cells_; }
  /// Calls visit(p, q), p < q, for the pairs of a lot, but for those of two covered polygons, and
  /// those that meet within a remover, of which there are none among two operands.
  template <class Visit>
  void visit_lot(size_t lot, CellPairs& pairs, Visit&& visit) const {
    if (lot < cells_.cells.size()) {
      return pairs.visit(job_, cells_, cells_.cells[lot], [&](uint32_t p, uint32_t q) {
        if (!plainly_.meet_within(job_, p, q)) visit(p, q);
      });
    }
    lot -= cells_.cells.size();
    if (lot < wide_count()) return wide_->visit_pairs(job_, covered_, wide_->list()[lot], visit);
    lot -= wide_count();
    for (uint32_t i = near_->starts[lot]; i < near_->starts[lot + 1]; ++i) {
      const auto [p, q] = near_->pairs[i];
      if (covered_.empty() || !covered_[p] || !covered_[q]) visit(p, q);
    }
  }
  void count(EvaluateStats& stats) const {
    stats.cells += cells_.visited + wide_count() + (near_ ? near_->visited : 0);
    stats.solved_cells += lots();
    stats.surface_cells += cells_.surface + wide_count() + (near_ ? near_->surface : 0);
  }

 private:
  [[nodiscard]] size_t wide_count() const { return wide_ ? wide_->list().size() : 0; }

  const Job& job_;
  const PlainlyCovered& plainly_;
  const std::span<const uint8_t> covered_;
  const NearPairs* near_ = nullptr;
  size_t near_cells_ = 0;
  std::optional<WideTriangles> wide_;
  PairCells cells_;
};

/// Takes note of a pair that meets.
template <class List>
void take(Meeting meeting, const Contact& contact, const PairTest& test, List& contacts,
          std::vector<uint32_t>& touching, std::span<uint8_t> in_flat_corner) {
  if (!contact.is_plain) test.add_touching_vertices(contact, touching);
  if (meeting == Meeting::kContact) {
    contacts.push_back(contact);
    return;
  }
  for (const uint32_t polygon : {contact.p, contact.q}) {
    std::atomic_ref(in_flat_corner[polygon]).store(1, std::memory_order_relaxed);
  }
}

void look_at(const Candidates& candidates, size_t lot, Looker& looker, Found& out,
             std::span<uint8_t> in_flat_corner) {
  bool critical = false;
  Contact contact;
  PairTest& test = looker.test;
  candidates.visit_lot(lot, looker.pairs, [&](uint32_t p, uint32_t q) {
    const Meeting meeting = test.run(p, q, nullptr, contact);
    if (meeting == Meeting::kApart) return;
    critical = true;
    if (meeting == Meeting::kUndecided) {
      out.unsure.emplace_back(p, q);
      return;
    }
    take(meeting, contact, test, out.contacts, out.touching, in_flat_corner);
  });
  out.critical += critical;
}

/// Numbers of the corners of these polygons; equal ones have one.
std::vector<uint32_t> number_corners(const Job& job, const std::vector<Found>& found,
                                     CellGeometry& geometry) {
  std::vector<uint32_t> numbers(job.vertex_count(), kNone);
  PointIndex index(geometry);
  for (const Found& f : found) {
    for (const auto& [p, q] : f.unsure) {
      for (const uint32_t polygon : {p, q}) {
        for (const uint32_t v : job.corners(job.polygons()[polygon])) {
          if (numbers[v] == kNone) numbers[v] = index.unique(geometry.vertex_point(v));
        }
      }
    }
  }
  return numbers;
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
  test.know_equal_vertices(number_corners(job, found, planes));
  Contact contact;
  std::vector<uint32_t> touching;
  for (const Found& f : found) {
    for (const auto& [p, q] : f.unsure) {
      const Meeting meeting = test.run(p, q, &planes, contact);
      if (meeting == Meeting::kApart) continue;
      take(meeting, contact, test, result.contacts, touching, result.in_flat_corner);
    }
  }
  for (const uint32_t v : touching) result.touched[v] = 1;
  add_signs(stats, planes.counters);
}

}  // namespace

Contacts find_contacts(Job& job, const PlainlyCovered& plainly, const KernelOptions& options,
                       EvaluateStats& stats) {
  const Candidates candidates(job, plainly, options);
  const size_t lots = candidates.lots();
  std::vector<Found> found(run_count(lots));
  Contacts result;
  result.in_flat_corner.assign(job.polygons().size(), 0);
  for_each_run(
      found.size(), options,
      [&] {
        return Looker{PairTest(job), CellPairs(plainly.polygons)};
      },
      [&](Looker& looker, size_t run) {
        Found& out = found[run];
        const PairTest& test = looker.test;
        const uint64_t filtered = test.signs().filtered, exact = test.signs().exact;
        const size_t end = std::min(lots, (run + 1) * kCellsPerRun);
        for (size_t lot = run * kCellsPerRun; lot < end; ++lot) {
          look_at(candidates, lot, looker, out, result.in_flat_corner);
        }
        out.filtered = test.signs().filtered - filtered;
        out.exact = test.signs().exact - exact;
      });
  candidates.count(stats);
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

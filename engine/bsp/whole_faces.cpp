#include "engine/bsp/whole_faces.h"

#include <algorithm>
#include <atomic>
#include <optional>

#include "engine/base/chance_list.h"
#include "engine/base/parallel.h"
#include "engine/base/per_thread.h"
#include "engine/bsp/contact_table.h"
#include "engine/bsp/covered_polygons.h"
#include "engine/bsp/cut_faces.h"
#include "engine/bsp/flat_cover.h"
#include "engine/bsp/group_cover.h"
#include "engine/bsp/kept_loops.h"
#include "engine/bsp/operand_groups.h"
#include "engine/bsp/patch_fates.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/rim_faces.h"
#include "engine/bsp/sign_stats.h"
#include "engine/bsp/touch_finder.h"
#include "engine/bsp/unate.h"

namespace csgrun {
namespace {

/// With so many plain contacts a polygon, cells that prune the expression are less work than
/// arrangements of all that meets a polygon, much of it inside what another one removes.
constexpr size_t kDense = 64;
/// So it is with so many, where a third operand removes most of what two have in common.
constexpr size_t kDenseIfHidden = 12;
constexpr double kHidden = 0.75;

/// With so many, groups of operands are less work, if within them so much is dropped. What groups
/// leave has many faces, and asks long rays of one another.
constexpr size_t kDenseForGroups = 16, kDenseForGroupsOfCrowd = 2;
constexpr double kDroppedInGroups = 0.5;
/// Where so many boxes of polygons meet for each plain contact that makes a crowd, these are there.
constexpr size_t kBoxesEach = 16;
/// One group is a job of its own, in which most of what it drops meets nothing (dead_space.h): it
/// is less work from so many boxes for each polygon on, if so much is dropped.
constexpr double kBoxesEachOfOne = 8, kDroppedInOne = 0.75;

/// The loops of so many cut faces are looked at by one thread.
constexpr size_t kFacesPerPart = 2048;

class FaceEvaluator {
 public:
  FaceEvaluator(Job& job, const Expression& expression, const KernelOptions& options,
                EvaluateStats& stats)
      : job_(job),
        expression_(expression),
        options_(options),
        stats_(stats),
        geometry_(job.planes(), &job),
        index_(geometry_) {
    result_.general.assign(job.polygons().size(), 0);
  }

  Result<WholeFaces> run() {
    if (is_told_crowded()) return crowded();
    plainly_ = find_plainly_covered(job_, expression_);
    contacts_ =
        ContactTable(find_contacts(job_, plainly_, options_, stats_), job_.polygons().size());
    if (is_cancelled()) return cancelled();
    if (is_found_crowded()) return crowded();
    if (has_plain_contacts(kDense) || is_mostly_hidden()) {
      result_.general.assign(job_.polygons().size(), 1);
      result_.any_general = true;
      return std::move(result_);
    }
    ends_.emplace(contacts_, job_, geometry_, index_);
    is_covered_ = find_covered(job_, plainly_, contacts_);
    for (size_t p = 0; p < plainly_.polygons.size(); ++p) is_covered_[p] |= plainly_.polygons[p];
    mark_flat_covered(job_, expression_, contacts_, is_covered_);
    find_suspects();
    if (!cut_polygons()) return cancelled();
    if (cut_.is_crowded) return crowded();
    fates_.emplace(job_, expression_, plainly_, options_, contacts_, cut_, geometry_, is_cut_);
    if (!fates_->find()) {
      return Error{ErrorCode::kInternal, "the labels of a patch contradict one another", {}};
    }
    emit();
    if (job_.near_faces()) emit_far();
    find_touching();
    keep_rims();
    add_signs(stats_, geometry_.counters);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_cancelled() const {
    return options_.cancel && options_.cancel->load(std::memory_order_relaxed);
  }
  static Error cancelled() { return {ErrorCode::kCancelled, "the evaluation was cancelled", {}}; }

  /// Whether there are more than so many for each polygon. Faces that touch count for less: those
  /// of parts that fit one another have many contacts in few places.
  [[nodiscard]] bool has_plain_contacts(size_t each) const {
    const auto plain = std::count_if(contacts_.all().begin(), contacts_.all().end(),
                                     [](const Contact& c) { return c.is_plain; });
    return static_cast<size_t>(plain) > each * (job_.polygons().size() + job_.far_face_count());
  }

  /// Not with a result in pieces: cells would want all of it.
  [[nodiscard]] bool is_mostly_hidden() const {
    return std::none_of(job_.operands().begin(), job_.operands().end(),
                        [](const Operand& o) { return o.pieces != nullptr; }) &&
           has_plain_contacts(kDenseIfHidden) &&
           hidden_contacts(job_, expression_, contacts_.all()) >= kHidden;
  }

  WholeFaces crowded() {
    result_.is_crowded = true;
    return std::move(result_);
  }
  /// From so many plain contacts a polygon on, groups may be less work.
  [[nodiscard]] size_t dense_for_groups() const {
    return options_.is_of_crowd ? kDenseForGroupsOfCrowd : kDenseForGroups;
  }
  /// Whether that is clear before any contact is found.
  [[nodiscard]] bool is_told_crowded() const {
    if (!options_.stop_when_crowded) return false;
    const double meeting = meeting_boxes(job_);
    const bool is_dense = meeting > static_cast<double>(kBoxesEach * dense_for_groups());
    if (!is_dense && !(is_one_group(expression_) && meeting > kBoxesEachOfOne)) return false;
    return cover_in_groups(job_, expression_) >= (is_dense ? kDroppedInGroups : kDroppedInOne);
  }
  [[nodiscard]] bool is_found_crowded() const {
    return options_.stop_when_crowded && has_plain_contacts(dense_for_groups()) &&
           (cover_in_groups(job_, expression_) >= kDroppedInGroups ||
            contact_cover_in_groups(job_, expression_, contacts_.all()) >= kDroppedInGroups);
  }

  /// Leaves a polygon to the general way.
  void leave(uint32_t polygon) {
    result_.general[polygon] = 1;
    result_.any_general = true;
  }

  /// Polygons that something touches.
  void find_suspects() {
    is_suspect_.assign(job_.polygons().size(), 0);
    for (const Contact& c : contacts_.all()) {
      if (!c.is_plain) is_suspect_[c.p] = is_suspect_[c.q] = 1;
    }
  }

  /// False when the evaluation is cancelled.
  bool cut_polygons() {
    is_cut_ = is_covered_;  // into nothing
    const auto polygons =
        polygons_where([&](uint32_t p) { return !is_covered_[p] && !may_stay_whole(p); });
    const auto with_planes = with_what_cuts(polygons);
    // Edges, which come later, have two or three times as many; room is made for twice as many as
    // one says.
    constexpr size_t kPlanesEach = 2;
    job_.planes().make_room(kPlanesEach * with_planes.size());
    cut_ = cut_faces(job_, polygons, with_planes, contacts_, *ends_, plainly_.is_open, geometry_,
                     index_, options_, stats_);
    if (is_cancelled()) return false;
    for (const CutFaces::Face& face : cut_.faces) is_cut_[face.polygon] = 1;
    for (const uint32_t p : cut_.by_value) is_suspect_[p] = 1;
    for (const uint32_t p : cut_.left) {
      is_cut_[p] = 1;
      leave(p);
    }
    return true;
  }

  /// Polygons and all that has more than a corner of its own in common with them, ascending. Most
  /// of what rests on a face cuts nothing, and needs no plane.
  [[nodiscard]] std::vector<uint32_t> with_what_cuts(std::span<const uint32_t> polygons) const {
    std::vector<uint8_t> is_wanted(job_.polygons().size(), 0);
    const auto want = [&](uint32_t p) {
      std::atomic_ref(is_wanted[p]).store(1, std::memory_order_relaxed);
    };
    for_each_range(polygons.size(), [&](size_t begin, size_t end) {
      for (const uint32_t p : polygons.subspan(begin, end - begin)) {
        want(p);
        for (const uint32_t i : contacts_.of(p)) {
          const Contact& c = contacts_[i];
          if (!c.is_corner()) want(c.p == p ? c.q : c.p);
        }
      }
    });
    return polygons_where([&](uint32_t p) { return is_wanted[p] != 0; });
  }

  /// The polygons for which `is_wanted` says so, ascending.
  template <class Wanted>
  [[nodiscard]] std::vector<uint32_t> polygons_where(Wanted&& is_wanted) const {
    return numbers_where(job_.polygons().size(), is_wanted);
  }

  /// Whether a polygon is whole and one of its corners tells what becomes of it.
  [[nodiscard]] bool may_stay_whole(uint32_t polygon) const {
    return untouched_corner(job_, contacts_, polygon) != kNone && is_met_on_rim_only(polygon);
  }

  /// Whether nothing cuts a polygon: what meets it lies on one side, if anything does. REQUIRES:
  /// nothing that meets it is coplanar.
  [[nodiscard]] bool is_met_on_rim_only(uint32_t polygon) const {
    for (const uint32_t i : contacts_.of(polygon)) {
      const Contact& c = contacts_[i];
      const bool is_p = c.p == polygon;
      if (is_p ? c.p_front && c.p_back : c.q_front && c.q_back) return false;
    }
    return true;
  }

  void emit() {
    is_kept_.assign(job_.polygons().size(), 0);
    for (const CutFaces::Face& cut : cut_.faces) settle(cut);
    result_.cut = emit_loops(job_, geometry_, cut_, *fates_);
    emit_whole();
  }

  /// What becomes of the polygons that were not cut.
  void emit_whole() {
    const size_t count = job_.polygons().size();
    std::vector<std::vector<WholePolygon>> kept(part_count(count, kFewForThreads));
    std::vector<std::vector<uint32_t>> left(kept.size());
    for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
      std::vector<WholePolygon> own;
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
        const PatchFate fate = fates_->of_polygon(p);
        if (fate == PatchFate::kUnknown) left[part].push_back(p);
        if (fate != PatchFate::kKeep && fate != PatchFate::kFlip) continue;
        is_kept_[p] = 1;
        own.push_back({p, fate == PatchFate::kFlip, contacts_.is_met(p)});
      }
      kept[part] = std::move(own);
    });
    size_t total = 0;
    for (const auto& part : kept) total += part.size();
    result_.whole.reserve(total);
    for (size_t part = 0; part < kept.size(); ++part) {
      result_.whole.insert(result_.whole.end(), kept[part].begin(), kept[part].end());
      for (const uint32_t p : left[part]) leave(p);
    }
  }

  /// What nothing enters is whole, though its loop told what becomes of it and where it is touched:
  /// until then it counts as cut, so this comes after find_touching().
  void keep_rims() {
    for (const CutFaces::Face& cut : cut_.faces) {
      if (cut.first_loop == cut.end_loop || !cut_.loops.loops[cut.first_loop].is_rim) continue;
      const PatchFate fate = fates_->of_loop(cut.first_loop);
      if (fate == PatchFate::kDrop) continue;
      result_.whole.push_back({cut.polygon, fate == PatchFate::kFlip, true});
    }
  }

  void emit_far() {
    result_.far.resize(job_.operand_count());
    std::vector<uint8_t> is_unknown(job_.operand_count(), 0);
    for_each_alone(job_.operand_count(), job_.vertex_count() > kFewForThreads, [&](size_t o) {
      const size_t room = job_.far_face_count(o);
      ChanceList<uint32_t> kept(room), flipped(room);
      bool any_unknown = false;
      job_.for_each_far_face(o, [&](uint32_t f) {
        const PatchFate fate = fates_->of_far_face(o, f);
        kept.add_if(fate == PatchFate::kKeep, f);
        flipped.add_if(fate == PatchFate::kFlip, f);
        any_unknown |= fate == PatchFate::kUnknown;
      });
      is_unknown[o] = any_unknown;
      result_.far[o] = {kept.take(), flipped.take()};
    });
    for (const uint8_t unknown : is_unknown) result_.any_general |= unknown != 0;
  }

  /// Leaves a polygon if it is not known what becomes of one of its loops.
  void settle(const CutFaces::Face& cut) {
    bool is_kept = false;
    for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
      const PatchFate fate = fates_->of_loop(l);
      if (fate == PatchFate::kUnknown) {
        fates_->drop_loops(cut);
        leave(cut.polygon);
        return;
      }
      is_kept |= fate != PatchFate::kDrop;
    }
    is_kept_[cut.polygon] = is_kept;
  }

  /// Where what is kept may touch itself: where no corner is at an end of a contact, and where
  /// corners are not one round.
  void find_touching() {
    TouchFinder finder(job_, geometry_, index_, contacts_.touched());
    const auto count = static_cast<uint32_t>(contacts_.all().size());
    std::vector<uint8_t> is_open(count, 0);
    const std::vector<uint32_t> asked = numbers_where(count, [&](uint32_t i) {
      const Contact& c = contacts_[i];
      is_open[i] =
          (result_.general[c.p] && is_suspect_[c.p]) || (result_.general[c.q] && is_suspect_[c.q]);
      return (is_suspect_[c.p] || is_suspect_[c.q]) && is_of_kept(c) && !ends_->is_asked(i);
    });
    ends_->ask(asked);
    ends_->make();
    examine_cut(finder, is_open);
    if (!is_unate(expression_)) examine_crossings(finder);
    const std::vector<uint32_t> suspects = numbers_where(result_.whole.size(), [&](uint32_t i) {
      return is_suspect_[result_.whole[i].polygon] != 0;
    });
    for (const uint32_t i : suspects) {
      const WholePolygon& w = result_.whole[i];
      corners_.clear();
      for (const uint32_t v : job_.corners(job_.polygons()[w.polygon])) {
        if (!contacts_.touched()[v]) continue;
        corners_.push_back(geometry_.vertex_point(v));
        finder.examine(corners_.back());
      }
      find_open(w.polygon, corners_, finder, corner_of_, is_open, &w);
    }
    if (finder.has_examined()) {
      add_outlines(finder);
      result_.touching = finder.find();
    }
    for (uint32_t i = 0; i < count; ++i) {
      if (!is_open[i]) continue;
      add_touching(job_.boxes()[contacts_[i].p], job_.boxes()[contacts_[i].q]);
      if (result_.any_general) continue;
      for (const uint32_t end : ends_->of(i)) finder.note_passage(end);
    }
    if (!result_.any_general) release_rims(job_, contacts_, geometry_, finder, result_.whole);
  }

  /// Has the corners examined of cut polygons that something touches, and marks the contacts of
  /// these that end elsewhere. Such polygons were cut by value: their corners are in the index.
  void examine_cut(TouchFinder& finder, std::vector<uint8_t>& is_open) {
    PerThread corners_of([] { return std::vector<uint32_t>(); });
    finder.examine_known([&](auto&& mark) {
      for_each_part(cut_.faces.size(), kFacesPerPart, [&](size_t, size_t begin, size_t end) {
        std::vector<uint32_t>& corner_of = corners_of.local();
        std::vector<uint32_t> corners;
        for (size_t f = begin; f < end; ++f) {
          const CutFaces::Face& cut = cut_.faces[f];
          if (!is_suspect_[cut.polygon] || !is_kept_[cut.polygon]) continue;
          corners.clear();
          for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
            const bool is_dropped = fates_->of_loop(l) == PatchFate::kDrop;
            for (const uint32_t p : cut_.loops.points(cut_.loops.loops[l])) {
              if (!finder.may_be_met(p)) continue;
              corners.push_back(p);
              if (!is_dropped) mark(p);
            }
          }
          find_open(cut.polygon, corners, finder, corner_of, is_open, nullptr);
        }
      });
    });
  }

  /// Has the points examined in which three operands cross, of polygons that nothing touches.
  void examine_crossings(TouchFinder& finder) {
    std::vector<uint32_t> crossings;
    for (const CutFaces::Face& cut : cut_.faces) {
      if (is_suspect_[cut.polygon] || !is_kept_[cut.polygon]) continue;  // known, or gone
      for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
        if (fates_->of_loop(l) == PatchFate::kDrop) continue;
        for (const uint32_t p : cut_.loops.points(cut_.loops.loops[l])) {
          if (p >= cut_.first_crossing && p < cut_.end_crossing) crossings.push_back(p);
        }
      }
    }
    index_.make_unique(crossings);
    for (const uint32_t p : crossings) finder.examine(p);
  }

  /// Adds what is kept to the finder, once it knows all points to be examined.
  void add_outlines(TouchFinder& finder) {
    const auto list_cut = [&](size_t begin, size_t end, auto&& add) {
      for (size_t f = begin; f < end; ++f) {
        const CutFaces::Face& cut = cut_.faces[f];
        for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
          const PatchFate fate = fates_->of_loop(l);
          if (fate == PatchFate::kDrop) continue;
          const CutLoops::Loop& loop = cut_.loops.loops[l];
          add({cut.polygon, cut_.loops.points(loop), cut_.loops.planes(loop),
               fate == PatchFate::kFlip});
        }
      }
    };
    finder.add_outlines(cut_.faces.size(), kFacesPerPart, list_cut);
    const std::vector<WholePolygon>& whole = result_.whole;
    const auto is_met = [&](uint32_t i) {
      return whole[i].is_met && has_touched_corner(whole[i].polygon);
    };
    const std::vector<uint32_t> met = numbers_where(whole.size(), is_met);
    name_corners(met);
    const auto list_whole = [&](size_t begin, size_t end, auto&& add) {
      std::vector<uint32_t> corners;
      for (size_t i = begin; i < end; ++i) {
        const WholePolygon& w = whole[met[i]];
        corners.clear();
        for (const uint32_t v : job_.corners(job_.polygons()[w.polygon])) {
          corners.push_back(geometry_.made_vertex_point(v));
        }
        add({w.polygon, corners, {}, w.flip});
      }
    };
    finder.add_outlines(met.size(), kFewForThreads, list_whole);
  }

  /// Makes points of the corners of polygons that are kept whole.
  void name_corners(std::span<const uint32_t> whole) {
    std::vector<uint8_t> is_wanted(job_.vertex_count(), 0);
    for (const uint32_t i : whole) {
      for (const uint32_t v : job_.corners(job_.polygons()[result_.whole[i].polygon])) {
        is_wanted[v] = 1;
      }
    }
    geometry_.add_vertex_points(numbers_where(is_wanted.size(), [&](uint32_t v) {
      return is_wanted[v] != 0 && !geometry_.has_vertex_point(v);
    }));
  }

  [[nodiscard]] bool has_touched_corner(uint32_t polygon) const {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    return std::any_of(corners.begin(), corners.end(),
                       [&](uint32_t v) { return contacts_.touched()[v] != 0; });
  }

  /// Whether both polygons leave something, and the contact has ends.
  [[nodiscard]] bool is_of_kept(const Contact& c) const {
    return !c.is_coplanar && is_kept_[c.p] && is_kept_[c.q];
  }

  /// Marks the contacts of a polygon that end where none of its corners is, nor an edge of it if it
  /// is whole. `corners`: those that may be met, which are in the index. `corner_of`: working
  /// memory, for any polygons. Several threads may ask about cut ones.
  void find_open(uint32_t polygon, std::span<const uint32_t> corners, TouchFinder& finder,
                 std::vector<uint32_t>& corner_of, std::vector<uint8_t>& is_open,
                 const WholePolygon* whole) {
    const auto contacts = contacts_.of(polygon);
    if (std::none_of(contacts.begin(), contacts.end(),
                     [&](uint32_t c) { return is_of_kept(contacts_[c]); })) {
      return;
    }
    corner_of.resize(geometry_.point_count(), kNone);
    for (const uint32_t p : corners) corner_of[finder.known_number(p)] = polygon;
    for (const uint32_t contact : contacts) {
      if (!is_of_kept(contacts_[contact])) continue;
      for (const uint32_t end : ends_->of(contact)) {
        if (corner_of[end] == polygon) continue;
        if (whole && finder.add_on_edge(polygon, end, whole->flip)) {
          corner_of[end] = polygon;
        } else {
          std::atomic_ref<uint8_t>(is_open[contact]).store(1, std::memory_order_relaxed);
        }
      }
    }
  }

  void add_touching(const PolygonBox& a, const PolygonBox& b) {
    GridBox& box = result_.touching.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::max(a.lo[k], b.lo[k]);
      box.hi[k] = std::min(a.hi[k], b.hi[k]);
    }
  }

  Job& job_;
  const Expression& expression_;
  const KernelOptions& options_;
  EvaluateStats& stats_;
  CellGeometry geometry_;
  PointIndex index_;
  WholeFaces result_;
  ContactTable contacts_;
  std::optional<ContactEnds> ends_;
  PlainlyCovered plainly_;
  std::vector<uint8_t> is_covered_;  ///< per polygon, see find_covered and mark_flat_covered
  std::vector<uint8_t> is_suspect_;  ///< per polygon: something touches it, maybe by chance
  std::vector<uint8_t> is_kept_;     ///< per polygon: it leaves something, whole or in loops
  std::vector<uint8_t> is_cut_;      ///< per polygon: has loops, or is left
  CutFaces cut_;
  std::optional<PatchFates> fates_;
  std::vector<uint32_t> corners_, corner_of_;  ///< see find_open
};

}  // namespace

Result<WholeFaces> evaluate_whole_faces(Job& job, const Expression& expression,
                                        const KernelOptions& options, EvaluateStats& stats) {
  return FaceEvaluator(job, expression, options, stats).run();
}

}  // namespace csgrun

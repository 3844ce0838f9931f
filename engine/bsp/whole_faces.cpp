#include "engine/bsp/whole_faces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/contact_table.h"
#include "engine/bsp/covered_polygons.h"
#include "engine/bsp/cut_faces.h"
#include "engine/bsp/parallel_runs.h"
#include "engine/bsp/patch_facts.h"
#include "engine/bsp/patch_labels.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/sign_stats.h"
#include "engine/bsp/touch_finder.h"
#include "engine/bsp/union_find.h"

namespace csgrun {
namespace {

/// With so many plain contacts a polygon, cells that prune the expression are less work than
/// arrangements of all that meets a polygon, much of it inside what another one removes.
constexpr size_t kDense = 16;

class FaceEvaluator {
 public:
  FaceEvaluator(Job& job, const Expression& expression, const KernelOptions& options,
                EvaluateStats& stats)
      : job_(job),
        expression_(expression),
        options_(options),
        stats_(stats),
        geometry_(job.planes(), &job),
        index_(geometry_),
        labels_(job, expression) {
    result_.general.assign(job.polygons().size(), 0);
  }

  Result<WholeFaces> run() {
    plainly_covered_ = find_plainly_covered(job_, expression_);
    contacts_ = ContactTable(find_contacts(job_, plainly_covered_, options_, stats_),
                             job_.polygons().size());
    if (is_cancelled()) return cancelled();
    if (is_dense()) {
      result_.general.assign(job_.polygons().size(), 1);
      result_.any_general = true;
      return std::move(result_);
    }
    ends_.emplace(contacts_, job_, geometry_, index_);
    is_covered_ = find_covered(job_, expression_, contacts_);
    for (size_t p = 0; p < plainly_covered_.size(); ++p) is_covered_[p] |= plainly_covered_[p];
    find_suspects();
    if (!cut_polygons()) return cancelled();
    join_patches();
    if (!gather_facts()) {
      return Error{ErrorCode::kInternal, "the labels of a patch contradict one another", {}};
    }
    drop_covered_patches();
    emit();
    find_touching();
    add_signs(stats_, geometry_.counters);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_cancelled() const {
    return options_.cancel && options_.cancel->load(std::memory_order_relaxed);
  }
  static Error cancelled() { return {ErrorCode::kCancelled, "the evaluation was cancelled", {}}; }

  /// Faces that touch count for less: those of parts that fit one another have many contacts in few
  /// places.
  [[nodiscard]] bool is_dense() const {
    const auto plain = std::count_if(contacts_.all().begin(), contacts_.all().end(),
                                     [](const Contact& c) { return c.is_plain; });
    return static_cast<size_t>(plain) > kDense * job_.polygons().size();
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
    job_.ensure_supports(polygons_where([&](uint32_t p) { return !contacts_.of(p).empty(); }));
    is_cut_ = is_covered_;  // into nothing
    const auto polygons =
        polygons_where([&](uint32_t p) { return !is_covered_[p] && !may_stay_whole(p); });
    job_.ensure_supports(polygons);
    cut_ = cut_faces(job_, polygons, contacts_, *ends_, geometry_, index_, options_, stats_);
    if (is_cancelled()) return false;
    for (const CutFaces::Face& face : cut_.faces) is_cut_[face.polygon] = 1;
    for (const uint32_t p : cut_.by_value) is_suspect_[p] = 1;
    for (const uint32_t p : cut_.left) {
      is_cut_[p] = 1;
      leave(p);
    }
    return true;
  }

  /// The polygons for which `is_wanted` says so, ascending; it is asked on several threads.
  template <class Wanted>
  [[nodiscard]] std::vector<uint32_t> polygons_where(Wanted&& is_wanted) const {
    const size_t count = job_.polygons().size();
    std::vector<std::vector<uint32_t>> parts(part_count(count, kFewForThreads));
    for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
      std::vector<uint32_t> wanted;
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
        if (is_wanted(p)) wanted.push_back(p);
      }
      parts[part] = std::move(wanted);
    });
    if (parts.size() == 1) return std::move(parts[0]);
    std::vector<uint32_t> all;
    for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
    return all;
  }

  /// Whether a polygon is whole and one of its corners tells what becomes of it.
  [[nodiscard]] bool may_stay_whole(uint32_t polygon) const {
    return untouched_corner(polygon) != kNone && is_met_on_rim_only(polygon);
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

  /// A corner that is on no other operand's surface. There is none where something coplanar meets a
  /// polygon.
  [[nodiscard]] uint32_t untouched_corner(uint32_t polygon) const {
    for (const uint32_t v : job_.corners(job_.polygons()[polygon])) {
      if (!contacts_.touched()[v]) return v;
    }
    return kNone;
  }

  /// Patches by the vertices that they hold: polygons that share a vertex, and parts of cut ones
  /// around it, are inside the same operands, as no other surface passes there.
  void join_patches() {
    patches_.reset(job_.vertex_count());
    // Operands have no vertices in common.
    const bool much = job_.polygons().size() > kFewForThreads;
    for_each_alone(job_.operand_count(), much, [&](size_t o) {
      for (uint32_t p = job_.polygon_start(o); p < job_.polygon_start(o + 1); ++p) {
        if (is_cut_[p]) continue;
        uint32_t patch = patches_.find(untouched_corner(p));
        for (const uint32_t v : job_.corners(job_.polygons()[p])) {
          if (!contacts_.touched()[v]) patch = patches_.join_with(patch, v);
        }
      }
    });
    for (const CutLoops::Loop& loop : cut_.loops.loops) {
      for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
        const uint32_t v = geometry_.point(cut_.loops.corner_point[c]).vertex;
        if (v != kNone && !contacts_.touched()[v]) patches_.join(loop.vertex, v);  // so it has one
      }
    }
    for_each_alone(job_.operand_count(), much, [&](size_t o) {
      patches_.flatten(job_.vertex_start(o), job_.vertex_start(o + 1));
    });
  }

  /// Patches that hold a corner of a polygon that is seen to be boundary of nothing, as they are.
  void drop_covered_patches() {
    patch_fates_.assign(job_.vertex_count(), kUnasked);
    for (uint32_t p = 0; p < plainly_covered_.size(); ++p) {
      if (!plainly_covered_[p]) continue;
      for (const uint32_t v : job_.corners(job_.polygons()[p])) {
        if (!contacts_.touched()[v]) {
          patch_fates_[patches_.find(v)] = static_cast<uint8_t>(PatchFate::kDrop);
        }
      }
    }
  }

  /// What the loops of each patch say of it; false if they disagree.
  bool gather_facts() {
    for (const CutLoops::Loop& loop : cut_.loops.loops) {
      if (loop.vertex == kNone) continue;
      const uint32_t patch = patches_.find(loop.vertex);
      for (uint32_t f = loop.first_fact; f < loop.first_fact + loop.fact_count; ++f) {
        facts_.add(patch, cut_.loops.facts[f]);
      }
    }
    for (const Contact& c : contacts_.all()) add_rim_facts(c);
    return facts_.finish();
  }

  /// A polygon that touches another operand's surface from one side, and in one polygon only, is
  /// inside the operand if it is behind that polygon: then its patch needs no ray. (On an edge of
  /// that polygon it would touch the next one, too.)
  void add_rim_facts(const Contact& c) {
    if (c.is_plain || c.is_coplanar) return;
    if (c.p_front != c.p_back) add_rim_fact(c.p, c.q, c.p_back);
    if (c.q_front != c.q_back) add_rim_fact(c.q, c.p, c.q_back);
  }
  void add_rim_fact(uint32_t polygon, uint32_t other, bool is_behind) {
    if (is_cut_[polygon]) return;
    const uint32_t operand = job_.polygons()[other].operand;
    for (const uint32_t i : contacts_.of(polygon)) {
      const Contact& c = contacts_[i];
      const uint32_t third = c.p == polygon ? c.q : c.p;
      if (third != other && job_.polygons()[third].operand == operand) return;
    }
    facts_.add(patches_.find(untouched_corner(polygon)), {operand, is_behind, is_behind});
  }

  /// A patch, by the vertex that stands for it, or a loop that passes no vertex.
  struct Question {
    uint32_t own;  ///< operand
    uint32_t patch, loop;
  };

  /// Asks what becomes of a patch, once.
  void ask(uint32_t patch, uint32_t own) {
    if (patch_fates_[patch] != kUnasked) return;
    patch_fates_[patch] = kAsked;
    questions_.push_back({own, patch, kNone});
  }

  /// Answers all questions, on several threads if they may be much work.
  void answer() {
    if (job_.polygons().size() <= kFewForThreads) {
      for (const Question& q : questions_) answer(q, labels_);
      return;
    }
    KernelOptions options = options_;
    options.progress = nullptr;
    constexpr size_t kEach = 16;
    for_each_run(
        part_count(questions_.size(), kEach), options, [&] { return labels_; },
        [&](PatchLabels& labels, size_t run) {
          const size_t end = std::min(questions_.size(), (run + 1) * kEach);
          for (size_t i = run * kEach; i < end; ++i) answer(questions_[i], labels);
        });
  }

  void answer(const Question& q, PatchLabels& labels) {
    if (q.patch == kNone) {
      fate_of_loop_[q.loop] = fate_of_loop(cut_.loops.loops[q.loop], q.own, labels);
    } else {
      patch_fates_[q.patch] = static_cast<uint8_t>(
          labels.fate(q.own, job_.rounded(q.patch), labels.error(q.own), facts_.of(q.patch)));
    }
  }

  /// That of one that passes no vertex.
  PatchFate fate_of_loop(const CutLoops::Loop& loop, uint32_t own, PatchLabels& labels) const {
    // The middle of an edge is on no operand's surface that has none along the edge. Where it is in
    // line with too much, another one may do.
    constexpr uint32_t kMostTries = 4;
    PatchFate fate = PatchFate::kUnknown;
    for (uint32_t i = 0; i < kMostTries && fate == PatchFate::kUnknown; ++i) {
      fate = fate_at_edge(loop, i % loop.corner_count, own, labels);
    }
    return fate;
  }

  PatchFate fate_at_edge(const CutLoops::Loop& loop, uint32_t edge, uint32_t own,
                         PatchLabels& labels) const {
    const uint32_t next = (edge + 1) % loop.corner_count;
    const auto& a = geometry_.point(cut_.loops.corner_point[loop.first_corner + edge]).rounded;
    const auto& b = geometry_.point(cut_.loops.corner_point[loop.first_corner + next]).rounded;
    std::array<double, 3> middle{};
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      middle[k] = (a[k] + b[k]) / 2;
      largest = std::max({largest, std::fabs(a[k]), std::fabs(b[k])});
    }
    return labels.fate(own, middle, largest * 0x1p-52,
                       {cut_.loops.facts.data() + loop.first_fact, loop.fact_count});
  }

  void emit() {
    is_kept_.assign(job_.polygons().size(), 0);
    fate_of_loop_.assign(cut_.loops.loops.size(), PatchFate::kDrop);
    for (const CutFaces::Face& cut : cut_.faces) {
      const uint32_t own = job_.polygons()[cut.polygon].operand;
      for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
        const uint32_t vertex = cut_.loops.loops[l].vertex;
        if (vertex == kNone) {
          questions_.push_back({own, kNone, l});
        } else {
          ask(patches_.root(vertex), own);
        }
      }
    }
    const RawVector<uint32_t> patches = patches_of_whole();
    answer();
    for (const CutFaces::Face& cut : cut_.faces) settle(cut);
    make_edge_planes();
    for (const CutFaces::Face& cut : cut_.faces) {
      for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
        const PatchFate fate = fate_of_loop_[l];
        if (fate != PatchFate::kDrop) {
          emit_loop(cut_.loops.loops[l], cut.polygon, fate == PatchFate::kFlip);
        }
      }
    }
    emit_whole(patches);
  }

  /// Per polygon that was not cut, its patch, about which is asked; kNone for the others.
  RawVector<uint32_t> patches_of_whole() {
    const size_t count = job_.polygons().size();
    RawVector<uint32_t> patches(count);
    std::vector<std::vector<uint32_t>> unasked(part_count(count, kFewForThreads));
    for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
      uint32_t last = kNone;
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
        patches[p] = is_cut_[p] ? kNone : patches_.root(untouched_corner(p));
        if (patches[p] == kNone || patches[p] == last || patch_fates_[patches[p]] != kUnasked) {
          continue;
        }
        last = patches[p];
        unasked[part].push_back(last);
      }
    });
    for (const auto& part : unasked) {
      for (const uint32_t patch : part) ask(patch, job_.operand_of_vertex(patch));
    }
    return patches;
  }

  /// What becomes of the polygons that were not cut.
  void emit_whole(const RawVector<uint32_t>& patch) {
    const size_t count = job_.polygons().size();
    std::vector<std::vector<WholePolygon>> kept(part_count(count, kFewForThreads));
    std::vector<std::vector<uint32_t>> left(kept.size());
    for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
        if (patch[p] == kNone) continue;
        const auto fate = static_cast<PatchFate>(patch_fates_[patch[p]]);
        if (fate == PatchFate::kUnknown) left[part].push_back(p);
        if (fate != PatchFate::kKeep && fate != PatchFate::kFlip) continue;
        is_kept_[p] = 1;
        kept[part].push_back({p, fate == PatchFate::kFlip, !contacts_.of(p).empty()});
      }
    });
    size_t total = 0;
    for (const auto& part : kept) total += part.size();
    result_.whole.reserve(total);
    for (size_t part = 0; part < kept.size(); ++part) {
      result_.whole.insert(result_.whole.end(), kept[part].begin(), kept[part].end());
      for (const uint32_t p : left[part]) leave(p);
    }
  }

  /// What becomes of the loops of a polygon: it is left if that of any is not known.
  void settle(const CutFaces::Face& cut) {
    const auto begin = fate_of_loop_.begin() + cut.first_loop,
               end = fate_of_loop_.begin() + cut.end_loop;
    for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
      const uint32_t vertex = cut_.loops.loops[l].vertex;
      if (vertex == kNone) continue;
      fate_of_loop_[l] = static_cast<PatchFate>(patch_fates_[patches_.root(vertex)]);
    }
    if (std::find(begin, end, PatchFate::kUnknown) != end) {
      std::fill(begin, end, PatchFate::kDrop);
      leave(cut.polygon);
    }
    const auto is_kept = [](PatchFate fate) { return fate != PatchFate::kDrop; };
    is_kept_[cut.polygon] = std::any_of(begin, end, is_kept);
  }

  /// Of the polygons' own edges that loops run along.
  void make_edge_planes() {
    std::vector<PolygonEdge> edges;
    for (const CutFaces::Face& cut : cut_.faces) {
      for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
        if (fate_of_loop_[l] == PatchFate::kDrop) continue;
        for (const uint32_t plane : planes_of(cut_.loops.loops[l])) {
          if (plane & CutLoops::kOwnEdge) {
            edges.push_back({cut.polygon, plane & ~CutLoops::kOwnEdge});
          }
        }
      }
    }
    job_.ensure_edges(edges);
  }

  void emit_loop(const CutLoops::Loop& loop, uint32_t polygon, bool flip) {
    FragmentSet& out = result_.cut;
    const PlaneId support = job_.polygons()[polygon].support;
    const auto plane = [&](uint32_t named) {
      return named & CutLoops::kOwnEdge ? job_.edge_plane(polygon, named & ~CutLoops::kOwnEdge)
                                        : named;
    };
    numbers_.resize(geometry_.point_count(), kNone);
    const auto first = static_cast<uint32_t>(out.corner_point.size());
    for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
      const uint32_t p = cut_.loops.corner_point[c];
      if (numbers_[p] == kNone) {
        numbers_[p] = static_cast<uint32_t>(out.points.size());
        const auto& s = geometry_.point(p);
        out.points.push_back({s.rounded, s.planes, s.vertex});
      }
      out.corner_point.push_back(numbers_[p]);
      out.corner_plane.push_back(plane(cut_.loops.corner_plane[c]));
    }
    out.pieces.push_back({support, polygon, first, loop.corner_count, loop.is_loose});
    if (flip) out.flip(out.pieces.back());
  }

  /// Where what is kept may touch itself: where no corner is at an end of a contact, and where
  /// corners are not one round.
  void find_touching() {
    TouchFinder finder(job_, geometry_, index_, contacts_.touched());
    const auto count = static_cast<uint32_t>(contacts_.all().size());
    std::vector<uint8_t> is_open(count, 0);
    for (uint32_t i = 0; i < count; ++i) {
      const Contact& c = contacts_[i];
      is_open[i] =
          (result_.general[c.p] && is_suspect_[c.p]) || (result_.general[c.q] && is_suspect_[c.q]);
      if (is_of_kept(c)) ends_->ask(i);
    }
    ends_->make();
    for (const CutFaces::Face& cut : cut_.faces) {
      if (!is_suspect_[cut.polygon] || !is_kept_[cut.polygon]) continue;
      corners_.clear();
      for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
        for (const uint32_t p : points_of(cut_.loops.loops[l])) {
          corners_.push_back(p);
          if (fate_of_loop_[l] != PatchFate::kDrop) finder.examine(p);
        }
      }
      find_open(cut.polygon, finder, is_open, nullptr);
    }
    for (const WholePolygon& w : result_.whole) {
      if (!is_suspect_[w.polygon]) continue;
      list_corners(w.polygon);
      for (const uint32_t p : corners_) finder.examine(p);
      find_open(w.polygon, finder, is_open, &w);
    }
    for (const CutFaces::Face& cut : cut_.faces) {
      for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
        if (fate_of_loop_[l] == PatchFate::kDrop) continue;
        const CutLoops::Loop& loop = cut_.loops.loops[l];
        finder.add_outline(cut.polygon, points_of(loop), planes_of(loop),
                           fate_of_loop_[l] == PatchFate::kFlip);
      }
    }
    for (const WholePolygon& w : result_.whole) {
      if (!w.is_met) continue;
      list_corners(w.polygon);
      finder.add_outline(w.polygon, corners_, {}, w.flip);
    }
    result_.touching = finder.find();
    for (uint32_t i = 0; i < count; ++i) {
      if (is_open[i]) add_touching(job_.boxes()[contacts_[i].p], job_.boxes()[contacts_[i].q]);
    }
  }

  /// Whether both polygons leave something, and the contact has ends.
  [[nodiscard]] bool is_of_kept(const Contact& c) const {
    return !c.is_coplanar && is_kept_[c.p] && is_kept_[c.q];
  }

  /// Marks the contacts of a polygon that end where none of `corners_` is, nor an edge of it if it
  /// is whole.
  void find_open(uint32_t polygon, TouchFinder& finder, std::vector<uint8_t>& is_open,
                 const WholePolygon* whole) {
    corner_of_.resize(geometry_.point_count(), kNone);
    for (const uint32_t p : corners_) corner_of_[finder.number(p)] = polygon;
    for (const uint32_t contact : contacts_.of(polygon)) {
      if (!is_of_kept(contacts_[contact])) continue;
      for (const uint32_t end : ends_->of(contact)) {
        if (corner_of_[end] == polygon) continue;
        if (whole && finder.add_on_edge(polygon, end, whole->flip)) {
          corner_of_[end] = polygon;
        } else {
          is_open[contact] = 1;
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

  void list_corners(uint32_t polygon) {
    corners_.clear();
    for (const uint32_t v : job_.corners(job_.polygons()[polygon])) {
      corners_.push_back(geometry_.vertex_point(v));
    }
  }

  [[nodiscard]] std::span<const uint32_t> points_of(const CutLoops::Loop& loop) const {
    return {cut_.loops.corner_point.data() + loop.first_corner, loop.corner_count};
  }

  [[nodiscard]] std::span<const uint32_t> planes_of(const CutLoops::Loop& loop) const {
    return {cut_.loops.corner_plane.data() + loop.first_corner, loop.corner_count};
  }

  static constexpr uint8_t kUnasked = 0xff, kAsked = 0xfe;

  Job& job_;
  const Expression& expression_;
  const KernelOptions& options_;
  EvaluateStats& stats_;
  CellGeometry geometry_;
  PointIndex index_;
  PatchLabels labels_;
  WholeFaces result_;
  ContactTable contacts_;
  std::optional<ContactEnds> ends_;
  std::vector<uint8_t> plainly_covered_;  ///< see find_plainly_covered
  std::vector<uint8_t> is_covered_;       ///< per polygon, see find_covered
  std::vector<uint8_t> is_suspect_;       ///< per polygon: something touches it, maybe by chance
  std::vector<uint8_t> is_kept_;          ///< per polygon: it leaves something, whole or in loops
  std::vector<uint8_t> is_cut_;           ///< per polygon: has loops, or is left
  CutFaces cut_;
  UnionFind patches_;
  PatchFacts facts_;
  std::vector<uint8_t> patch_fates_;     ///< per vertex that stands for a patch: a PatchFate
  std::vector<PatchFate> fate_of_loop_;  ///< per loop; kDrop where its polygon is left
  std::vector<Question> questions_;
  std::vector<uint32_t> corners_, corner_of_;  ///< see find_open
  std::vector<uint32_t> numbers_;
};

}  // namespace

Result<WholeFaces> evaluate_whole_faces(Job& job, const Expression& expression,
                                        const KernelOptions& options, EvaluateStats& stats) {
  return FaceEvaluator(job, expression, options, stats).run();
}

}  // namespace csgrun

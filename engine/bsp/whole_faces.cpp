#include "engine/bsp/whole_faces.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/crossing_points.h"
#include "engine/bsp/cut_polygon.h"
#include "engine/bsp/face_arrangement.h"
#include "engine/bsp/find_contacts.h"
#include "engine/bsp/patch_labels.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/sign_stats.h"
#include "engine/bsp/union_find.h"

namespace csgrun {
namespace {

/// With so many contacts a polygon, cells that prune the expression are less work than arrangements
/// of all that meets a polygon, much of it inside what another one removes.
constexpr size_t kDense = 16;

class FaceEvaluator {
 public:
  FaceEvaluator(Job& job, const Expression& expression, const KernelOptions& options,
                EvaluateStats& stats)
      : job_(job),
        options_(options),
        stats_(stats),
        geometry_(job.planes(), &job),
        index_(geometry_),
        points_(job, geometry_, index_),
        labels_(job, expression) {
    find_removers(expression);
    is_flat_.assign(job.operand_count(), 0);
    result_.general.assign(job.polygons().size(), 0);
    is_cut_.assign(job.polygons().size(), 0);
  }

  Result<WholeFaces> run() {
    Contacts found = find_contacts(job_, options_, stats_);
    contacts_ = std::move(found.contacts);
    touched_ = std::move(found.touched);
    if (is_cancelled()) return cancelled();
    if (contacts_.size() > kDense * job_.polygons().size()) {
      result_.general.assign(job_.polygons().size(), 1);
      result_.any_general = true;
      return std::move(result_);
    }
    gather_contacts();
    find_covered();
    note_touching();
    if (!cut_polygons()) return cancelled();
    join_patches();
    if (!gather_facts()) {
      return Error{ErrorCode::kInternal, "the labels of a patch contradict one another", {}};
    }
    emit();
    add_signs(stats_, geometry_.counters);
    return std::move(result_);
  }

 private:
  struct CutPolygon {
    uint32_t polygon, first_loop, end_loop;
  };
  struct Within {  ///< whether a vertex is in or on an operand
    uint32_t operand = kNone;
    bool is_within = false;
  };
  struct PatchFact {
    uint32_t patch;
    CutLoops::Fact fact;
    bool operator==(const PatchFact&) const = default;
    auto operator<=>(const PatchFact&) const = default;
  };

  [[nodiscard]] bool is_cancelled() const {
    return options_.cancel && options_.cancel->load(std::memory_order_relaxed);
  }
  static Error cancelled() { return {ErrorCode::kCancelled, "the evaluation was cancelled", {}}; }

  /// Leaves a polygon to the general way.
  void leave(uint32_t polygon) {
    result_.general[polygon] = 1;
    result_.any_general = true;
  }

  /// Convex operands inside of which nothing is boundary: what is added to all else, or taken away
  /// from it.
  void find_removers(const Expression& expression) {
    removes_.assign(job_.operand_count(), 0);
    if (expression.nodes.empty() || expression.nodes.back().is_operand) return;
    const Expression::Node& root = expression.nodes.back();
    const bool is_union = root.op == BooleanOp::kUnion;
    if (!is_union && root.op != BooleanOp::kDifference) return;
    for (uint32_t c = is_union ? 0 : 1; c < root.child_count; ++c) {
      const Expression::Node& child = expression.nodes[expression.children[root.first_child + c]];
      if (child.is_operand && job_.is_convex(child.operand)) removes_[child.operand] = 1;
    }
  }

  void gather_contacts() {
    const size_t n = job_.polygons().size();
    contact_starts_.assign(n + 1, 0);
    for (const Contact& c : contacts_) {
      job_.ensure_support(c.p);
      job_.ensure_support(c.q);
      ++contact_starts_[c.p + 1], ++contact_starts_[c.q + 1];
    }
    for (size_t i = 0; i < n; ++i) contact_starts_[i + 1] += contact_starts_[i];
    contact_of_.resize(2 * contacts_.size());
    std::vector<uint32_t> next(contact_starts_.begin(), contact_starts_.end() - 1);
    for (uint32_t i = 0; i < contacts_.size(); ++i) {
      contact_of_[next[contacts_[i].p]++] = i;
      contact_of_[next[contacts_[i].q]++] = i;
    }
    ends_.assign(contacts_.size(), {kNone, kNone});
  }

  /// Polygons that touch a remover's surface from within: none of them is boundary.
  void find_covered() {
    is_covered_.assign(job_.polygons().size(), 0);
    if (std::find(removes_.begin(), removes_.end(), 1) == removes_.end()) return;
    within_.assign(job_.vertex_count(), {});
    std::vector<uint32_t> touched_by, crossed_by;
    for (uint32_t p = 0; p < job_.polygons().size(); ++p) {
      touched_by.clear();
      crossed_by.clear();
      for (uint32_t i = contact_starts_[p]; i < contact_starts_[p + 1]; ++i) {
        const Contact& c = contacts_[contact_of_[i]];
        const uint32_t o = job_.polygons()[c.p == p ? c.q : c.p].operand;
        if (!removes_[o]) continue;
        std::vector<uint32_t>& list = c.is_plain || c.is_coplanar ? crossed_by : touched_by;
        if (list.empty() || list.back() != o) list.push_back(o);
      }
      for (const uint32_t o : touched_by) {
        if (std::find(crossed_by.begin(), crossed_by.end(), o) == crossed_by.end() &&
            is_within(p, o)) {
          is_covered_[p] = 1;
          break;
        }
      }
    }
  }

  /// Whether a polygon that is in no plane of a convex operand is inside it, but for its corners
  /// and edges.
  bool is_within(uint32_t polygon, uint32_t operand) {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    return std::all_of(corners.begin(), corners.end(), [&](uint32_t v) {
      Within& known = within_[v];
      if (known.operand != operand) known = {operand, is_in_or_on(v, operand)};
      return known.is_within;
    });
  }

  bool is_in_or_on(uint32_t vertex, uint32_t operand) {
    const uint32_t point = geometry_.vertex_point(vertex);
    for (uint32_t q = job_.polygon_start(operand); q < job_.polygon_start(operand + 1); ++q) {
      job_.ensure_support(q);
      const PlaneId plane = job_.polygons()[q].support;
      const int side = geometry_.side(plane.index(), point);
      if (plane.flipped() ? side < 0 : side > 0) return false;
    }
    return true;
  }

  void note_touching() {
    for (const Contact& c : contacts_) {
      if (!c.is_plain && !is_covered_[c.p] && !is_covered_[c.q]) {
        add_touching(job_.boxes()[c.p], job_.boxes()[c.q]);
      }
    }
  }

  /// The points at the ends of a contact, lower and upper.
  const std::array<uint32_t, 2>& ends(uint32_t contact) {
    std::array<uint32_t, 2>& ends = ends_[contact];
    if (ends[0] != kNone) return ends;
    const Contact& c = contacts_[contact];
    const auto point = [&](const Contact::End& end) {
      if (end.vertex != kNone) return index_.unique(geometry_.vertex_point(end.vertex));
      return end.on_p ? points_.point(c.p, end.edge, c.q) : points_.point(c.q, end.edge, c.p);
    };
    return ends = {point(c.lower), point(c.upper)};
  }

  /// Wherever a polygon meets others.
  void add_touching(uint32_t p) {
    for (uint32_t i = contact_starts_[p]; i < contact_starts_[p + 1]; ++i) {
      const Contact& c = contacts_[contact_of_[i]];
      add_touching(job_.boxes()[c.p], job_.boxes()[c.q]);
    }
  }

  void add_touching(const PolygonBox& a, const PolygonBox& b) {
    GridBox box;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = std::max(a.lo[k], b.lo[k]);
      box.hi[k] = std::min(a.hi[k], b.hi[k]);
    }
    result_.touching.push_back(box);
  }

  /// False when the evaluation is cancelled.
  bool cut_polygons() {
    PolygonCutter cutter(job_, geometry_);
    FaceArrangement arrangement(job_, geometry_, index_, touched_);
    for (uint32_t p = 0; p < job_.polygons().size(); ++p) {
      const auto loops = static_cast<uint32_t>(loops_.loops.size());
      if (is_covered_[p]) {
        is_cut_[p] = 1;
        cut_.push_back({p, loops, loops});
        continue;
      }
      if (is_met_on_rim_only(p) && untouched_corner(p) != kNone) continue;
      const bool plain = list_segments(p);
      if (segments_.empty() && coplanar_.empty() && untouched_corner(p) != kNone) continue;
      if (cut_.size() % 64 == 0 && is_cancelled()) return false;
      job_.ensure_support(p);
      is_cut_[p] = 1;
      bool is_done = plain && cutter.cut(p, segments_, loops_);
      if (!is_done) {
        job_.ensure_planes(p);
        for (const uint32_t q : coplanar_) job_.ensure_planes(q);
        is_done = arrangement.build(p, sheets_, coplanar_, loops_);
        if (plain) add_touching(p);
      }
      if (is_done) {
        cut_.push_back({p, loops, static_cast<uint32_t>(loops_.loops.size())});
      } else {
        leave(p);
      }
    }
    return true;
  }

  /// Whether nothing cuts a polygon: what meets it lies on one side, if anything does.
  [[nodiscard]] bool is_met_on_rim_only(uint32_t polygon) const {
    for (uint32_t i = contact_starts_[polygon]; i < contact_starts_[polygon + 1]; ++i) {
      const Contact& c = contacts_[contact_of_[i]];
      const bool is_p = c.p == polygon;
      if (c.is_coplanar || (is_p ? c.p_front && c.p_back : c.q_front && c.q_back)) return false;
    }
    return true;
  }

  /// Lists what is on a polygon; whether all of it is plain.
  bool list_segments(uint32_t polygon) {
    segments_.clear();
    sheets_.clear();
    coplanar_.clear();
    bool plain = true;
    for (uint32_t i = contact_starts_[polygon]; i < contact_starts_[polygon + 1]; ++i) {
      const Contact& c = contacts_[contact_of_[i]];
      plain &= c.is_plain;
      if (!c.is_coplanar) continue;
      coplanar_.push_back(c.p == polygon ? c.q : c.p);
      const uint32_t o = job_.polygons()[coplanar_.back()].operand;
      is_flat_[o] = job_.is_convex(o);
    }
    for (uint32_t i = contact_starts_[polygon]; i < contact_starts_[polygon + 1]; ++i) {
      const Contact& c = contacts_[contact_of_[i]];
      const bool is_p = c.p == polygon;
      const uint32_t other = is_p ? c.q : c.p;
      if (c.is_coplanar || is_flat_[job_.polygons()[other].operand]) continue;
      const auto& [lower, upper] = ends(contact_of_[i]);
      if (lower == upper) continue;
      const auto edge = [&](const Contact::End& e) { return e.on_p == is_p ? e.edge : kNone; };
      if (is_p) {
        segments_.push_back({lower, upper, other, edge(c.lower), edge(c.upper)});
        sheets_.push_back({lower, upper, other, c.q_front, c.q_back});
      } else {
        segments_.push_back({upper, lower, other, edge(c.upper), edge(c.lower)});
        sheets_.push_back({upper, lower, other, c.p_front, c.p_back});
      }
    }
    for (const uint32_t q : coplanar_) is_flat_[job_.polygons()[q].operand] = 0;
    return plain;
  }

  /// A corner that is on no other operand's surface.
  [[nodiscard]] uint32_t untouched_corner(uint32_t polygon) const {
    for (const uint32_t v : job_.corners(job_.polygons()[polygon])) {
      if (!touched_[v]) return v;
    }
    return kNone;
  }

  /// Patches by the vertices that they hold: polygons that share a vertex, and parts of cut ones
  /// around it, are inside the same operands, as no other surface passes there.
  void join_patches() {
    patches_.reset(job_.vertex_count());
    for (uint32_t p = 0; p < job_.polygons().size(); ++p) {
      if (is_cut_[p]) continue;
      uint32_t patch = patches_.find(untouched_corner(p));
      for (const uint32_t v : job_.corners(job_.polygons()[p])) {
        if (!touched_[v]) patch = patches_.join_with(patch, v);
      }
    }
    for (const CutLoops::Loop& loop : loops_.loops) {
      if (loop.vertex == kNone) continue;
      for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
        const uint32_t v = geometry_.point(loops_.corner_point[c]).vertex;
        if (v != kNone && !touched_[v]) patches_.join(loop.vertex, v);
      }
    }
  }

  /// What the loops of each patch say of it; false if they disagree.
  bool gather_facts() {
    for (const CutLoops::Loop& loop : loops_.loops) {
      if (loop.vertex == kNone) continue;
      const uint32_t patch = patches_.find(loop.vertex);
      for (uint32_t f = loop.first_fact; f < loop.first_fact + loop.fact_count; ++f) {
        facts_.push_back({patch, loops_.facts[f]});
      }
    }
    std::sort(facts_.begin(), facts_.end());
    facts_.erase(std::unique(facts_.begin(), facts_.end()), facts_.end());
    return std::adjacent_find(facts_.begin(), facts_.end(), [](const auto& a, const auto& b) {
             return a.patch == b.patch && a.fact.operand == b.fact.operand;
           }) == facts_.end();
  }

  PatchFate fate_of_patch(uint32_t vertex, uint32_t own) {
    if (patch_fates_.empty()) patch_fates_.assign(job_.vertex_count(), kUnasked);
    const uint32_t patch = patches_.find(vertex);
    if (patch_fates_[patch] == kUnasked) {
      auto at = std::lower_bound(facts_.begin(), facts_.end(), PatchFact{patch, {0, false, false}});
      own_facts_.clear();
      for (; at != facts_.end() && at->patch == patch; ++at) own_facts_.push_back(at->fact);
      patch_fates_[patch] = static_cast<uint8_t>(
          labels_.fate(own, job_.rounded(patch), labels_.error(own), own_facts_));
    }
    return static_cast<PatchFate>(patch_fates_[patch]);
  }

  PatchFate fate_of_loop(const CutLoops::Loop& loop, uint32_t own) {
    if (loop.vertex != kNone) return fate_of_patch(loop.vertex, own);
    // The middle of an edge is on no operand's surface that has none along the edge.
    const auto& a = geometry_.point(loops_.corner_point[loop.first_corner]).rounded;
    const auto& b = geometry_.point(loops_.corner_point[loop.first_corner + 1]).rounded;
    std::array<double, 3> middle{};
    double largest = 0;
    for (int k = 0; k < 3; ++k) {
      middle[k] = (a[k] + b[k]) / 2;
      largest = std::max({largest, std::fabs(a[k]), std::fabs(b[k])});
    }
    return labels_.fate(own, middle, largest * 0x1p-52,
                        {loops_.facts.data() + loop.first_fact, loop.fact_count});
  }

  void emit() {
    uint32_t cut = 0;
    for (uint32_t p = 0; p < job_.polygons().size(); ++p) {
      if (result_.general[p]) continue;
      if (is_cut_[p]) {
        emit_loops(cut_[cut++]);
        continue;
      }
      const PatchFate fate = fate_of_patch(untouched_corner(p), job_.polygons()[p].operand);
      if (fate == PatchFate::kUnknown) leave(p);
      if (fate == PatchFate::kKeep || fate == PatchFate::kFlip) {
        result_.whole.push_back(
            {p, fate == PatchFate::kFlip, contact_starts_[p] < contact_starts_[p + 1]});
      }
    }
  }

  void emit_loops(const CutPolygon& cut) {
    const uint32_t own = job_.polygons()[cut.polygon].operand;
    loop_fates_.clear();
    for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
      loop_fates_.push_back(fate_of_loop(loops_.loops[l], own));
      if (loop_fates_.back() == PatchFate::kUnknown) return leave(cut.polygon);
    }
    for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
      const PatchFate fate = loop_fates_[l - cut.first_loop];
      if (fate != PatchFate::kDrop) {
        emit_loop(loops_.loops[l], cut.polygon, fate == PatchFate::kFlip);
      }
    }
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
      const uint32_t p = loops_.corner_point[c];
      if (numbers_[p] == kNone) {
        numbers_[p] = static_cast<uint32_t>(out.points.size());
        const auto& s = geometry_.point(p);
        out.points.push_back({s.rounded, s.planes, s.vertex});
      }
      out.corner_point.push_back(numbers_[p]);
      out.corner_plane.push_back(plane(loops_.corner_plane[c]));
    }
    out.pieces.push_back({support, polygon, first, loop.corner_count, loop.is_loose});
    if (flip) out.flip(out.pieces.back());
  }

  static constexpr uint8_t kUnasked = 0xff;

  Job& job_;
  const KernelOptions& options_;
  EvaluateStats& stats_;
  CellGeometry geometry_;
  PointIndex index_;
  CrossingPoints points_;
  PatchLabels labels_;
  WholeFaces result_;
  std::vector<Contact> contacts_;
  std::vector<std::array<uint32_t, 2>> ends_;          ///< of the contacts: lower and upper point
  std::vector<uint32_t> contact_starts_, contact_of_;  ///< per polygon
  std::vector<uint8_t> removes_;                       ///< per operand, see find_removers
  std::vector<Within> within_;                         ///< per vertex, of the operand asked last
  std::vector<uint8_t> is_covered_;                    ///< per polygon, see find_covered
  std::vector<uint8_t> is_flat_;      ///< per operand: convex, with a face in the plane at hand
  std::vector<uint8_t> touched_;      ///< per vertex: may be on another surface
  std::vector<uint8_t> is_cut_;       ///< per polygon: has loops, or is left
  std::vector<CutSegment> segments_;  ///< of the polygon at hand
  std::vector<SheetSegment> sheets_;
  std::vector<uint32_t> coplanar_;
  CutLoops loops_;
  std::vector<CutPolygon> cut_;
  UnionFind patches_;
  std::vector<PatchFact> facts_;
  std::vector<CutLoops::Fact> own_facts_;
  std::vector<uint8_t> patch_fates_;  ///< per vertex that stands for a patch: a PatchFate
  std::vector<PatchFate> loop_fates_;
  std::vector<uint32_t> numbers_;
};

}  // namespace

Result<WholeFaces> evaluate_whole_faces(Job& job, const Expression& expression,
                                        const KernelOptions& options, EvaluateStats& stats) {
  return FaceEvaluator(job, expression, options, stats).run();
}

}  // namespace csgrun

// What lies on either side of the loops of an arrangement: facts that arcs tell, and those of
// coplanar sheets that no arc is of.
#include <algorithm>
#include <cassert>

#include "engine/base/sort_few.h"
#include "engine/bsp/face_arrangement.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {

/// Adds what coplanar sheets cover beyond what arcs say; false if that cannot be told.
bool FaceArrangement::find_covered(const CutLoops& out, uint32_t first_loop) {
  if (sheets_.empty()) return true;
  loop_boxes_.clear();
  for (uint32_t l = first_loop; l < out.loops.size(); ++l) {
    const CutLoops::Loop& loop = out.loops[l];
    SheetBox box;
    for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
      box.include(geometry_.point(out.corner_point[c]).rounded);
    }
    loop_boxes_.push_back(box);
  }
  std::sort(facts_.begin(), facts_.end());
  std::sort(sheets_.begin(), sheets_.end());
  for (size_t begin = 0; begin < sheets_.size();) {
    const uint32_t operand = job_.polygons()[sheets_[begin]].operand;
    is_sheet_marked_ = false;
    crowding_ += loop_boxes_.size();
    size_t end = begin;
    SheetBox box;
    for (; end < sheets_.size() && job_.polygons()[sheets_[end]].operand == operand; ++end) {
      for (const uint32_t v : job_.corners(job_.polygons()[sheets_[end]])) {
        box.include(job_.rounded(v));
      }
    }
    // What is covered is within the box of what covers it, corner by corner.
    for (uint32_t l = 0; l < loop_boxes_.size(); ++l) {
      if (box.holds(loop_boxes_[l]) &&
          !find_covered_loop(out.loops[first_loop + l], l, {sheets_.data() + begin, end - begin},
                             out)) {
        return false;
      }
    }
    begin = end;
  }
  facts_.insert(facts_.end(), covered_.begin(), covered_.end());
  return true;
}

/// The same for one loop and the sheets of one operand.
bool FaceArrangement::find_covered_loop(const CutLoops::Loop& loop, uint32_t number,
                                        std::span<const uint32_t> sheets, const CutLoops& out) {
  const uint32_t operand = job_.polygons()[sheets[0]].operand;
  const LoopFact least{number, {operand, false, false, false}, false};
  const auto begin = std::lower_bound(facts_.begin(), facts_.end(), least);
  for (auto f = begin; f != facts_.end() && f->loop == number && f->fact.operand == operand; ++f) {
    // A sheet that ends there tells; so does any other, unless the operand may touch itself: then
    // what touches a covering sheet from behind says as little as what is behind it.
    const bool is_covered = f->fact.front != f->fact.back;
    if (is_covered || f->beside_coplanar || job_.has_simple_edges(operand)) return true;
  }
  // No edge of a covering sheet is along the region: any of its points tells that is not on one.
  for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
    const uint32_t point = out.corner_point[c];
    if (is_on_sheet_edge(operand, point)) continue;
    const uint32_t sheet = sheet_at(sheets, point);
    if (sheet == kNone) return true;
    const bool same = job_.polygons()[sheet].support == polygon_->support;
    covered_.push_back({number, {operand, !same, same}, false});
    return true;
  }
  return false;
}

/// Whether a point is on an edge of the operand's coplanar sheets; lines have all points at which
/// they meet others as stops.
bool FaceArrangement::is_on_sheet_edge(uint32_t operand, uint32_t point) {
  if (!is_sheet_marked_) mark_sheet_edges(operand);
  return on_sheet_edge_[point] == sheet_mark_;
}

void FaceArrangement::mark_sheet_edges(uint32_t operand) {
  is_sheet_marked_ = true;
  ++sheet_mark_;
  on_sheet_edge_.resize(geometry_.point_count(), 0);
  // Lines of coplanar sheets come last, by ascending operands; stops are in the order of lines.
  const auto first =
      std::lower_bound(lines_.begin() + static_cast<long>(first_coplanar_line_), lines_.end(),
                       operand, [](const Line& line, uint32_t o) { return line.operand < o; });
  if (is_at_rim_) {
    for (auto line = first; line != lines_.end() && line->operand == operand; ++line) {
      on_sheet_edge_[line->from] = on_sheet_edge_[line->to] = sheet_mark_;
    }
    for (const auto& [at, part] : rim_parts_) {
      const uint32_t line = along_rim_[part / 2].line;
      if (line < first_coplanar_line_ || lines_[line].operand != operand) continue;
      on_sheet_edge_[rim_[at]] = on_sheet_edge_[rim_[at + 1]] = sheet_mark_;
    }
    return;
  }
  auto stop = std::lower_bound(
      stops_.begin(), stops_.end(), static_cast<uint32_t>(first - lines_.begin()),
      [](const std::pair<uint32_t, uint32_t>& s, uint32_t line) { return s.first < line; });
  for (; stop != stops_.end() && lines_[stop->first].operand == operand; ++stop) {
    on_sheet_edge_[stop->second] = sheet_mark_;
  }
}

uint32_t FaceArrangement::sheet_at(std::span<const uint32_t> sheets, uint32_t point) {
  std::array<double, 3> at = geometry_.point(point).rounded;
  for (double& x : at) x = clamp_to_box(x);
  for (const uint32_t q : sheets) {
    if (!may_hold(job_.boxes()[q], at, 0)) continue;
    const JobPolygon& sheet = job_.polygons()[q];
    const auto planes = job_.edge_planes(sheet);
    const auto inner = inner_signs(sheet);
    bool holds = true;
    for (uint32_t e = 0; e < sheet.count && holds; ++e) {
      holds = geometry_.side(planes[e], point) * inner[e] >= 0;
    }
    if (holds) {
      return q;
    }
  }
  return kNone;
}

/// Gives each loop its facts; false when they contradict one another.
bool FaceArrangement::write_facts(CutLoops& out, uint32_t first_loop) {
  sort_facts_.sort(
      facts_, out.loops.size() - first_loop, [](const LoopFact& f) { return f.loop; },
      [](const LoopFact& a, const LoopFact& b) { return a < b; });
  facts_.erase(std::unique(facts_.begin(), facts_.end()), facts_.end());
  size_t at = 0;
  for (uint32_t l = 0; first_loop + l < out.loops.size(); ++l) {
    CutLoops::Loop& loop = out.loops[first_loop + l];
    loop.first_fact = static_cast<uint32_t>(out.facts.size());
    while (at < facts_.size() && facts_[at].loop == l) {
      // Of an operand that covers the region, only that counts.
      size_t end = at;
      bool is_covered = false;
      for (; end < facts_.size() && facts_[end].loop == l &&
             facts_[end].fact.operand == facts_[at].fact.operand;
           ++end) {
        is_covered |= facts_[end].fact.front != facts_[end].fact.back;
      }
      for (; at < end; ++at) {
        const CutLoops::Fact& fact = facts_[at].fact;
        if (!is_covered || fact.front != fact.back) out.facts.push_back(fact);
      }
    }
    if (!out.finish_facts(loop, is_open_)) return false;
  }
  return true;
}

/// Whether the solid's edge between two polygons is convex: q goes behind p, or straight on.
bool FaceArrangement::is_convex_edge(uint32_t p, uint32_t q) {
  const PlaneId support = job_.polygons()[p].support;
  for (const uint32_t v : job_.corners(job_.polygons()[q])) {
    const int s = geometry_.side_of_vertex(support.index(), v);
    if (s != 0) return support.flipped() ? s > 0 : s < 0;
  }
  return true;
}

/// What is on the left of a half-edge, for each operand that has sheets there.
bool FaceArrangement::add_facts(uint32_t half, uint32_t loop, bool is_first_edge) {
  const Arc& arc = arcs_[half / 2];
  const auto operand = [&](const Part* p) { return lines_[p->line].operand; };
  const auto reversed = [&](const Part& p) { return p.backwards != (half % 2 == 1); };
  // Parts ascend by lines, those of an operand that are not coplanar before those that are. Around
  // an edge that many bodies share there are many.
  at_arc_.clear();
  for (uint32_t p = arc.first_part; p < arc.first_part + arc.part_count; ++p) {
    if (operand(&parts_[p]) != kNone) at_arc_.push_back(&parts_[p]);
  }
  sort_few(at_arc_.begin(), at_arc_.end(),
           [&](const Part* p, const Part* q) { return operand(p) < operand(q); });
  for (size_t first = 0, end = 0; first < at_arc_.size(); first = end) {
    const Part* const p = at_arc_[first];
    const uint32_t o = operand(p);
    while (end < at_arc_.size() && operand(at_arc_[end]) == o) ++end;
    const size_t count = end - first;
    const Line& line = lines_[p->line];
    if (line.kind == Kind::kThrough) {
      if (count != 1) return false;
      const bool inside = !reversed(*p);
      facts_.push_back({loop, {o, inside, inside, !is_first_edge}});
      continue;
    }
    // A coplanar sheet on this half-edge's left covers what is there.
    const auto coplanar_side = [&](const Part& part) {  // 1: left, -1: right, 0: not coplanar
      const Kind kind = lines_[part.line].kind;
      if (!is_coplanar(kind)) return 0;
      return (kind == Kind::kLeft) != reversed(part) ? 1 : -1;
    };
    const int a = coplanar_side(*p);
    if (count == 1 && (a == 0 || !job_.is_convex(o))) {
      assert(is_open_[o]);  // the other sheet of that edge is hidden: so nothing is boundary there
      continue;
    }
    if (count == 1) {  // a face of a convex operand, of which nothing else is told: see build()
      const bool same = job_.polygons()[line.sheet].support == polygon_->support;
      facts_.push_back({loop, {o, a > 0 && !same, a > 0 && same, !is_first_edge}, true});
      continue;
    }
    if (count != 2) return false;
    // A closed surface has no sheet that ends beside one that goes through, and two coplanar ones
    // are on either side and face the same way. Of two others the first one is not coplanar.
    const Part* const second = at_arc_[first + 1];
    const Line& other = lines_[second->line];
    const int b = coplanar_side(*second);
    assert(other.kind != Kind::kThrough && (a == 0 || a == -b));
    if (a > 0 || b > 0) {
      const bool same = job_.polygons()[other.sheet].support == polygon_->support;
      facts_.push_back({loop, {o, !same, same, !is_first_edge}});
      continue;
    }
    // What is on the left is behind the first sheet alone, if the second one is coplanar: whichever
    // way that one runs, it makes no difference here.
    const bool behind = !reversed(*p), behind_other = !reversed(*second);
    const bool inside = behind == behind_other || !is_convex_edge(line.sheet, other.sheet)
                            ? behind || behind_other
                            : behind && behind_other;
    facts_.push_back({loop, {o, inside, inside, !is_first_edge}, b < 0});
  }
  return true;
}

}  // namespace csgrun

#include "engine/bsp/patch_fates.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <tuple>

#include "engine/base/counting_order.h"
#include "engine/base/parallel.h"
#include "engine/base/sort_few.h"
#include "engine/bsp/parallel_runs.h"

namespace csgrun {

uint32_t untouched_corner(const Job& job, const ContactTable& contacts, uint32_t polygon) {
  for (const uint32_t v : job.corners(job.polygons()[polygon])) {
    if (!contacts.touched()[v]) return v;
  }
  return kNone;
}

PatchFates::PatchFates(const Job& job, const Expression& expression, const PlainlyCovered& plainly,
                       const KernelOptions& options, const ContactTable& contacts,
                       const CutFaces& cut, const CellGeometry& geometry,
                       const std::vector<uint8_t>& is_cut)
    : job_(job),
      plainly_(plainly),
      options_(options),
      contacts_(contacts),
      cut_(cut),
      geometry_(geometry),
      is_cut_(is_cut),
      labels_(job, expression, plainly) {}

bool PatchFates::find() {
  join_patches();
  if (!gather_facts()) return false;
  drop_covered();
  join_bare_loops();
  ask_about_loops();
  ask_about_whole();
  answer();
  answer_for_bare_loops();
  for (uint32_t l = 0; l < cut_.loops.loops.size(); ++l) {
    const uint32_t vertex = cut_.loops.loops[l].vertex;
    if (vertex != kNone) {
      fate_of_loop_[l] = static_cast<PatchFate>(patch_fates_[patches_.root(vertex)]);
    }
  }
  return true;
}

/// Patches by the vertices that they hold: polygons that share a vertex, and parts of cut ones
/// around it, are inside the same operands, as no other surface passes there.
void PatchFates::join_patches() {
  patches_.reset(job_.vertex_count());
  vertex_of_polygon_.resize(job_.polygons().size());
  CountingOrder cut;
  cut.sort(cut_.faces.size(), job_.operand_count(),
           [&](size_t f) { return job_.polygons()[cut_.faces[f].polygon].operand; });
  // Operands have no vertices in common.
  for_each_alone(job_.operand_count(), job_.polygons().size() > kFewForThreads, [&](size_t o) {
    for (uint32_t p = job_.polygon_start(o); p < job_.polygon_start(o + 1); ++p) {
      uint32_t& vertex = vertex_of_polygon_[p];
      vertex = is_cut_[p] ? kNone : untouched_corner(job_, contacts_, p);
      if (vertex == kNone) continue;
      uint32_t patch = patches_.find(vertex);
      for (const uint32_t v : job_.corners(job_.polygons()[p])) {
        if (!contacts_.touched()[v]) patch = patches_.join_with(patch, v);
      }
    }
    for (uint32_t i = cut.starts[o]; i < cut.starts[o + 1]; ++i)
      join_loops(cut_.faces[cut.order[i]]);
    join_far_faces(o);
    patches_.flatten(job_.vertex_start(o), job_.vertex_start(o + 1));
  });
}

/// Nothing touches their vertices.
void PatchFates::join_far_faces(size_t operand) {
  const uint32_t first_vertex = job_.vertex_start(operand);
  job_.for_each_far_face(operand, [&](uint32_t f) {
    const LeafGeometry& leaf = *job_.leaf(operand);
    const uint32_t begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    uint32_t patch = patches_.find(first_vertex + leaf.corners[begin]);
    for (uint32_t c = begin + 1; c < end; ++c) {
      patch = patches_.join_with(patch, first_vertex + leaf.corners[c]);
    }
  });
}

void PatchFates::join_loops(const CutFaces::Face& face) {
  for (uint32_t l = face.first_loop; l < face.end_loop; ++l) {
    const CutLoops::Loop& loop = cut_.loops.loops[l];
    for (uint32_t c = loop.first_corner; c < loop.first_corner + loop.corner_count; ++c) {
      const uint32_t v = geometry_.point(cut_.loops.corner_point[c]).vertex;
      if (v != kNone && !contacts_.touched()[v]) patches_.join(loop.vertex, v);  // so it has one
    }
  }
}

/// What the loops of each patch say of it; false if they disagree.
bool PatchFates::gather_facts() {
  const auto gather = [&](size_t count, auto&& add) {
    std::vector<PatchFacts> parts(part_count(count, kFewForThreads));
    for_each_part(count, kFewForThreads, [&](size_t part, size_t begin, size_t end) {
      PatchFacts own;
      ByOperand memory;
      for (size_t i = begin; i < end; ++i) add(i, own, memory);
      parts[part] = std::move(own);
    });
    for (const PatchFacts& part : parts) facts_.add(part);
  };
  gather(cut_.loops.loops.size(), [&](size_t l, PatchFacts& facts, ByOperand&) {
    const CutLoops::Loop& loop = cut_.loops.loops[l];
    if (loop.vertex == kNone) return;
    const uint32_t patch = patches_.root(loop.vertex);
    for (uint32_t f = loop.first_fact; f < loop.first_fact + loop.fact_count; ++f) {
      facts.add(patch, cut_.loops.facts[f]);
    }
  });
  gather(job_.polygons().size(), [&](size_t p, PatchFacts& facts, ByOperand& memory) {
    add_rim_facts(static_cast<uint32_t>(p), memory, facts);
  });
  return facts_.finish(plainly_.is_open);
}

/// A polygon that touches another operand's surface from one side, and in one polygon only, is
/// inside the operand if it is behind that polygon: then its patch needs no ray. (On an edge of
/// that polygon it would touch the next one, too.)
void PatchFates::add_rim_facts(uint32_t polygon, ByOperand& by_operand, PatchFacts& facts) const {
  if (is_cut_[polygon] || contacts_.is_in_flat_corner(polygon)) return;
  const auto operand = [&](const Contact& c) {
    return job_.polygons()[c.p == polygon ? c.q : c.p].operand;
  };
  const auto tells = [&](const Contact& c) {
    const bool is_one_sided = c.p == polygon ? c.p_front != c.p_back : c.q_front != c.q_back;
    return is_one_sided && !c.is_plain && !c.is_coplanar;
  };
  const auto all = contacts_.of(polygon);
  if (std::none_of(all.begin(), all.end(), [&](uint32_t i) { return tells(contacts_[i]); })) return;
  by_operand.clear();
  for (const uint32_t i : all) by_operand.emplace_back(operand(contacts_[i]), i);
  sort_few(by_operand.begin(), by_operand.end(), pair_less);
  for (size_t first = 0, end = 0; first < by_operand.size(); first = end) {
    const auto [own, contact] = by_operand[first];
    while (end < by_operand.size() && by_operand[end].first == own) ++end;
    const Contact& c = contacts_[contact];
    if (end - first > 1 || !tells(c)) continue;
    const bool is_behind = c.p == polygon ? c.p_back : c.q_back;
    facts.add(patches_.root(vertex_of_polygon_[polygon]), {own, is_behind, is_behind});
  }
}

/// Patches that hold a corner of a polygon that is seen to be boundary of nothing, as they are.
void PatchFates::drop_covered() {
  const std::vector<uint8_t>& plainly_covered = plainly_.polygons;
  patch_fates_.assign(job_.vertex_count(), kUnasked);
  for_each_range(plainly_covered.size(), [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) {
      if (!plainly_covered[p]) continue;
      for (const uint32_t v : job_.corners(job_.polygons()[p])) {
        if (contacts_.touched()[v]) continue;
        std::atomic_ref(patch_fates_[patches_.root(v)])
            .store(static_cast<uint8_t>(PatchFate::kDrop), std::memory_order_relaxed);
      }
    }
  });
}

/// Joins loops that pass no vertex of their own across edges along which no other operand has
/// anything: two triangles of one face of an operand that lies on a larger face, say. All that is
/// in front of one of them, or behind it, is so of the other.
void PatchFates::join_bare_loops() {
  struct Edge {
    uint64_t ends;
    uint32_t operand, plane, loop;
    bool flipped;
    [[nodiscard]] auto place() const { return std::tuple(ends, operand, plane, flipped); }
  };
  std::vector<Edge> edges;
  for (const CutFaces::Face& cut : cut_.faces) {
    const JobPolygon& polygon = job_.polygons()[cut.polygon];
    for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
      const CutLoops::Loop& loop = cut_.loops.loops[l];
      if (!loop.is_bare || loop.vertex != kNone) continue;
      const std::span<const uint32_t> points = cut_.loops.points(loop);
      for (size_t c = 0; c < points.size(); ++c) {
        edges.push_back({ends_together(points[c], points[c + 1 < points.size() ? c + 1 : 0]),
                         polygon.operand, polygon.support.index(), l, polygon.support.flipped()});
      }
    }
  }
  if (edges.empty()) return;
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.place() != b.place() ? a.place() < b.place() : a.loop < b.loop;
  });
  const auto loops = static_cast<uint32_t>(cut_.loops.loops.size());
  bare_loops_.reset(loops);
  for (size_t i = 1; i < edges.size(); ++i) {
    if (edges[i - 1].place() == edges[i].place()) {
      bare_loops_.join(edges[i - 1].loop, edges[i].loop);
    }
  }
  bare_loops_.flatten(0, loops);
}

void PatchFates::ask_about_loops() {
  fate_of_loop_.assign(cut_.loops.loops.size(), PatchFate::kDrop);
  for (const CutFaces::Face& cut : cut_.faces) {
    const uint32_t own = job_.polygons()[cut.polygon].operand;
    for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
      const uint32_t vertex = cut_.loops.loops[l].vertex;
      if (vertex == kNone) {
        if (stands_alone(l)) questions_.push_back({own, kNone, l});
      } else {
        ask(patches_.root(vertex), own);
      }
    }
  }
}

/// Asks about the patches of polygons that were not cut.
void PatchFates::ask_about_whole() {
  const auto list = [&](size_t begin, size_t end, std::vector<uint32_t>& unasked) {
    uint32_t last = kNone;
    for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
      if (vertex_of_polygon_[p] == kNone) continue;
      const uint32_t patch = patches_.root(vertex_of_polygon_[p]);
      if (patch == last || patch_fates_[patch] != kUnasked) continue;
      last = patch;
      unasked.push_back(last);
    }
  };
  for (const uint32_t patch :
       list_in_parts<uint32_t>(vertex_of_polygon_.size(), kFewForThreads, list)) {
    ask(patch, job_.operand_of_vertex(patch));
  }
  if (job_.near_faces()) ask_about_far_faces();
}

void PatchFates::ask_about_far_faces() {
  std::vector<std::vector<uint32_t>> unasked(job_.operand_count());
  for_each_alone(unasked.size(), job_.vertex_count() > kFewForThreads, [&](size_t o) {
    std::vector<uint32_t> own;
    job_.for_each_far_face(o, [&](uint32_t f) {
      const uint32_t patch = patches_.root(vertex_of_far_face(o, f));
      if (patch_fates_[patch] == kUnasked && (own.empty() || own.back() != patch)) {
        own.push_back(patch);
      }
    });
    unasked[o] = std::move(own);
  });
  for (size_t o = 0; o < unasked.size(); ++o) {
    for (const uint32_t patch : unasked[o]) ask(patch, static_cast<uint32_t>(o));
  }
}

/// Asks what becomes of a patch, once.
void PatchFates::ask(uint32_t patch, uint32_t own) {
  if (patch_fates_[patch] != kUnasked) return;
  patch_fates_[patch] = kAsked;
  questions_.push_back({own, patch, kNone});
}

/// Answers all questions, on several threads if they may be much work.
void PatchFates::answer() {
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

/// What is told of one of them is true of all; if nothing is, each is asked for itself.
void PatchFates::answer_for_bare_loops() {
  questions_.clear();
  for (const CutFaces::Face& cut : cut_.faces) {
    for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
      if (stands_alone(l)) continue;
      fate_of_loop_[l] = fate_of_loop_[bare_loops_.root(l)];
      if (fate_of_loop_[l] != PatchFate::kUnknown) continue;
      questions_.push_back({job_.polygons()[cut.polygon].operand, kNone, l});
    }
  }
  if (!questions_.empty()) answer();
}

void PatchFates::answer(const Question& q, PatchLabels& labels) {
  if (q.patch == kNone) {
    fate_of_loop_[q.loop] = fate_of_loop(cut_.loops.loops[q.loop], q.own, labels);
  } else {
    patch_fates_[q.patch] = static_cast<uint8_t>(
        labels.fate(q.own, job_.rounded(q.patch), labels.error(q.own), facts_.of(q.patch), false));
  }
}

/// That of one that passes no vertex.
PatchFate PatchFates::fate_of_loop(const CutLoops::Loop& loop, uint32_t own,
                                   PatchLabels& labels) const {
  // The middle of an edge is on no operand's surface that has none along the edge. Where it is in
  // line with too much, another one may do.
  constexpr uint32_t kMostTries = 4;
  PatchFate fate = PatchFate::kUnknown;
  for (uint32_t i = 0; i < kMostTries && fate == PatchFate::kUnknown; ++i) {
    fate = fate_at_edge(loop, i % loop.corner_count, own, labels);
  }
  return fate;
}

PatchFate PatchFates::fate_at_edge(const CutLoops::Loop& loop, uint32_t edge, uint32_t own,
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
                     {cut_.loops.facts.data() + loop.first_fact, loop.fact_count}, edge == 0);
}

}  // namespace csgrun

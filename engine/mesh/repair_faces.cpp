// Repair of faces that are nothing, or that are there more than once.
#include <algorithm>
#include <span>

#include "engine/base/none.h"
#include "engine/bsp/union_find.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/flat_points.h"
#include "engine/mesh/mesh_text.h"
#include "engine/mesh/repair_steps.h"

namespace csgrun {
namespace {

using Loop = std::vector<uint32_t>;

/// A face of one loop by its vertices alone: from the lowest on, towards its lower neighbour.
struct Outline {
  Loop loop;
  uint32_t face = 0;
  bool turned = false;
};

Outline outline_of(const LoopFace& face, uint32_t number) {
  Outline outline{face.loops[0], number, false};
  Loop& loop = outline.loop;
  std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
  if (loop.back() < loop[1]) {
    std::reverse(loop.begin() + 1, loop.end());
    outline.turned = true;
  }
  return outline;
}

/// The faces of one outline.
struct OutlineGroup {
  size_t begin, end;   // of outlines
  bool majority;       // the direction of most
  size_t rest;         // how many more there are that way than the other
  size_t stay = 0;     // how many stay
  bool waits = false;  // how many is not decided: all stay so far

  [[nodiscard]] size_t size() const { return end - begin; }
};

/// Groups of faces of one loop; outlines of one group are in the order of the faces.
std::vector<OutlineGroup> find_groups(const RepairMesh& mesh, std::vector<Outline>& outlines) {
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].loops.size() == 1) outlines.push_back(outline_of(mesh.faces[f], f));
  }
  std::stable_sort(outlines.begin(), outlines.end(),
                   [](const Outline& a, const Outline& b) { return a.loop < b.loop; });
  std::vector<OutlineGroup> groups;
  for (size_t begin = 0, end = 0; begin < outlines.size(); begin = end) {
    size_t turned = 0;
    for (; end < outlines.size() && outlines[end].loop == outlines[begin].loop; ++end) {
      turned += outlines[end].turned;
    }
    if (end - begin == 1) continue;
    const size_t straight = end - begin - turned;
    const bool majority = turned == straight ? outlines[begin].turned : turned > straight;
    groups.push_back(
        {begin, end, majority, std::max(turned, straight) - std::min(turned, straight)});
  }
  return groups;
}

/// One face of each group alone, and which group it stands for.
struct Singles {
  std::vector<LoopFace> faces;
  std::vector<uint32_t> group_of;  ///< of the faces in groups; else kNone
};
Singles single_faces(const RepairMesh& mesh, const std::vector<Outline>& outlines,
                     const std::vector<OutlineGroup>& groups) {
  Singles singles{mesh.faces, std::vector<uint32_t>(mesh.faces.size(), kNone)};
  for (uint32_t g = 0; g < groups.size(); ++g) {
    for (size_t i = groups[g].begin; i < groups[g].end; ++i) {
      if (i > groups[g].begin) singles.faces[outlines[i].face].loops.clear();
      singles.group_of[outlines[i].face] = g;
    }
  }
  return singles;
}

/// How many edges of a face say what.
struct Votes {
  int64_t odd = 0;    // an odd number of others ends there: one more is needed
  int64_t even = 0;   // an even number, and not none
  int64_t alone = 0;  // no other one ends there

  [[nodiscard]] bool is_needed() const { return odd >= even + alone; }
  /// Whether it hangs out without need.
  [[nodiscard]] bool is_flap() const { return alone > 0 && !is_needed(); }
  /// Whether it might be needed, if neighbours were found where it is alone.
  [[nodiscard]] bool may_be_needed() const { return alone > 0 && odd >= even; }
};

/// Of all faces but those that are left out, which count for none.
std::vector<Votes> votes_of_faces(const EdgeUses& edges, const std::vector<bool>& left_out) {
  std::vector<Votes> votes(left_out.size());
  edges.for_each_edge([&](std::span<const EdgeUse> uses) {
    const auto count = std::count_if(uses.begin(), uses.end(),
                                     [&](const EdgeUse& use) { return !left_out[use.face]; });
    for (const EdgeUse& use : uses) {
      Votes& own = votes[use.face];
      ++(count == 1 ? own.alone : count % 2 == 0 ? own.odd : own.even);
    }
  });
  return votes;
}

/// Flaps do not count for the faces beside them.
std::vector<Votes> votes_of_singles(const Singles& singles, const EdgeUses& edges) {
  std::vector<bool> left_out(singles.faces.size(), false);
  std::vector<Votes> votes = votes_of_faces(edges, left_out);
  for (uint32_t f = 0; f < left_out.size(); ++f) {
    left_out[f] = singles.group_of[f] != kNone && votes[f].is_flap();
  }
  if (std::find(left_out.begin(), left_out.end(), true) == left_out.end()) return votes;
  const std::vector<Votes> others = votes_of_faces(edges, left_out);
  for (uint32_t f = 0; f < left_out.size(); ++f) {
    if (!left_out[f]) votes[f] = others[f];
  }
  return votes;
}

/// For each face, whether all its edges are balanced.
std::vector<bool> balanced_faces(const RepairMesh& mesh) {
  std::vector<bool> balanced(mesh.faces.size(), true);
  EdgeUses(mesh.faces, mesh.points.size()).for_each_edge([&](std::span<const EdgeUse> uses) {
    if (excess(uses) == 0) return;
    for (const EdgeUse& use : uses) balanced[use.face] = false;
  });
  return balanced;
}

/// A surface that is there twice, back to back, all of it: one of each group stays where it is
/// needed.
void keep_two_sided_surfaces(const Singles& singles, const EdgeUses& edges,
                             const std::vector<Votes>& votes, std::vector<OutlineGroup>& groups) {
  UnionFind connected(singles.faces.size());
  edges.for_each_edge([&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) connected.join(use.face, uses[0].face);
  });
  std::vector<bool> something_stays(connected.size(), false);
  const auto group_of = [&](uint32_t f) {
    return singles.group_of[f] == kNone ? nullptr : &groups[singles.group_of[f]];
  };
  for (uint32_t f = 0; f < connected.size(); ++f) {
    if (singles.faces[f].loops.empty()) continue;
    if (group_of(f) == nullptr || group_of(f)->stay > 0) something_stays[connected.find(f)] = true;
  }
  for (uint32_t f = 0; f < connected.size(); ++f) {
    if (singles.faces[f].loops.empty() || group_of(f) == nullptr) continue;
    if (!something_stays[connected.find(f)] && votes[f].is_needed()) group_of(f)->stay = 1;
  }
}

}  // namespace

void StepNote::add_at(const glm::dvec3& point) {
  if (step_.places.size() < RepairStep::kMostPlaces) {
    step_.places.push_back("at " + rough_place_text(point));
  }
  ++step_.count;
}

void clean_faces(RepairMesh& mesh, StepNote& note) {
  for (LoopFace& face : mesh.faces) {
    const uint32_t first = face.loops.empty() || face.loops[0].empty() ? kNone : face.loops[0][0];
    for (Loop& loop : face.loops) clean_loop(loop);
    const bool is_empty = std::all_of(face.loops.begin(), face.loops.end(),
                                      [](const Loop& loop) { return loop.empty(); });
    if (!is_empty) continue;
    if (first == kNone) {
      note.add();  // it had no corner at all
    } else {
      note.add_at(mesh.points[first]);
    }
  }
  drop_empty_loops(mesh.faces);
}

void drop_flat_faces(RepairMesh& mesh, StepNote& note) {
  for (const LoopFace& face : mesh.faces) {
    const bool all_flat = std::all_of(face.loops.begin(), face.loops.end(),
                                      [&](const Loop& loop) { return is_flat(mesh.points, loop); });
    if (all_flat) note.add_at(mesh.points[face.loops[0][0]]);
  }
  if (note.step().count == 0) return;
  drop_collinear_loops(mesh.points, mesh.faces,
                       [&](const Loop& loop) { return is_flat(mesh.points, loop); });
}

Undecided drop_repeated_faces(RepairMesh& mesh, RepeatedFaces when, StepNote& note) {
  std::vector<Outline> outlines;
  std::vector<OutlineGroup> groups = find_groups(mesh, outlines);
  if (groups.empty()) return Undecided(mesh.faces.size(), false);
  const Singles singles = single_faces(mesh, outlines, groups);
  const EdgeUses edges(singles.faces, mesh.points.size());
  const std::vector<Votes> votes = votes_of_singles(singles, edges);
  const std::vector<bool> balanced = balanced_faces(mesh);
  for (OutlineGroup& group : groups) {
    const uint32_t face = outlines[group.begin].face;
    group.stay = balanced[face] || !votes[face].is_needed() ? group.rest : 1;
  }
  if (when != RepeatedFaces::kAfterFilling) keep_two_sided_surfaces(singles, edges, votes, groups);
  if (when == RepeatedFaces::kBeforeSplitting) {
    for (OutlineGroup& group : groups) {
      group.waits = group.stay != 1 && votes[outlines[group.begin].face].may_be_needed();
    }
  }
  std::vector<bool> dropped(mesh.faces.size(), false), waits(mesh.faces.size(), false);
  for (const OutlineGroup& group : groups) {
    size_t stay = group.stay;
    for (size_t i = group.begin; i < group.end; ++i) {
      waits[outlines[i].face] = group.waits;
      if (group.waits) continue;
      const bool stays = stay > 0 && outlines[i].turned == group.majority;
      stay -= stays;
      dropped[outlines[i].face] = !stays;
    }
  }
  Undecided undecided;
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!dropped[f]) {
      undecided.push_back(waits[f]);
      continue;
    }
    note.add_at(mesh.points[mesh.faces[f].loops[0][0]]);
    mesh.faces[f].loops.clear();
  }
  drop_empty_loops(mesh.faces);
  return undecided;
}

}  // namespace csgrun

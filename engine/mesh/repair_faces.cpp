// Repair of faces that are nothing, or that are there more than once.
#include <algorithm>
#include <span>

#include "engine/mesh/area_sum.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/mesh_text.h"
#include "engine/mesh/repair_steps.h"

namespace csgrun {
namespace {

using Loop = std::vector<uint32_t>;

bool is_flat(const RepairMesh& mesh, const Loop& loop) {
  AreaSum area(mesh.points, loop[0]);
  area.add_loop(loop);
  return area.is_rounding();
}

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

/// For each face, on how many of its edges an odd number of other faces ends, less the others.
std::vector<int64_t> need_of_faces(const std::vector<LoopFace>& faces, size_t point_count) {
  std::vector<int64_t> need(faces.size(), 0);
  EdgeUses(faces, point_count).for_each_edge([&](std::span<const EdgeUse> uses) {
    for (const EdgeUse& use : uses) need[use.face] += uses.size() % 2 == 0 ? 1 : -1;
  });
  return need;
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
    const uint32_t first = face.loops.empty() || face.loops[0].empty() ? 0 : face.loops[0][0];
    for (Loop& loop : face.loops) clean_loop(loop);
    const bool is_empty = std::all_of(face.loops.begin(), face.loops.end(),
                                      [](const Loop& loop) { return loop.empty(); });
    if (is_empty) note.add_at(mesh.points[first]);
  }
  drop_empty_loops(mesh.faces);
}

void drop_flat_faces(RepairMesh& mesh, StepNote& note) {
  for (const LoopFace& face : mesh.faces) {
    const bool all_flat = std::all_of(face.loops.begin(), face.loops.end(),
                                      [&](const Loop& loop) { return is_flat(mesh, loop); });
    if (all_flat) note.add_at(mesh.points[face.loops[0][0]]);
  }
  if (note.step().count == 0) return;
  drop_collinear_loops(mesh.points, mesh.faces,
                       [&](const Loop& loop) { return is_flat(mesh, loop); });
}

void drop_repeated_faces(RepairMesh& mesh, bool is_balanced, StepNote& note) {
  std::vector<Outline> outlines;
  outlines.reserve(mesh.faces.size());
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (mesh.faces[f].loops.size() == 1) outlines.push_back(outline_of(mesh.faces[f], f));
  }
  std::stable_sort(outlines.begin(), outlines.end(),
                   [](const Outline& a, const Outline& b) { return a.loop < b.loop; });

  // Groups of the same outline, and one face of each: the first of the majority.
  struct Group {
    size_t begin, end;  // of outlines
    bool majority;      // its direction
    size_t rest;        // how many more there are that way than the other
    uint32_t kept;
  };
  std::vector<Group> groups;
  std::vector<bool> dropped(mesh.faces.size(), false);
  for (size_t begin = 0, end = 0; begin < outlines.size(); begin = end) {
    size_t turned = 0;
    for (; end < outlines.size() && outlines[end].loop == outlines[begin].loop; ++end) {
      turned += outlines[end].turned;
    }
    if (end - begin == 1) continue;
    const size_t straight = end - begin - turned;
    Group group{begin, end, turned > straight, std::max(turned, straight), 0};
    if (turned == straight) group.majority = outlines[begin].turned;
    group.rest -= std::min(turned, straight);
    size_t first = begin;
    while (outlines[first].turned != group.majority) ++first;
    group.kept = outlines[first].face;
    for (size_t i = begin; i < end; ++i) dropped[outlines[i].face] = i != first;
    groups.push_back(group);
  }
  if (groups.empty()) return;

  std::vector<LoopFace> single = mesh.faces;
  for (size_t f = 0; f < single.size(); ++f) {
    if (dropped[f]) single[f].loops.clear();
  }
  const std::vector<int64_t> need = need_of_faces(single, mesh.points.size());
  for (const Group& group : groups) {
    if (need[group.kept] >= 0 && !is_balanced) continue;
    if (need[group.kept] >= 0) {
      for (size_t i = group.begin; i < group.end; ++i) dropped[outlines[i].face] = false;
      continue;
    }
    // An even number must stay: what is left when pairs back to back are taken away.
    size_t rest = group.rest;
    for (size_t i = group.begin; i < group.end; ++i) {
      const bool stays = outlines[i].turned == group.majority && rest > 0;
      rest -= stays;
      dropped[outlines[i].face] = !stays;
    }
  }
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    if (!dropped[f]) continue;
    note.add_at(mesh.points[mesh.faces[f].loops[0][0]]);
    mesh.faces[f].loops.clear();
  }
  drop_empty_loops(mesh.faces);
}

}  // namespace csgrun

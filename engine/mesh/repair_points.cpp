// Repair of open edges by moving points together and by splitting edges at points on them.
#include <algorithm>
#include <cmath>
#include <span>

#include "engine/base/none.h"
#include "engine/mesh/box_tree.h"
#include "engine/mesh/edge_uses.h"
#include "engine/mesh/mesh_text.h"
#include "engine/mesh/repair_steps.h"

namespace csgrun {
namespace {

/// The open edges, which no orientation balances; or also those that are not balanced as faces run
/// now.
std::vector<EdgeUse> open_edges(const RepairMesh& mesh, const Undecided& undecided,
                                bool or_unbalanced) {
  std::vector<EdgeUse> open, decided;
  EdgeUses(mesh.faces, mesh.points.size()).for_each_edge([&](std::span<const EdgeUse> uses) {
    decided.clear();
    for (const EdgeUse& use : uses) {
      if (!undecided[use.face]) decided.push_back(use);
    }
    const bool is_open =
        decided.empty() || decided.size() % 2 == 1 || (or_unbalanced && excess(decided) != 0);
    if (is_open) open.push_back(uses[0]);
  });
  return open;
}

std::vector<uint32_t> ends_of(const std::vector<EdgeUse>& edges) {
  std::vector<uint32_t> ends;
  for (const EdgeUse& edge : edges) {
    ends.push_back(edge.low);
    ends.push_back(edge.high);
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

Box box_around(const glm::dvec3& p, const glm::dvec3& q, double margin) {
  Box box;
  for (int i = 0; i < 3; ++i) {
    box.lo[i] = std::min(p[i], q[i]) - margin;
    box.hi[i] = std::max(p[i], q[i]) + margin;
  }
  return box;
}

double squared(const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

double largest_coordinate(const glm::dvec3& p) {
  return std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
}

/// How far along the segment a point lies, in (0, 1), if it is within `tolerance` of its inside;
/// else -1.
double place_on(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& p, double tolerance) {
  const glm::dvec3 along = b - a, to = p - a;
  const double length2 = squared(along);
  const double t = (along.x * to.x + along.y * to.y + along.z * to.z) / length2;
  if (!(t > 0 && t < 1)) return -1;
  return squared(to - t * along) <= tolerance * tolerance ? t : -1;
}

}  // namespace

void weld_open_points(RepairMesh& mesh, const Undecided& undecided, double tolerance,
                      StepNote& note) {
  const std::vector<uint32_t> ends = ends_of(open_edges(mesh, undecided, false));
  std::vector<Box> boxes;
  boxes.reserve(ends.size());
  for (const uint32_t v : ends) {
    boxes.push_back(box_around(mesh.points[v], mesh.points[v], tolerance));
  }
  const BoxTree tree(boxes);
  std::vector<uint32_t> target(ends.size(), kNone);
  std::vector<double> distance(ends.size());
  for (uint32_t i = 0; i < ends.size(); ++i) {
    if (target[i] != kNone) continue;  // moved itself
    tree.visit_later(i, [&](uint32_t j) {
      const double d = squared(mesh.points[ends[j]] - mesh.points[ends[i]]);
      if (!(d <= tolerance * tolerance) || (target[j] != kNone && distance[j] <= d)) return;
      target[j] = i;
      distance[j] = d;
    });
  }
  std::vector<uint32_t> renamed(mesh.points.size(), kNone);
  for (size_t i = 0; i < ends.size(); ++i) {
    if (target[i] == kNone) continue;
    renamed[ends[i]] = ends[target[i]];
    note.add_at(mesh.points[ends[i]]);
  }
  note.step().tolerance = tolerance;
  for (LoopFace& face : mesh.faces) {
    for (auto& loop : face.loops) {
      for (uint32_t& v : loop) {
        if (renamed[v] != kNone) v = renamed[v];
      }
    }
  }
}

void split_open_edges(RepairMesh& mesh, const Undecided& undecided, double tolerance,
                      StepNote& note) {
  // What lies on a line in exact numbers is off it by some units in the last place of its doubles.
  constexpr double kRounding = 0x1p-50;
  // Where four faces meet, and two of them have a point in their edge, each half has an even
  // number.
  const std::vector<EdgeUse> edges = open_edges(mesh, undecided, true);
  const std::vector<uint32_t> ends = ends_of(edges);
  std::vector<Box> boxes;
  boxes.reserve(ends.size());
  for (const uint32_t v : ends) boxes.push_back(box_around(mesh.points[v], mesh.points[v], 0));
  const BoxTree tree(boxes);
  EdgeSplits splits;
  std::vector<std::pair<double, uint32_t>> inside;
  for (const EdgeUse& edge : edges) {
    const glm::dvec3 &a = mesh.points[edge.low], &b = mesh.points[edge.high];
    const double margin =
        std::max(tolerance, kRounding * std::max(largest_coordinate(a), largest_coordinate(b)));
    inside.clear();
    tree.visit_all(box_around(a, b, margin), [&](uint32_t j) {
      const uint32_t v = ends[j];
      if (v == edge.low || v == edge.high) return;
      const double t = place_on(a, b, mesh.points[v], margin);
      if (t > 0) inside.emplace_back(t, v);
    });
    if (inside.empty()) continue;
    std::sort(inside.begin(), inside.end());
    std::vector<uint32_t>& inner = splits[{edge.low, edge.high}];
    for (const auto& [t, v] : inside) inner.push_back(v);
    note.add(rough_place_text(a) + " - " + rough_place_text(b));
  }
  note.step().tolerance = tolerance;
  if (splits.empty()) return;
  for (LoopFace& face : mesh.faces) {
    for (auto& loop : face.loops) apply_splits(splits, loop);
  }
}

}  // namespace csgrun

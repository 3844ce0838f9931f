#include "tests/bench/hull_workloads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/exact_triangles.h>

#include "engine/csg/grid.h"

namespace csgrun::bench {
namespace {

using Triangle = std::array<uint32_t, 3>;

/// The arrays of a surface that moves.
struct Surface {
  std::vector<glm::dvec3> points;
  std::vector<Triangle> triangles;
};

Surface surface_of(const PolygonMesh& mesh) { return {mesh.points, triangles_of(mesh)}; }

std::shared_ptr<const PolygonMesh> leaf_mesh(const Surface& s) {
  auto mesh = std::make_shared<PolygonMesh>();
  mesh->points = s.points;
  mesh->keep_facets = true;
  for (const Triangle& t : s.triangles) {
    mesh->corners.insert(mesh->corners.end(), t.begin(), t.end());
    mesh->loop_starts.push_back(static_cast<uint32_t>(mesh->corners.size()));
    mesh->face_starts.push_back(static_cast<uint32_t>(mesh->loop_count()));
  }
  return mesh;
}

/// Pairs of triangles that meet in anything but common corners and edges, by place.
size_t crossings(const Surface& s) {
  return find_crossings({s.points, s.triangles}, UINT64_MAX).size();
}

/// The surface of a solid; what touches has the same points.
Surface surface_of(const Solid& solid) {
  Surface s{solid.positions, solid.triangles};
  uint32_t points = 0;  // numbers of points that no vertex has are left out of the vertices
  for (const uint32_t p : solid.point_of) points = std::max(points, p + 1);
  std::vector<uint32_t> first(points, UINT32_MAX);
  for (Triangle& t : s.triangles) {
    for (uint32_t& v : t) {
      uint32_t& copy = first[solid.point_of[v]];
      if (copy == UINT32_MAX) copy = v;
      v = copy;
    }
  }
  return s;
}

glm::dvec3 cross(const glm::dvec3& a, const glm::dvec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const glm::dvec3& a) { return std::sqrt(dot(a, a)); }

/// The normals of the vertices: those of the triangles around, weighted by their angles.
std::vector<glm::dvec3> vertex_normals(const Surface& s) {
  std::vector<glm::dvec3> normals(s.points.size(), glm::dvec3(0));
  for (const Triangle& t : s.triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3& p = s.points[t[k]];
      const glm::dvec3 u = s.points[t[(k + 1) % 3]] - p, v = s.points[t[(k + 2) % 3]] - p;
      const glm::dvec3 n = cross(u, v);
      const double area = length(n);
      if (area > 0) normals[t[k]] += n * (std::atan2(area, dot(u, v)) / area);
    }
  }
  for (glm::dvec3& n : normals) {
    if (const double l = length(n); l > 0) n /= l;
  }
  return normals;
}

/// The points of a grid near those given, as the engine would round them and give them back.
void snap(std::vector<glm::dvec3>& points, const GridStep& step) {
  const Quantiser quantise(step);
  for (glm::dvec3& p : points) {
    IVec3 whole{};
    for (int k = 0; k < 3; ++k) {
      const auto n = quantise(p[k]);
      if (!n) fail("the front leaves the grid");
      whole[static_cast<size_t>(k)] = *n;
    }
    p = to_millimetres(whole, step);
  }
}

/// Along how many connected curves a surface was cut: groups of points that it did not have before.
size_t count_curves(const Surface& before, const Solid& after) {
  const auto less = [](const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::vector<glm::dvec3> known = before.points;
  std::sort(known.begin(), known.end(), less);
  std::vector<uint32_t> group(after.positions.size());
  std::iota(group.begin(), group.end(), 0u);
  const auto root = [&](uint32_t v) {
    while (group[v] != v) v = group[v] = group[group[v]];
    return v;
  };
  std::vector<bool> is_new(after.positions.size());
  std::map<uint32_t, uint32_t> first_copy;
  for (uint32_t v = 0; v < is_new.size(); ++v) {
    is_new[v] = !std::binary_search(known.begin(), known.end(), after.positions[v], less);
    if (!is_new[v]) continue;
    const auto [copy, fresh] = first_copy.try_emplace(after.point_of[v], v);
    if (!fresh) group[root(v)] = root(copy->second);
  }
  for (const Triangle& t : after.triangles) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      if (is_new[a] && is_new[b]) group[root(a)] = root(b);
    }
  }
  size_t curves = 0;
  for (uint32_t v = 0; v < is_new.size(); ++v) curves += is_new[v] && root(v) == v;
  return curves;
}

EvaluateOptions evaluate_options(const Settings& settings) {
  EvaluateOptions options;
  options.threads = settings.threads;
  options.cell_limit = settings.cell_limit;
  return options;
}

}  // namespace

void run_hull(const std::string& name, const Settings& settings, const std::string& path) {
  const PolygonMesh mesh = read_solid(path);
  const Surface before = surface_of(mesh);
  Run run(name, settings, reach_of(mesh));
  run.count_input(before.triangles.size());
  const double wall = wall_seconds(), cpu = cpu_seconds();
  Evaluator evaluator(evaluate_options(settings));
  const NodePtr leaf = Node::leaf(leaf_mesh(before));
  const SolidPtr solid = take(evaluator.evaluate(Node::outer_hull({}, leaf)));
  run.clock.cpu = cpu_seconds() - cpu;
  run.clock.import = evaluator.stats().leaf_seconds;
  run.clock.op = evaluator.stats().boolean_seconds;
  run.clock.exporting = wall_seconds() - wall - run.clock.import - run.clock.op;
  const double rss = run.rss_mb();
  run.print(*solid, rss, evaluator.stats(),
            fmt::format(R"(,"crossings_in":{},"crossings_out":{})", crossings(before),
                        crossings(surface_of(*solid))));
}

void run_front(const std::string& name, const Settings& settings, const std::string& path,
               int steps) {
  Surface surface = surface_of(read_solid(path));
  glm::dvec3 lo(HUGE_VAL), hi(-HUGE_VAL);
  double reach = 0;
  for (const glm::dvec3& p : surface.points) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
      reach = std::max(reach, std::abs(p[k]));
    }
  }
  const double speed = length(hi - lo) / 500;
  Run run(name, settings, reach + speed * steps);
  run.count_input(surface.triangles.size());
  EvaluateOptions options = evaluate_options(settings);
  options.grid = run.step();
  SolidPtr solid;
  EvaluateStats stats;
  std::string report;
  std::array<double, 2> milliseconds{};  // without events, with
  std::array<int, 2> count{};
  for (int i = 0; i < steps; ++i) {
    const double move = 3 * i < steps ? -speed : speed;
    const std::vector<glm::dvec3> normals = vertex_normals(surface);
    for (size_t v = 0; v < surface.points.size(); ++v) surface.points[v] += move * normals[v];
    snap(surface.points, run.step());
    const auto mesh = leaf_mesh(surface);
    const double wall = wall_seconds(), cpu = cpu_seconds();
    Evaluator evaluator(options);
    solid = take(evaluator.evaluate(Node::outer_hull({true, false}, Node::leaf(mesh))));
    const double ms = 1e3 * (wall_seconds() - wall), cpu_ms = 1e3 * (cpu_seconds() - cpu);
    if (solid->empty()) fail(fmt::format("nothing is left after step {}", i + 1));
    stats = evaluator.stats();
    run.clock.import += stats.leaf_seconds;
    run.clock.op += stats.boolean_seconds;
    run.clock.exporting += ms / 1e3 - stats.leaf_seconds - stats.boolean_seconds;
    run.clock.cpu += cpu_ms / 1e3;
    const size_t events = count_curves(surface, *solid);
    milliseconds[events > 0] += ms;
    ++count[events > 0];
    report += fmt::format(R"({}{{"ms":{:.1f},"cpu_ms":{:.1f},"events":{},"tris":{},)"
                          R"("components":{},"genus":{}}})",
                          i ? "," : "", ms, cpu_ms, events, solid->triangles.size(),
                          solid->measures.components, solid->measures.genus);
    if (!settings.write_steps.empty()) {
      write_off(fmt::format("{}{}.off", settings.write_steps, i + 1), solid->positions,
                solid->triangles);
    }
    surface.points = solid->positions;
    surface.triangles = solid->triangles;
  }
  if (!solid) fail("no step was asked for");
  const auto mean = [&](size_t k) { return count[k] ? milliseconds[k] / count[k] : 0.0; };
  run.print(*solid, run.rss_mb(), stats,
            fmt::format(R"(,"ms_without_events":{:.1f},"ms_with_events":{:.1f},"steps":[{}])",
                        mean(0), mean(1), report));
}

}  // namespace csgrun::bench

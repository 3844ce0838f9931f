// csgbench WORKLOAD ARGS [--threads N] [--repeat R]: one JSON line for each run.
//
// `import` is raw arrays to kernel meshes, `op` the Boolean, `export` kernel mesh to indexed triangles
// in memory (without measuring them); cpu_s is the CPU time of all threads for the three. Volume and
// area are the exact ones of the result, computed outside the clock.
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/primitives/mesh_file.h>

#include "engine/bsp/kernel.h"
#include "engine/csg/grid.h"
#include "engine/csg/quantise.h"
#include "engine/mesh/boundary_volume.h"
#include "engine/mesh/present.h"
#include "tests/bench/workloads.h"

namespace csgrun::bench {
namespace {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

/// What the process holds now, in MB.
double resident_mb() {
  std::FILE* f = std::fopen("/proc/self/statm", "r");
  unsigned long pages = 0, ignored = 0;
  if (f) {
    if (std::fscanf(f, "%lu %lu", &ignored, &pages) != 2) pages = 0;
    std::fclose(f);
  }
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

[[noreturn]] void fail(const std::string& message) {
  std::fprintf(stderr, "csgbench: %s\n", message.c_str());
  std::exit(1);
}

template <class T>
T take(Result<T> r) {
  if (!r) fail(r.error().message);
  return std::move(*r);
}

/// The three clocks of a run.
struct Clock {
  double import = 0, op = 0, exporting = 0, cpu = 0;

  template <class F>
  auto timed(double& seconds, F&& f) {
    const double w = wall_seconds(), c = cpu_seconds();
    auto result = f();
    seconds += wall_seconds() - w;
    cpu += cpu_seconds() - c;
    return result;
  }
};

struct Settings {
  unsigned threads = 1;
  int repeat = 1;
};

/// A run under way: the grid, the counters and what it has measured so far.
class Run {
 public:
  Run(std::string name, const Settings& settings, double reach)
      : name_(std::move(name)),
        settings_(settings),
        step_(choose_step(reach, reach)),
        quantiser_(step_),
        before_mb_(resident_mb()) {
    options_.threads = settings.threads;
  }

  Operand import(const RawMesh& raw, bool keep_facets) {
    input_triangles_ += raw.triangle_count();
    return clock.timed(clock.import, [&] {
      PolygonMesh mesh;
      mesh.points.resize(raw.point_count());
      for (size_t i = 0; i < raw.point_count(); ++i) {
        mesh.points[i] = {raw.points[3 * i], raw.points[3 * i + 1], raw.points[3 * i + 2]};
      }
      mesh.corners = raw.triangles;
      for (size_t t = 1; t <= raw.triangle_count(); ++t) {
        mesh.loop_starts.push_back(static_cast<uint32_t>(3 * t));
        mesh.face_starts.push_back(static_cast<uint32_t>(t));
      }
      mesh.keep_facets = keep_facets;
      const auto points = round_points(mesh, LeafRounding{}, quantiser_);
      if (!points) fail("the mesh does not fit the grid");
      const std::vector<uint32_t> appearance(mesh.face_count(), 0);
      PreparedLeaf leaf = prepare_leaf(mesh, *points, false, appearance);
      if (leaf.status != PreparedLeaf::Status::kGood) fail("not a clean solid after quantisation");
      Operand operand;
      operand.leaf = leaf.geometry;
      operand.first_source = sources_++;
      for (int k = 0; k < 3; ++k) {
        region_.lo[k] = std::min(region_.lo[k], leaf.box.lo[k]);
        region_.hi[k] = std::max(region_.hi[k], leaf.box.hi[k]);
      }
      return operand;
    });
  }

  /// One n-ary operation: union of all, or the first less the rest.
  std::shared_ptr<const BoundaryMesh> evaluate(const std::vector<Operand>& operands, BooleanOp op) {
    Expression expression;
    Expression::Node root;
    root.is_operand = false;
    root.op = op;
    root.child_count = static_cast<uint32_t>(operands.size());
    for (uint32_t i = 0; i < operands.size(); ++i) {
      Expression::Node leaf;
      leaf.operand = i;
      expression.nodes.push_back(leaf);
      expression.children.push_back(i);
    }
    expression.nodes.push_back(root);
    return clock.timed(clock.op, [&] {
      return take(evaluate_boolean(operands, expression, region_, options_, stats_));
    });
  }

  void finish(const BoundaryMesh& boundary, const std::string& extra = "") {
    PresentContext context;
    context.step = step_;
    context.appearances.resize(1);
    context.sources.resize(sources_);
    context.measure = false;
    SolidPtr solid =
        clock.timed(clock.exporting, [&] { return take(present(boundary, context)); });
    const double rss = peak_mb() - before_mb_;
    context.measure = true;
    solid = take(present(boundary, context));
    print(*solid, rss, stats_, extra);
  }

  void print(const Solid& solid, double rss, const EvaluateStats& s, const std::string& extra) const {
    fmt::print(
        R"({{"name":"{}","threads":{},"n_in_tris":{},"n_out_tris":{},"import_s":{:.6f},"op_s":{:.6f},)"
        R"("export_s":{:.6f},"cpu_s":{:.6f},"rss_mb":{:.1f},"volume":{},"area":{},"closed":{},)"
        R"("counters":{{"cells":{},"surface_cells":{},"solved_cells":{},"critical_cells":{},"filter":{},"symbolic":{},)"
        R"("exact64":{},"exact128":{},"exact192":{},"exact256":{},"exact384":{},"exact512":{}{}}}}})"
        "\n",
        name_, settings_.threads, input_triangles_, solid.triangles.size(), clock.import, clock.op,
        clock.exporting, clock.cpu, rss, solid.measures.volume, solid.measures.area,
        solid.measures.closed, s.cells, s.surface_cells,
        s.solved_cells, s.critical_cells, s.sign_filter,
        s.sign_symbolic, s.sign_exact[0], s.sign_exact[1], s.sign_exact[2], s.sign_exact[3],
        s.sign_exact[4], s.sign_exact[5], extra);
    std::fflush(stdout);
  }

  [[nodiscard]] const GridStep& step() const { return step_; }
  void count_input(size_t triangles) { input_triangles_ += triangles; }

  Clock clock;

 private:
  std::string name_;
  Settings settings_;
  GridStep step_;
  Quantiser quantiser_;
  double before_mb_;
  KernelOptions options_;
  EvaluateStats stats_;
  size_t input_triangles_ = 0;
  uint32_t sources_ = 0;
  GridBox region_{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
};

double reach_of(const std::vector<RawMesh>& meshes) {
  double reach = 0;
  for (const RawMesh& m : meshes) {
    for (const double c : m.points) reach = std::max(reach, std::abs(c));
  }
  return reach;
}

RawMesh read_raw(const std::string& path) {
  const PolygonMesh mesh = take(read_mesh_file(path));
  RawMesh raw;
  for (const glm::dvec3& p : mesh.points) raw.points.insert(raw.points.end(), {p.x, p.y, p.z});
  for (size_t l = 0; l < mesh.loop_count(); ++l) {
    const uint32_t first = mesh.loop_starts[l];
    for (uint32_t c = first + 1; c + 1 < mesh.loop_starts[l + 1]; ++c) {
      raw.triangles.insert(raw.triangles.end(),
                           {mesh.corners[first], mesh.corners[c], mesh.corners[c + 1]});
    }
  }
  return raw;
}

void run_nary(const std::string& name, const Settings& settings, const std::vector<RawMesh>& meshes,
              BooleanOp op, bool keep_facets) {
  Run run(name, settings, reach_of(meshes));
  std::vector<Operand> operands;
  for (const RawMesh& m : meshes) operands.push_back(run.import(m, keep_facets));
  run.finish(*run.evaluate(operands, op));
}

/// One operation after another; every result is a kernel mesh whose box and volume are asked.
void run_chain(const std::string& name, const Settings& settings, const std::vector<RawMesh>& meshes,
               BooleanOp op) {
  Run run(name, settings, reach_of(meshes));
  std::vector<Operand> tools;
  for (const RawMesh& m : meshes) tools.push_back(run.import(m, false));
  Operand result = tools[0];
  const size_t steps = tools.size() - 1, tenth = std::max<size_t>(1, steps / 10);
  double first_tenth = 0, last_tenth = 0, asked = 0;
  std::shared_ptr<const BoundaryMesh> boundary = run.evaluate({result}, BooleanOp::kUnion);
  for (size_t i = 1; i <= steps; ++i) {
    const double start = run.clock.op;
    result = Operand{};
    result.boundary = boundary;
    boundary = run.evaluate({result, tools[i]}, op);
    run.clock.timed(run.clock.op, [&] {
      const GridBox box = bounding_box(*boundary);
      asked += take(boundary_volume(*boundary, run.step())) + static_cast<double>(box.hi[0] > 0);
      return 0;
    });
    const double seconds = run.clock.op - start;
    if (i <= tenth) first_tenth += seconds;
    if (i > steps - tenth) last_tenth += seconds;
  }
  if (!(asked > 0)) fail("a result of the chain has no volume");
  run.finish(*boundary, fmt::format(R"(,"first_tenth_s":{:.6f},"last_tenth_s":{:.6f})", first_tenth,
                                    last_tenth));
}

/// The turn as a transform, that is, by a frame: through the evaluator.
void run_rotframe(const std::string& name, const Settings& settings, const RawMesh& raw,
                  double degrees) {
  Run run(name, settings, reach_of({raw}));
  run.count_input(2 * raw.triangle_count());
  const double before = resident_mb();
  double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
  auto mesh = std::make_shared<PolygonMesh>();
  for (size_t i = 0; i < raw.points.size(); i += 3) {
    mesh->points.emplace_back(raw.points[i], raw.points[i + 1], raw.points[i + 2]);
    for (int k = 0; k < 2; ++k) {
      lo[k] = std::min(lo[k], raw.points[i + k]), hi[k] = std::max(hi[k], raw.points[i + k]);
    }
  }
  mesh->corners = raw.triangles;
  for (size_t t = 1; t <= raw.triangle_count(); ++t) {
    mesh->loop_starts.push_back(static_cast<uint32_t>(3 * t));
    mesh->face_starts.push_back(static_cast<uint32_t>(t));
  }
  mesh->keep_facets = true;
  const double cx = (lo[0] + hi[0]) / 2, cy = (lo[1] + hi[1]) / 2;
  const double s = std::sin(degrees * M_PI / 180), c = std::cos(degrees * M_PI / 180);
  Affine turn;
  turn.m = {{{c, -s, 0, cx - c * cx + s * cy}, {s, c, 0, cy - s * cx - c * cy}, {0, 0, 1, 0}}};
  EvaluateOptions options;
  options.threads = settings.threads;
  Evaluator evaluator(options);
  const double wall = wall_seconds(), cpu = cpu_seconds();
  const NodePtr leaf = Node::leaf(mesh);
  const SolidPtr solid = take(evaluator.evaluate(
      Node::boolean(BooleanOp::kUnion, {leaf, Node::transformed(turn, leaf)})));
  run.clock.cpu = cpu_seconds() - cpu;
  run.clock.import = evaluator.stats().leaf_seconds;
  run.clock.op = evaluator.stats().boolean_seconds;
  run.clock.exporting = wall_seconds() - wall - run.clock.import - run.clock.op;
  run.print(*solid, peak_mb() - before, evaluator.stats(), "");
}

/// Two boxes, many times: what one small operation costs.
void run_boxes(const std::string& name, const Settings& settings) {
  constexpr int kTimes = 2000;
  const std::vector<RawMesh> meshes{box(0, 0, 0, 2, 2, 2), box(1, 1, 1, 3, 3, 3)};
  Run run(name, settings, reach_of(meshes));
  std::shared_ptr<const BoundaryMesh> boundary;
  const std::vector<Operand> operands{run.import(meshes[0], false), run.import(meshes[1], false)};
  for (int i = 0; i < kTimes; ++i) boundary = run.evaluate(operands, BooleanOp::kUnion);
  run.finish(*boundary,
             fmt::format(R"(,"times":{},"op_us_each":{:.3f})", kTimes, run.clock.op / kTimes * 1e6));
}

constexpr const char* kUsage =
    "usage: csgbench WORKLOAD ARGS [--threads N] [--repeat R]\n"
    "  rot FILE ANGLE       union with a copy turned about z (vertices turned)\n"
    "  rotframe FILE ANGLE  the same turn as a transform\n"
    "  chain N              block minus N spheres, one after another\n"
    "  batch N              the same as one operation\n"
    "  menger K             a Menger sponge of level K\n"
    "  grid N               union of N x N cylinders\n"
    "  cubegrid N           N^3 touching unit cubes, one after another\n"
    "  boxes                two boxes, repeated\n";

void run_once(const std::vector<std::string>& words, const Settings& settings) {
  const std::string& workload = words[0];
  std::string name = workload;
  for (size_t i = 1; i < words.size(); ++i) {
    const size_t slash = words[i].rfind('/');
    name += " " + (slash == std::string::npos ? words[i] : words[i].substr(slash + 1));
  }
  const auto number = [&](size_t i) { return std::atoi(words[i].c_str()); };
  const auto joined = [](RawMesh first, std::vector<RawMesh> rest) {
    rest.insert(rest.begin(), std::move(first));
    return rest;
  };
  if (workload == "rot" && words.size() == 3) {
    const RawMesh raw = read_raw(words[1]);
    run_nary(name, settings, {raw, rotated_z(raw, std::atof(words[2].c_str()))}, BooleanOp::kUnion,
             true);
  } else if (workload == "rotframe" && words.size() == 3) {
    run_rotframe(name, settings, read_raw(words[1]), std::atof(words[2].c_str()));
  } else if (workload == "chain" && words.size() == 2) {
    run_chain(name, settings, joined(block(), drill_spheres(number(1))), BooleanOp::kDifference);
  } else if (workload == "batch" && words.size() == 2) {
    run_nary(name, settings, joined(block(), drill_spheres(number(1))), BooleanOp::kDifference,
             false);
  } else if (workload == "menger" && words.size() == 2) {
    run_nary(name, settings, joined(menger_cube(number(1)), menger_bars(number(1))),
             BooleanOp::kDifference, false);
  } else if (workload == "grid" && words.size() == 2) {
    run_nary(name, settings, cylinder_grid(number(1)), BooleanOp::kUnion, false);
  } else if (workload == "cubegrid" && words.size() == 2) {
    run_chain(name, settings, cube_grid(number(1)), BooleanOp::kUnion);
  } else if (workload == "boxes" && words.size() == 1) {
    run_boxes(name, settings);
  } else {
    std::fprintf(stderr, "%s", kUsage);
    std::exit(2);
  }
}

}  // namespace
}  // namespace csgrun::bench

int main(int argc, char** argv) {
  csgrun::bench::Settings settings;
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--threads" && has_value) {
      settings.threads = static_cast<unsigned>(std::atoi(argv[++i]));
    } else if (word == "--repeat" && has_value) {
      settings.repeat = std::atoi(argv[++i]);
    } else {
      words.push_back(word);
    }
  }
  if (words.empty() || settings.threads == 0) {
    std::fprintf(stderr, "%s", csgrun::bench::kUsage);
    return 2;
  }
  for (int r = 0; r < settings.repeat; ++r) csgrun::bench::run_once(words, settings);
  return 0;
}

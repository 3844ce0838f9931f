#include "tests/bench/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <csgrun/primitives/mesh_file.h>

#include "engine/base/parallel.h"
#include "engine/bsp/job.h"
#include "engine/bsp/octree.h"
#include "engine/bsp/self_resolution.h"
#include "engine/csg/quantise.h"

namespace csgrun::bench {

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

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

void fail(const std::string& message) {
  std::fprintf(stderr, "csgbench: %s\n", message.c_str());
  std::exit(1);
}

std::string name_of(const std::vector<std::string>& words) {
  std::string name = words[0];
  for (size_t i = 1; i < words.size(); ++i) {
    const size_t slash = words[i].rfind('/');
    name += " " + (slash == std::string::npos ? words[i] : words[i].substr(slash + 1));
  }
  return name;
}

Run::Run(std::string name, const Settings& settings, const GridStep& step)
    : name_(std::move(name)), settings_(settings), step_(step), before_mb_(resident_mb()) {
  options.threads = settings.threads;
  options.cell_limit = settings.cell_limit;
}

std::vector<IVec3> Run::on_grid(const PolygonMesh& mesh) const {
  auto points = round_points(mesh, LeafRounding{}, Quantiser(step_));
  if (!points) fail("the mesh does not fit the grid");
  return *std::move(points);
}

namespace {

PreparedLeaf prepared(const PolygonMesh& mesh, const std::vector<IVec3>& points) {
  PreparedLeaf leaf = prepare_leaf(mesh, points, false, FaceNumbers::all(0));
  using Status = PreparedLeaf::Status;
  if (leaf.status != Status::kGood && leaf.status != Status::kTangled) {
    fail("not a solid after quantisation");
  }
  return leaf;
}

}  // namespace

void Run::note_input(const PolygonMesh& mesh, const std::vector<IVec3>& points) {
  for (size_t l = 0; l < mesh.loop_count(); ++l) {
    input_triangles_ += mesh.loop_starts[l + 1] - mesh.loop_starts[l] - 2;
  }
  if (!settings_.write_inputs.empty()) {
    std::vector<glm::dvec3> rounded;
    for (const IVec3& p : points) rounded.push_back(to_millimetres(p, step_));
    write_off(fmt::format("{}{}.off", settings_.write_inputs, sources_), rounded,
              triangles_of(mesh));
  }
}

Operand Run::operand_of(const PreparedLeaf& leaf) {
  Operand operand;
  operand.leaf = leaf.geometry;
  operand.first_source = sources_++;
  if (leaf.status == PreparedLeaf::Status::kTangled) {
    // Rounding made it cross itself, or it did before.
    Operand resolved;
    resolved.boundary =
        take(resolve_surface(operand, leaf.crossings, InsideRule::kNonZero, options, stats_));
    operand = resolved;
  }
  for (int k = 0; k < 3; ++k) {
    region_.lo[k] = std::min(region_.lo[k], leaf.box.lo[k]);
    region_.hi[k] = std::max(region_.hi[k], leaf.box.hi[k]);
  }
  return operand;
}

Operand Run::import(const PolygonMesh& mesh, const std::vector<IVec3>& points) {
  note_input(mesh, points);
  return clock.timed(clock.import, [&] { return operand_of(prepared(mesh, points)); });
}

std::vector<Operand> Run::import(const std::vector<RawMesh>& meshes, bool keep_facets) {
  if (!settings_.write_inputs.empty()) {
    std::vector<Operand> operands;
    for (const RawMesh& m : meshes) operands.push_back(import(m, keep_facets));
    return operands;
  }
  for (const RawMesh& m : meshes) input_triangles_ += m.triangle_count();
  expect_faces(input_triangles_);
  return clock.timed(clock.import, [&] {
    std::vector<PreparedLeaf> leaves(meshes.size());
    for_each_part(meshes.size(), 1, [&](size_t, size_t i, size_t) {
      const PolygonMesh mesh = polygon_mesh(meshes[i], keep_facets);
      leaves[i] = prepared(mesh, on_grid(mesh));
    });
    std::vector<Operand> operands;
    for (const PreparedLeaf& leaf : leaves) operands.push_back(operand_of(leaf));
    return operands;
  });
}

Operand Run::import(const PolygonMesh& mesh) {
  return import(mesh, clock.timed(clock.import, [&] { return on_grid(mesh); }));
}

Operand Run::import(const RawMesh& raw, bool keep_facets) {
  return import(clock.timed(clock.import, [&] { return polygon_mesh(raw, keep_facets); }));
}

namespace {

/// `op` over operands 0 to count - 1.
Expression one_operation(size_t count, BooleanOp op) {
  Expression expression;
  Expression::Node root;
  root.is_operand = false;
  root.op = op;
  root.child_count = static_cast<uint32_t>(count);
  for (uint32_t i = 0; i < count; ++i) {
    Expression::Node leaf;
    leaf.operand = i;
    expression.nodes.push_back(leaf);
    expression.children.push_back(i);
  }
  expression.nodes.push_back(root);
  return expression;
}

}  // namespace

std::shared_ptr<const BoundaryMesh> Run::evaluate(const std::vector<Operand>& operands,
                                                  BooleanOp op) {
  const Expression expression = one_operation(operands.size(), op);
  if (!settings_.write_cells.empty()) write_cells(operands, expression);
  return clock.timed(clock.op, [&] {
    return take(evaluate_boolean(operands, expression, region_, options, stats_));
  });
}

PiecesPtr Run::evaluate_next(const PiecesPtr& before, const std::vector<Operand>& operands,
                             BooleanOp op) {
  const size_t count = operands.size() + (before ? 1 : 0);
  const Expression expression = one_operation(count, op);
  PiecesPtr pieces =
      take(before ? change_pieces(*before, operands, expression, region_, options, stats_)
                  : evaluate_pieces(operands, expression, region_, options, stats_));
  if (!pieces) fail("a result cannot be in pieces");
  return pieces;
}

void Run::write_cells(const std::vector<Operand>& operands, const Expression& expression) const {
  Job job(operands);
  const Octree octree = build_octree(job, expression, region_, options);
  std::FILE* file = std::fopen(settings_.write_cells.c_str(), "w");
  if (!file) fail("cannot write " + settings_.write_cells);
  const double step = step_.millimetres();
  for (const CriticalCell& cell : octree.critical) {
    const auto corner = [&](const IVec3& c) {
      return fmt::format("{} {} {}", static_cast<double>(c[0]) * step,
                         static_cast<double>(c[1]) * step, static_cast<double>(c[2]) * step);
    };
    std::fprintf(file, "%s %s\n", corner(cell.box.lo).c_str(), corner(cell.box.hi).c_str());
  }
  if (std::fclose(file) != 0) fail("cannot write " + settings_.write_cells);
}

PresentContext Run::context(Measuring measuring) const {
  PresentContext context;
  context.step = step_;
  context.appearances.resize(1);
  context.measuring = measuring;
  return context;
}

SolidPtr Run::arrays(const BoundaryMesh& boundary) {
  return clock.timed(clock.exporting,
                     [&] { return take(present(boundary, context(Measuring::kNothing))); });
}

SolidPtr Run::measured(const BoundaryMesh& boundary) const {
  return take(present(boundary, context(Measuring::kAll)));
}

void Run::finish(const BoundaryMesh& boundary, const std::string& extra) {
  arrays(boundary);
  const double rss = rss_mb();
  print(*measured(boundary), rss, stats_,
        fmt::format(R"(,"import_cpu_s":{:.6f},"op_cpu_s":{:.6f},"export_cpu_s":{:.6f}{})",
                    clock.import_cpu, clock.op_cpu, clock.cpu - clock.import_cpu - clock.op_cpu,
                    extra));
}

void Run::print(const Solid& solid, double rss, const EvaluateStats& s,
                const std::string& extra) const {
  if (!settings_.write.empty()) write_off(settings_.write, solid.positions, solid.triangles);
  fmt::print(
      R"({{"name":"{}","threads":{},"n_in_tris":{},"n_out_tris":{},"import_s":{:.6f},"op_s":{:.6f},)"
      R"("export_s":{:.6f},"cpu_s":{:.6f},"rss_mb":{:.1f},"volume":{},"area":{},"closed":{},)"
      R"("counters":{{"cells":{},"surface_cells":{},"solved_cells":{},"critical_cells":{},)"
      R"("filter":{},"symbolic":{},"exact64":{},"exact128":{},"exact192":{},"exact256":{},)"
      R"("exact384":{},"exact512":{}{}}}}})"
      "\n",
      name_, settings_.threads, input_triangles_, solid.triangles.size(), clock.import, clock.op,
      clock.exporting, clock.cpu, rss, solid.measures.volume, solid.measures.area,
      solid.measures.closed, s.cells, s.surface_cells, s.solved_cells, s.critical_cells,
      s.sign_filter, s.sign_symbolic, s.sign_exact[0], s.sign_exact[1], s.sign_exact[2],
      s.sign_exact[3], s.sign_exact[4], s.sign_exact[5], extra);
  std::fflush(stdout);
}

glm::dvec3 to_millimetres(const IVec3& point, const GridStep& step) {
  glm::dvec3 p;
  for (size_t k = 0; k < 3; ++k) {
    // Both are whole and below 2^53, so the quotient is rounded once.
    const auto n = static_cast<double>(point[k] * step.numerator);
    p[static_cast<int>(k)] = std::ldexp(n / static_cast<double>(step.denominator), step.exponent);
  }
  return p;
}

double reach_of(const std::vector<RawMesh>& meshes) {
  double reach = 0;
  for (const RawMesh& m : meshes) {
    for (const double c : m.points) reach = std::max(reach, std::abs(c));
  }
  return reach;
}

double reach_of(const PolygonMesh& mesh) {
  double reach = 0;
  for (const glm::dvec3& p : mesh.points) {
    reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return reach;
}

std::vector<std::array<uint32_t, 3>> triangles_of(const PolygonMesh& mesh) {
  std::vector<std::array<uint32_t, 3>> triangles;
  for (size_t l = 0; l < mesh.loop_count(); ++l) {
    const uint32_t first = mesh.loop_starts[l];
    for (uint32_t c = first + 1; c + 1 < mesh.loop_starts[l + 1]; ++c) {
      triangles.push_back({mesh.corners[first], mesh.corners[c], mesh.corners[c + 1]});
    }
  }
  return triangles;
}

void write_off(const std::string& path, const std::vector<glm::dvec3>& points,
               const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::FILE* file = std::fopen(path.c_str(), "w");
  if (!file) fail("cannot write " + path);
  std::fprintf(file, "OFF\n%zu %zu 0\n", points.size(), triangles.size());
  for (const glm::dvec3& p : points) std::fprintf(file, "%.17g %.17g %.17g\n", p.x, p.y, p.z);
  for (const auto& t : triangles) std::fprintf(file, "3 %u %u %u\n", t[0], t[1], t[2]);
  if (std::fclose(file) != 0) fail("cannot write " + path);
}

RawMesh read_raw(const std::string& path) {
  const PolygonMesh mesh = take(read_mesh_file(path));
  RawMesh raw;
  for (const glm::dvec3& p : mesh.points) raw.points.insert(raw.points.end(), {p.x, p.y, p.z});
  for (const auto& t : triangles_of(mesh)) {
    raw.triangles.insert(raw.triangles.end(), t.begin(), t.end());
  }
  return raw;
}

PolygonMesh read_solid(const std::string& path) {
  std::string note;
  return take(make_solid_mesh(take(read_mesh_file(path)), &note));
}

}  // namespace csgrun::bench

// One run of a benchmark: clocks, the grid, operands, the kernel, and the line of JSON that says
// what came out.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <csgrun/engine/solid.h>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/kernel.h"
#include "engine/bsp/result_pieces.h"
#include "engine/csg/grid.h"
#include "engine/csg/quantise.h"
#include "engine/mesh/present.h"
#include "tests/bench/workloads.h"

namespace csgrun::bench {

double wall_seconds();
/// CPU seconds of all threads of the process.
double cpu_seconds();
/// What the process holds now, and the most that it held, in MB.
double resident_mb();
double peak_mb();

/// Says what went wrong and ends the process with 1.
[[noreturn]] void fail(const std::string& message);

template <class T>
T take(Result<T> r) {
  if (!r) fail(r.error().message);
  return std::move(*r);
}

/// The three clocks of a run: wall seconds, and the CPU seconds of all threads. To ask for the
/// latter takes a microsecond or two on some machines: what takes some 100 is timed many at once.
struct Clock {
  double import = 0, op = 0, exporting = 0, cpu = 0;
  double import_cpu = 0, op_cpu = 0;  ///< shares of `cpu`

  template <class F>
  auto timed(double& seconds, F&& f) {
    const double w = wall_seconds(), c = cpu_seconds();
    auto result = f();
    seconds += wall_seconds() - w;
    const double used = cpu_seconds() - c;
    cpu += used;
    if (&seconds == &import) import_cpu += used;
    if (&seconds == &op) op_cpu += used;
    return result;
  }
};

struct Settings {
  unsigned threads = 1;
  int repeat = 1;
  uint32_t cell_limit = 17;  ///< m of Campen & Kobbelt 2010, section 4.1
  bool check = false;        ///< of `pair`: the results as GLB are proved free of defects
  std::string write;         ///< an OFF file for the result, in doubles
  std::string write_steps;   ///< of `front`: what the names of OFF files for the steps begin with
  std::string write_inputs;  ///< what the names of OFF files for the operands begin with
  std::string write_cells;   ///< a file for the critical cells: lo and hi in mm, one a line
};

/// "rot statue.off 30": the words of a command without the folders of its files.
std::string name_of(const std::vector<std::string>& words);

/// A run under way: the grid, the counters and what it has measured so far.
class Run {
 public:
  Run(std::string name, const Settings& settings, const GridStep& step);
  /// On the grid that coordinates of `reach` mm ask for.
  Run(std::string name, const Settings& settings, double reach)
      : Run(std::move(name), settings, choose_step(reach, reach)) {}

  /// A leaf of a mesh; if it crosses itself on the grid, the solid of its nonzero winding numbers.
  Operand import(const PolygonMesh& mesh);
  /// The same for points that are on the grid already.
  Operand import(const PolygonMesh& mesh, const std::vector<IVec3>& points);
  Operand import(const RawMesh& raw, bool keep_facets);
  /// All of them, on the threads of the run.
  std::vector<Operand> import(const std::vector<RawMesh>& meshes, bool keep_facets);
  /// The points of a mesh on the run's grid.
  [[nodiscard]] std::vector<IVec3> on_grid(const PolygonMesh& mesh) const;

  /// One n-ary operation: union of all, or the first less the rest.
  std::shared_ptr<const BoundaryMesh> evaluate(const std::vector<Operand>& operands, BooleanOp op);
  /// The same with results in pieces, from one operation to the next; `before` is null at first.
  /// Not on the clock.
  PiecesPtr evaluate_next(const PiecesPtr& before, const std::vector<Operand>& operands,
                          BooleanOp op);
  /// The arrays of a result, on the clock; `measured` asks for volume, area and the rest, off it.
  SolidPtr arrays(const BoundaryMesh& boundary);
  [[nodiscard]] SolidPtr measured(const BoundaryMesh& boundary) const;

  /// Arrays, measures and the line.
  void finish(const BoundaryMesh& boundary, const std::string& extra = "");
  /// The line of the run; `extra` is added to its counters.
  void print(const Solid& solid, double rss, const EvaluateStats& s,
             const std::string& extra) const;

  [[nodiscard]] const GridStep& step() const { return step_; }
  [[nodiscard]] const EvaluateStats& stats() const { return stats_; }
  [[nodiscard]] double rss_mb() const { return peak_mb() - before_mb_; }
  void count_input(size_t triangles) { input_triangles_ += triangles; }

  Clock clock;
  KernelOptions options;

 private:
  [[nodiscard]] PresentContext context(Measuring measuring) const;
  void note_input(const PolygonMesh& mesh, const std::vector<IVec3>& points);
  Operand operand_of(const PreparedLeaf& leaf);
  void write_cells(const std::vector<Operand>& operands, const Expression& expression) const;

  std::string name_;
  Settings settings_;
  GridStep step_;
  double before_mb_;
  EvaluateStats stats_;
  size_t input_triangles_ = 0;
  uint32_t sources_ = 0;
  GridBox region_{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
};

/// Whole steps in millimetres, rounded once: what the engine gives back for them.
glm::dvec3 to_millimetres(const IVec3& point, const GridStep& step);
double reach_of(const std::vector<RawMesh>& meshes);
double reach_of(const PolygonMesh& mesh);
/// Polygons as fans.
std::vector<std::array<uint32_t, 3>> triangles_of(const PolygonMesh& mesh);
/// OFF with 17 digits: the doubles can be read back.
void write_off(const std::string& path, const std::vector<glm::dvec3>& points,
               const std::vector<std::array<uint32_t, 3>>& triangles);
/// The triangles of a file, as they are.
RawMesh read_raw(const std::string& path);
/// The mesh of a file, which must be a closed solid.
PolygonMesh read_solid(const std::string& path);

}  // namespace csgrun::bench

#include "tests/bench/exact_workloads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include <csgrun/export/write.h>

#include "engine/csg/quantise.h"
#include "tests/bench/shift.h"
#include "tests/support/exact_measures.h"
#include "tests/support/kernel_checks.h"

namespace csgrun::bench {
namespace {

void must_be_manifold(const Solid& solid, const std::string& what) {
  const std::string fault = test::fault_in(solid);
  if (!fault.empty()) fail(what + ": " + fault);
}

using Volume = std::array<uint64_t, 2>;  ///< six times a volume in steps^3, modulo two primes

Volume exact_volume(const BoundaryMesh& boundary) {
  return {test::six_volumes_residue(boundary, 0), test::six_volumes_residue(boundary, 1)};
}

Volume exact_volume(const Operand& operand) {
  if (operand.boundary) return exact_volume(*operand.boundary);
  return {test::six_volumes_residue(*operand.leaf, 0), test::six_volumes_residue(*operand.leaf, 1)};
}

Volume sum(const Volume& a, const Volume& b) {
  return {test::Residues(test::kPrimes[0]).add(a[0], b[0]),
          test::Residues(test::kPrimes[1]).add(a[1], b[1])};
}

/// What a check of written files said: verdicts, and the rounds of repair that it took.
class Verdicts {
 public:
  /// Encodes the solid as GLB, with a check; must not fail.
  void add(const std::string& name, const SolidPtr& solid, unsigned threads) {
    WriteOptions options;
    options.check = true;
    options.threads = threads;
    WriteReport report;
    take(encode_files(name + ".glb", {Part{name, solid, {}}}, options, report));
    for (const MeshCheck& check : report.checks) {
      if (check.verdict == CheckVerdict::kFailed) {
        fail(
            fmt::format("the check of {} failed: {} crossings, {} degenerate, {} flipped, {} "
                        "inverted are left; "
                        "{}",
                        name, check.left.crossings, check.left.degenerate, check.left.flipped,
                        check.left.inverted, check.problem));
      }
      (check.verdict == CheckVerdict::kClean ? clean_ : repaired_) += 1;
      crossings_ += check.found.crossings;
      flat_ += check.found.degenerate + check.found.flipped;
      rounds_ = std::max(rounds_, check.rounds);
    }
  }
  [[nodiscard]] std::string text() const {
    return fmt::format(
        R"(,"checks":{{"clean":{},"repaired":{},"crossings":{},"degenerate_or_flipped":{},)"
        R"("rounds":{}}})",
        clean_, repaired_, crossings_, flat_, rounds_);
  }

 private:
  int clean_ = 0, repaired_ = 0;
  uint64_t crossings_ = 0, flat_ = 0;
  unsigned rounds_ = 0;
};

/// The largest distance from a point of `from` to the nearest of `to`; `to` is sorted.
double one_sided_distance(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to) {
  double largest = 0;
  for (const glm::dvec3& p : from) {
    const auto at = std::lower_bound(to.begin(), to.end(), p.x,
                                     [](const glm::dvec3& q, double x) { return q.x < x; });
    double nearest = HUGE_VAL;
    const auto look = [&](const glm::dvec3& q) {
      if (std::abs(q.x - p.x) > nearest) return false;
      nearest = std::min(nearest, std::hypot(q.x - p.x, q.y - p.y, q.z - p.z));
      return nearest > 0;
    };
    for (auto right = at; right != to.end() && look(*right);) ++right;
    for (auto left = at; left != to.begin() && look(*std::prev(left));) --left;
    largest = std::max(largest, nearest);
  }
  return largest;
}

double hausdorff_distance(std::vector<glm::dvec3> a, std::vector<glm::dvec3> b) {
  if (a.empty() != b.empty()) return HUGE_VAL;
  const auto by_x = [](const glm::dvec3& p, const glm::dvec3& q) { return p.x < q.x; };
  std::sort(a.begin(), a.end(), by_x);
  std::sort(b.begin(), b.end(), by_x);
  return std::max(one_sided_distance(a, b), one_sided_distance(b, a));
}

/// The points that faces use.
std::vector<glm::dvec3> used_points(const PolygonMesh& mesh) {
  std::vector<bool> used(mesh.points.size());
  for (const uint32_t c : mesh.corners) used[c] = true;
  std::vector<glm::dvec3> points;
  for (size_t i = 0; i < used.size(); ++i) {
    if (used[i]) points.push_back(mesh.points[i]);
  }
  return points;
}

/// Whether every coordinate is the double nearest to a multiple of the step.
bool holds(const GridStep& step, const PolygonMesh& mesh) {
  if (!step_fits(step, reach_of(mesh), reach_of(mesh))) return false;
  const Quantiser quantise(step);
  return std::all_of(mesh.points.begin(), mesh.points.end(), [&](const glm::dvec3& p) {
    return to_millimetres({*quantise(p.x), *quantise(p.y), *quantise(p.z)}, step) == p;
  });
}

/// The mesh on a grid that holds it exactly: decimals if the file has so few of them, else it is
/// scaled and snapped.
GridStep exact_grid(PolygonMesh& mesh, bool& snapped) {
  snapped = false;
  for (const char* decimal :
       {"1", "0.1", "0.01", "0.001", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10"}) {
    const GridStep step = take(GridStep::parse(decimal));
    if (holds(step, mesh)) return step;
  }
  const GridStep step = shift_step();
  mesh = scaled_to_128(std::move(mesh));
  if (holds(step, mesh)) return step;
  snapped = true;
  const Quantiser quantise(step);
  for (glm::dvec3& p : mesh.points) {
    p = to_millimetres({*quantise(p.x), *quantise(p.y), *quantise(p.z)}, step);
  }
  return step;
}

}  // namespace

void run_ulp(const std::string& name, const Settings& settings, const std::string& path) {
  const PolygonMesh mesh = scaled_to_128(read_solid(path));
  if (!(reach_of(mesh) > 0)) fail("the mesh has no extent");
  Run run(name, settings, shift_step());
  const std::vector<IVec3> points = run.on_grid(mesh);
  std::vector<IVec3> shifted = points;
  int64_t least = INT64_MAX, most = 0;
  for (IVec3& p : shifted) {
    const int64_t shift = float_ulp_in_steps(p[0]);
    p[0] += shift;
    least = std::min(least, shift);
    most = std::max(most, shift);
    if (p[0] >= kGridLimit) fail("the shifted copy leaves the grid");
  }
  const std::vector<Operand> operands{run.import(mesh, points), run.import(mesh, shifted)};
  const auto difference = run.evaluate(operands, BooleanOp::kDifference);
  const SolidPtr solid = run.arrays(*difference);
  const double rss = run.rss_mb();
  // The proofs, off the clock.
  const Clock clock = run.clock;
  const EvaluateStats stats = run.stats();
  const auto common = run.evaluate(operands, BooleanOp::kIntersection);
  run.clock = clock;
  must_be_manifold(*solid, "A - B");
  if (sum(exact_volume(*difference), exact_volume(*common)) != exact_volume(operands[0])) {
    fail("vol(A - B) is not vol(A) - vol(A * B)");
  }
  run.print(
      *run.measured(*difference), rss, stats,
      fmt::format(R"(,"shift_steps":[{},{}],"manifold":true,"volume_exact":true)", least, most));
}

void run_round_trip(const std::string& name, const Settings& settings, const std::string& path) {
  PolygonMesh mesh = read_solid(path);
  bool snapped;
  const GridStep step = exact_grid(mesh, snapped);
  Run run(name, settings, step);
  run.options.literal_cells = true;
  const std::vector<Operand> operands{run.import(mesh), run.import(mesh)};
  const auto result = run.evaluate(operands, BooleanOp::kIntersection);
  const SolidPtr solid = run.arrays(*result);
  const double rss = run.rss_mb();
  must_be_manifold(*solid, "the result");
  const double distance = hausdorff_distance(used_points(mesh), solid->positions);
  if (distance != 0) fail(fmt::format("the Hausdorff distance is {}", distance));
  if (exact_volume(*result) != exact_volume(operands[0])) fail("the volume has changed");
  run.print(*run.measured(*result), rss, run.stats(),
            fmt::format(R"(,"grid_mm":{},"snapped":{},"hausdorff_mm":{})", step.millimetres(),
                        snapped, distance));
}

namespace {

std::array<PolygonMesh, 2> read_pair(const std::string& a, const std::string& b, uint64_t seed) {
  std::array<PolygonMesh, 2> meshes{read_solid(a), read_solid(b)};
  for (PolygonMesh& mesh : meshes) scale_to_box(mesh);
  rotate_at_random(meshes[1], seed);
  return meshes;
}

}  // namespace

void run_pair_operation(const std::string& name, const Settings& settings, const std::string& a,
                        const std::string& b, uint64_t seed, BooleanOp op) {
  const auto meshes = read_pair(a, b, seed);
  Run run(name, settings, std::max(reach_of(meshes[0]), reach_of(meshes[1])));
  run.options.name_untouched = true;  // the result is only presented
  const std::vector<Operand> operands{run.import(meshes[0]), run.import(meshes[1])};
  run.finish(*run.evaluate(operands, op));
}

void run_pair(const std::string& name, const Settings& settings, const std::string& a,
              const std::string& b, uint64_t seed) {
  const auto meshes = read_pair(a, b, seed);
  Run run(name, settings, std::max(reach_of(meshes[0]), reach_of(meshes[1])));
  const std::vector<Operand> operands{run.import(meshes[0]), run.import(meshes[1])};
  struct Operation {
    const char* name;
    BooleanOp op;
  };
  constexpr std::array<Operation, 4> kOperations{
      {{"union", BooleanOp::kUnion},
       {"intersection", BooleanOp::kIntersection},
       {"difference", BooleanOp::kDifference},
       {"symmetric_difference", BooleanOp::kSymmetricDifference}}};
  std::array<Volume, 4> volumes{};
  std::string extra;
  std::array<SolidPtr, 4> solids;
  std::shared_ptr<const BoundaryMesh> joined;
  for (size_t i = 0; i < kOperations.size(); ++i) {
    const auto boundary = run.evaluate(operands, kOperations[i].op);
    const SolidPtr solid = run.arrays(*boundary);
    must_be_manifold(*solid, kOperations[i].name);
    volumes[i] = exact_volume(*boundary);
    extra += fmt::format(R"(,"{}_tris":{})", kOperations[i].name, solid->triangles.size());
    solids[i] = solid;
    if (i == 0) joined = boundary;
  }
  const double rss = run.rss_mb();
  if (settings.check) {
    Verdicts verdicts;
    for (size_t i = 0; i < solids.size(); ++i) {
      if (!solids[i]->empty()) verdicts.add(kOperations[i].name, solids[i], settings.threads);
    }
    extra += verdicts.text();
  }
  const Volume va = exact_volume(operands[0]), vb = exact_volume(operands[1]);
  if (sum(volumes[0], volumes[1]) != sum(va, vb)) fail("vol(A + B) + vol(A * B) is wrong");
  if (sum(volumes[2], volumes[1]) != va) fail("vol(A - B) is wrong");
  if (sum(volumes[3], volumes[1]) != volumes[0]) fail("vol(A ~ B) is wrong");
  run.print(*run.measured(*joined), rss, run.stats(), extra + R"(,"identities_exact":true)");
}

}  // namespace csgrun::bench

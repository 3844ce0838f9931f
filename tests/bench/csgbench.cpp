// csgbench WORKLOAD ARGS [--threads N] [--repeat R] [options]: one JSON line for each run.
//
// `import` is raw arrays to kernel meshes, `op` the Boolean, `export` kernel mesh to indexed
// triangles in memory (without measuring them); cpu_s is the CPU time of all threads for the three.
// Volume and area are the exact ones of the result, computed outside the clock.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/heap.h>

#include "engine/base/parallel.h"
#include "engine/bsp/kernel.h"
#include "engine/mesh/pieces_measures.h"
#include "tests/bench/exact_workloads.h"
#include "tests/bench/hull_workloads.h"
#include "tests/bench/models.h"
#include "tests/bench/run.h"
#include "tests/bench/workloads.h"

namespace csgrun::bench {
namespace {

void run_nary(const std::string& name, const Settings& settings, const std::vector<RawMesh>& meshes,
              BooleanOp op, bool keep_facets) {
  Run run(name, settings, reach_of(meshes));
  run.options.name_untouched = true;  // the result is only presented
  run.finish(*run.evaluate(run.import(meshes, keep_facets), op));
}

/// What an operation looks at: the pieces in the tool's box, and the tool's faces.
size_t touched_faces(const ResultPieces& result, const Operand& tool) {
  if (!tool.leaf) return 0;
  PieceBox box;
  for (uint32_t v = 0; v < tool.leaf->vertices.size(); ++v) {
    std::array<double, 3> p{};
    for (size_t k = 0; k < 3; ++k) {
      p[k] = static_cast<double>(tool.leaf->vertices[v][k] + tool.translation[k]);
    }
    box.add(p);
  }
  size_t count = tool.leaf->face_count();
  result.tree.each([&](const PieceBox& node) { return node.meets(box); },
                   [&](uint32_t piece) {
                     result.store->each_face(piece, [&](std::span<const uint32_t> corners) {
                       PieceBox own;
                       for (const uint32_t p : corners) own.add(result.store->rounded(p));
                       count += own.meets(box);
                     });
                   });
  return count;
}

/// One operation after another; every result is a kernel mesh whose box and volume are asked.
void run_chain(const std::string& name, const Settings& settings,
               const std::vector<RawMesh>& meshes, BooleanOp op) {
  Run run(name, settings, reach_of(meshes));
  const std::vector<Operand> tools = run.import(meshes, false);
  const size_t steps = tools.size() - 1, tenth = std::min(steps, std::max<size_t>(1, steps / 10));
  double asked = 0;
  PiecesPtr result = run.clock.timed(
      run.clock.op, [&] { return run.evaluate_next(nullptr, {tools[0]}, BooleanOp::kUnion); });
  const auto make_steps = [&](size_t begin, size_t end) {
    return run.clock.timed(run.clock.op, [&] {
      for (size_t i = begin; i < end; ++i) {
        result = run.evaluate_next(result, {tools[i]}, op);
        asked += take(pieces_volume(*result, run.step())) + result->tree.box().hi[0];
      }
      return 0;
    });
  };
  // The first and the last tenth are timed one by one: what they touch is counted beside the clock.
  struct Tenth {
    double seconds = 0;
    size_t faces = 0;
  };
  const auto make_tenth = [&](size_t begin, size_t end) {
    Tenth made;
    const double before = run.clock.op;
    for (size_t i = begin; i < end; ++i) {
      made.faces += touched_faces(*result, tools[i]);
      make_steps(i, i + 1);
    }
    made.seconds = run.clock.op - before;
    return made;
  };
  const size_t last_begin = std::max(steps, 2 * tenth) - tenth + 1;
  const Tenth first = make_tenth(1, tenth + 1);
  make_steps(tenth + 1, last_begin);
  const Tenth last = make_tenth(last_begin, steps + 1);
  if (steps > 0 && !(asked > 0)) fail("a result of the chain has no volume");
  const auto boundary = run.clock.timed(run.clock.exporting, [&] {
    auto assembled = take(assemble_pieces(*result, true));
    result.reset();  // nothing goes on from it: what is presented takes its memory
    return assembled;
  });
  run.finish(*boundary, fmt::format(R"(,"first_tenth_s":{:.6f},"last_tenth_s":{:.6f})"
                                    R"(,"first_tenth_faces":{},"last_tenth_faces":{})",
                                    first.seconds, last.seconds, first.faces, last.faces));
}

/// The turn as a transform, that is, by a frame: through the evaluator.
void run_rotframe(const std::string& name, const Settings& settings, const RawMesh& raw,
                  double degrees) {
  Run run(name, settings, reach_of({raw}));
  run.count_input(2 * raw.triangle_count());
  const double before = resident_mb();
  double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < raw.points.size(); i += 3) {
    for (int k = 0; k < 2; ++k) {
      lo[k] = std::min(lo[k], raw.points[i + k]), hi[k] = std::max(hi[k], raw.points[i + k]);
    }
  }
  const auto mesh = std::make_shared<PolygonMesh>(polygon_mesh(raw, true));
  const double cx = (lo[0] + hi[0]) / 2, cy = (lo[1] + hi[1]) / 2;
  const double s = std::sin(degrees * M_PI / 180), c = std::cos(degrees * M_PI / 180);
  Affine turn;
  turn.m = {{{c, -s, 0, cx - c * cx + s * cy}, {s, c, 0, cy - s * cx - c * cy}, {0, 0, 1, 0}}};
  EvaluateOptions options;
  options.threads = settings.threads;
  options.cell_limit = settings.cell_limit;
  Evaluator evaluator(options);
  const double wall = wall_seconds(), cpu = cpu_seconds();
  const NodePtr leaf = Node::leaf(mesh);
  const NodePtr both = Node::boolean(BooleanOp::kUnion, {leaf, Node::transformed(turn, leaf)});
  const SolidPtr solid = take(evaluator.evaluate(both, Measuring::kNothing));  // as the others
  run.clock.cpu = cpu_seconds() - cpu;
  run.clock.import = evaluator.stats().leaf_seconds;
  run.clock.op = evaluator.stats().boolean_seconds;
  run.clock.exporting = wall_seconds() - wall - run.clock.import - run.clock.op;
  const double rss = peak_mb() - before;
  const SolidPtr measured = take(Evaluator(options).evaluate(both));
  if (measured->triangles != solid->triangles) fail("measuring changes the result");
  run.print(*measured, rss, evaluator.stats(), "");
}

/// Two boxes, many times: what one small operation costs.
void run_boxes(const std::string& name, const Settings& settings) {
  constexpr int kTimes = 2000;
  const std::vector<RawMesh> meshes{box(0, 0, 0, 2, 2, 2), box(1, 1, 1, 3, 3, 3)};
  Run run(name, settings, reach_of(meshes));
  std::shared_ptr<const BoundaryMesh> boundary;
  const std::vector<Operand> operands{run.import(meshes[0], false), run.import(meshes[1], false)};
  for (int i = 0; i < kTimes; ++i) boundary = run.evaluate(operands, BooleanOp::kUnion);
  run.finish(*boundary, fmt::format(R"(,"times":{},"op_us_each":{:.3f})", kTimes,
                                    run.clock.op / kTimes * 1e6));
}

BooleanOp operation(const std::string& word) {
  if (word == "union") return BooleanOp::kUnion;
  if (word == "intersection") return BooleanOp::kIntersection;
  if (word == "difference") return BooleanOp::kDifference;
  fail(fmt::format("'{}' is no operation: union, intersection or difference", word));
}

std::vector<RawMesh> joined(RawMesh first, std::vector<RawMesh> rest) {
  rest.insert(rest.begin(), std::move(first));
  return rest;
}

/// What is one operation over operands that a number makes.
struct OneOperation {
  const char* workload;
  std::vector<RawMesh> (*make)(int);
  BooleanOp op;
};
constexpr OneOperation kOneOperation[] = {
    {"batch", [](int n) { return joined(block(), drill_spheres(n)); }, BooleanOp::kDifference},
    {"menger", [](int k) { return joined(menger_cube(k), menger_bars(k)); },
     BooleanOp::kDifference},
    {"grid", cylinder_grid, BooleanOp::kUnion},
    {"shells", shells, BooleanOp::kUnion},
    {"common", shells, BooleanOp::kIntersection},
    {"rods", rods, BooleanOp::kUnion},
    {"plates", plates, BooleanOp::kUnion},
};

constexpr const char* kUsage =
    "usage: csgbench WORKLOAD ARGS [--threads N] [--repeat R] [--cell-limit M] [--write OUT.off]\n"
    "                [--check] [--write-inputs PREFIX] [--write-steps PREFIX] [--write-cells OUT]\n"
    "                [--pages small|large]\n"
    "  rot FILE ANGLE       union with a copy turned about z (vertices turned)\n"
    "  rotframe FILE ANGLE  the same turn as a transform\n"
    "  chain N              block minus N spheres, one after another\n"
    "  batch N              the same as one operation\n"
    "  menger K             a Menger sponge of level K\n"
    "  grid N               union of N x N cylinders\n"
    "  cubegrid N           N^3 touching unit cubes, one after another\n"
    "  dome N               a sphere minus N small ones on it, one after another\n"
    "  shells N             union of N spheres about one centre, each turned\n"
    "  common N             what these have in common\n"
    "  rods N               union of N long rods that go through one another\n"
    "  plates N             union of N plates that overlap in one plane\n"
    "  boxes                two boxes, repeated\n"
    "  ulp FILE             less a copy shifted by one float32 unit in the last place\n"
    "  roundtrip FILE       through planes and BSPs, and back to the same vertices\n"
    "  pair A B SEED        all four operations of two files, B turned at random; --check proves\n"
    "                       the results as GLB free of self-intersections\n"
    "  pair A B SEED OP     only one: union, intersection or difference\n"
    "  hull FILE            the outer hull of a surface that crosses itself\n"
    "  front FILE STEPS     a surface moves along its normals, and splits and merges\n"
    "  model NAME FACES OUT.off\n"
    "                       writes a model: statue, sieve, twins, ring, contortionist\n";

void write_model(const std::string& name, const std::string& faces, const std::string& path) {
  const PolygonMesh mesh =
      polygon_mesh(model(name, std::strtoull(faces.c_str(), nullptr, 10)), true);
  if (mesh.face_count() == 0) fail("there is no model '" + name + "'");
  write_off(path, mesh.points, triangles_of(mesh));
}

void run_once(const std::vector<std::string>& words, const Settings& settings) {
  const std::string& workload = words[0];
  const std::string name = name_of(words);
  const auto number = [&](size_t i) { return std::atoi(words[i].c_str()); };
  const auto* const one = std::find_if(std::begin(kOneOperation), std::end(kOneOperation),
                                       [&](const auto& o) { return workload == o.workload; });
  if (one != std::end(kOneOperation) && words.size() == 2) {
    run_nary(name, settings, one->make(number(1)), one->op, false);
  } else if (workload == "rot" && words.size() == 3) {
    const RawMesh raw = read_raw(words[1]);
    run_nary(name, settings, {raw, rotated_z(raw, std::atof(words[2].c_str()))}, BooleanOp::kUnion,
             true);
  } else if (workload == "rotframe" && words.size() == 3) {
    run_rotframe(name, settings, read_raw(words[1]), std::atof(words[2].c_str()));
  } else if (workload == "chain" && words.size() == 2) {
    run_chain(name, settings, joined(block(), drill_spheres(number(1))), BooleanOp::kDifference);
  } else if (workload == "cubegrid" && words.size() == 2) {
    run_chain(name, settings, cube_grid(number(1)), BooleanOp::kUnion);
  } else if (workload == "dome" && words.size() == 2) {
    run_chain(name, settings, joined(dome(), dome_spheres(number(1))), BooleanOp::kDifference);
  } else if (workload == "boxes" && words.size() == 1) {
    run_boxes(name, settings);
  } else if (workload == "ulp" && words.size() == 2) {
    run_ulp(name, settings, words[1]);
  } else if (workload == "roundtrip" && words.size() == 2) {
    run_round_trip(name, settings, words[1]);
  } else if (workload == "pair" && words.size() == 4) {
    run_pair(name, settings, words[1], words[2], std::strtoull(words[3].c_str(), nullptr, 10));
  } else if (workload == "pair" && words.size() == 5) {
    run_pair_operation(name, settings, words[1], words[2],
                       std::strtoull(words[3].c_str(), nullptr, 10), operation(words[4]));
  } else if (workload == "hull" && words.size() == 2) {
    run_hull(name, settings, words[1]);
  } else if (workload == "front" && words.size() == 3) {
    run_front(name, settings, words[1], number(2));
  } else if (workload == "model" && words.size() == 4) {
    write_model(words[1], words[2], words[3]);
  } else {
    std::fprintf(stderr, "%s", kUsage);
    std::exit(2);
  }
}

}  // namespace
}  // namespace csgrun::bench

int main(int argc, char** argv) {
  csgrun::keep_freed_memory();
  csgrun::bench::Settings settings;
  csgrun::HeapPages pages = csgrun::HeapPages::kMeasured;
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool has_value = i + 1 < argc;
    if (word == "--threads" && has_value) {
      settings.threads = static_cast<unsigned>(std::atoi(argv[++i]));
    } else if (word == "--repeat" && has_value) {
      settings.repeat = std::atoi(argv[++i]);
    } else if (word == "--check") {
      settings.check = true;
    } else if (word == "--write" && has_value) {
      settings.write = argv[++i];
    } else if (word == "--write-steps" && has_value) {
      settings.write_steps = argv[++i];
    } else if (word == "--write-inputs" && has_value) {
      settings.write_inputs = argv[++i];
    } else if (word == "--write-cells" && has_value) {
      settings.write_cells = argv[++i];
    } else if (word == "--cell-limit" && has_value) {
      settings.cell_limit = static_cast<uint32_t>(std::atoi(argv[++i]));
    } else if (word == "--pages" && has_value) {
      const std::string size = argv[++i];
      if (size != "small" && size != "large") csgrun::bench::fail("--pages are small or large");
      pages = size == "small" ? csgrun::HeapPages::kSmall : csgrun::HeapPages::kLarge;
    } else {
      words.push_back(word);
    }
  }
  if (words.empty() || settings.threads == 0 || settings.cell_limit == 0) {
    std::fprintf(stderr, "%s", csgrun::bench::kUsage);
    return 2;
  }
  csgrun::make_room_for_meshes(pages);
  for (int r = 0; r < settings.repeat; ++r) {
    csgrun::with_threads(settings.threads, [&] { csgrun::bench::run_once(words, settings); });
  }
  return 0;
}

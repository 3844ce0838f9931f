#include "export/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include <glm/geometric.hpp>

#include "export/edge_flips.h"
#include "export/self_union.h"
#include "export/small_steps.h"
#include "export/thin_triangles.h"

namespace csgrun {
namespace {

/// A lattice of cubes; its origin is half a step away from the coordinates' along some axes.
struct Lattice {
  double step;
  std::array<double, 3> origin;

  /// The point that all in a cell are snapped to.
  [[nodiscard]] glm::dvec3 snapped(const glm::dvec3& p) const {
    glm::dvec3 result;
    for (int k = 0; k < 3; ++k) {
      const double o = origin[static_cast<size_t>(k)];
      result[k] = std::nearbyint((p[k] - o) / step) * step + o + 0.0;
    }
    return result;
  }
};

/// Whether what is wrong goes away is as good as chance: all lattices are tried from one origin
/// after another.
constexpr std::array<std::array<double, 3>, 4> kOrigins{
    {{0, 0, 0}, {0.5, 0.5, 0.5}, {0.5, 0, 0}, {0, 0.5, 0.5}}};

/// Widths of what is thin, in units in the last place of the file's numbers: each is twice the one
/// before. With a lattice they go on to 2^kBeyondLattice of its steps, or the coarsest one's step.
constexpr double kFirstWidth = 2, kLastWidth = 16;
constexpr int kBeyondLattice = 4;

/// Where more is wrong, passes over the whole mesh go before steps one by one: many of these take
/// longer.
constexpr size_t kFewWrong = 10000;

bool precedes(const glm::dvec3& a, const glm::dvec3& b) {
  return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
}

std::vector<uint32_t> bad_triangles(const Defects& defects) {
  std::vector<uint32_t> bad;
  std::merge(defects.degenerate.begin(), defects.degenerate.end(), defects.flipped.begin(),
             defects.flipped.end(), std::back_inserter(bad));
  return bad;
}

class Repair {
 public:
  Repair(RoundedMesh& mesh, std::vector<glm::dvec3> directions, Precision precision,
         const Fidelity& fidelity, const WriteOptions& options, Defects& left, MeshCheck& check)
      : mesh_(mesh),
        faces_{std::move(directions), {}},
        precision_(precision),
        fidelity_(fidelity),
        options_(options),
        left_(left),
        check_(check),
        moves_(fidelity.rounding()) {
    faces_.original.resize(faces_.directions.size());
    std::iota(faces_.original.begin(), faces_.original.end(), 0);
  }

  Status run() {
    best_ = state();
    while (check_.rounds < kMostRounds && !left_.none() && check_.problem.empty()) {
      if (all_lattices_tried()) break;
      ++check_.rounds;
      if (options_.repairing) options_.repairing(check_.rounds, left_.count());
      if (Status status = run_round(); !status) return status;
      if (note_best()) continue;
      // Rounds that make it worse are undone: what they moved would be in the way of the next.
      ++lattice_;
      restore(best_);
    }
    mesh_.triangle_face = original_faces();
    check_.distance = moves_.distance;
    if (!left_.none() && check_.problem.empty()) check_.problem = breach_;
    return std::monostate{};
  }

 private:
  struct State {
    RoundedMesh mesh;
    MeshFaces faces;
    Defects left;
    uint64_t moved;
    Moves moves;
  };

  [[nodiscard]] State state() const { return {mesh_, faces_, left_, check_.moved, moves_}; }
  void restore(const State& before) {
    mesh_ = before.mesh;
    faces_ = before.faces;
    left_ = before.left;
    check_.moved = before.moved;
    moves_ = before.moves;
  }

  /// Whether less is wrong than ever before.
  bool note_best() {
    breach_ = fidelity_.breach(mesh_, original_faces(), moves_);
    if (!breach_.empty() || !left_.fewer_than(best_.left)) return false;
    best_ = state();
    return true;
  }

  /// Before the mesh is changed.
  void note_clean() {
    const bool are_all_known = left_.crossings.size() < kMostCrossings;
    clean_ = are_all_known ? CleanTriangles(mesh_, left_.crossings) : CleanTriangles();
  }

  /// Takes the next origin where all lattices were tried from one; true when all were from all.
  bool all_lattices_tried() {
    if (lattice_ > 0 && lattice_exponent() > coarsest_exponent()) {
      lattice_ = 1;
      ++origin_;
    }
    return origin_ == kOrigins.size();
  }

  Status run_round() {
    note_clean();
    if (Status status = mend(); !status) return status;
    if (left_.none()) return std::monostate{};
    note_best();
    if (lattice_ > 0) {
      if (Status status = snap(); !status) return status;
      examine();
      if (Status status = mend(); !status) return status;
      if (left_.none()) return std::monostate{};
    }
    ++check_.unions;
    if (const Status status = unite_with_itself(mesh_, faces_, precision_, options_, moves_);
        !status) {
      const ErrorCode code = status.error().code;
      if (code == ErrorCode::kCancelled || code == ErrorCode::kLimit ||
          code == ErrorCode::kInternal)
        return status.error();
      check_.problem = status.error().message;
    }
    examine();
    return mend();
  }

  /// Of the solid, per triangle.
  [[nodiscard]] std::vector<uint32_t> original_faces() const {
    std::vector<uint32_t> original;
    for (const uint32_t face : mesh_.triangle_face) original.push_back(faces_.original[face]);
    return original;
  }

  void examine() {
    left_ = find_defects(mesh_, faces_.directions, clean_, options_.threads);
    note_clean();
  }

  void turn_edges() {
    // Each turn takes one bad triangle away and makes no other.
    bool any = false;
    for (std::vector<uint32_t> bad = bad_triangles(left_);
         !bad.empty() && turn_longest_edges(mesh_, bad, faces_.directions) > 0;
         bad = bad_triangles(find_bad_triangles(mesh_, faces_.directions))) {
      any = true;
    }
    if (!any) return;
    for (auto& outline : mesh_.outlines) outline.clear();
    examine();
  }

  /// What can be done near what is wrong alone, without a union, as long as that leaves less wrong.
  Status mend() {
    turn_edges();
    const double unit = unit_of(precision_, mesh_.positions), last = widest();
    if (left_.count() <= kFewWrong) {
      if (Status status = take_steps(kFirstWidth * unit, last); !status) return status;
    }
    const size_t not_mended = left_.count();
    for (double width = kFirstWidth * unit; width <= last && !left_.none();) {
      if (options_.cancel && options_.cancel->load(std::memory_order_relaxed)) {
        return Error{ErrorCode::kCancelled, "cancelled", {}};
      }
      const State before = state();
      const auto thinned = take_out_thin(mesh_, offenders(), width, faces_.directions);
      if (!thinned) return thinned.error();
      const bool any = thinned->turned + thinned->merged > 0;
      if (any) {
        moves_.add(mesh_.positions, mesh_.triangles, thinned->farthest);
        check_.moved += thinned->merged;
        examine();
        turn_edges();
      }
      if (left_.fewer_than(before.left)) continue;
      if (any) restore(before);
      width *= 2;
    }
    if (not_mended <= kFewWrong && left_.count() == not_mended) return std::monostate{};
    return take_steps(kFirstWidth * unit, last);
  }

  /// The same, with each step judged by what is near it.
  Status take_steps(double first, double last) {
    if (left_.none() || left_.crossings.size() >= kMostCrossings) return std::monostate{};
    const State before = state();
    const auto steps =
        take_small_steps(mesh_, offenders(), first, last, faces_.directions, options_.cancel);
    if (!steps) return steps.error();
    if (steps->turned + steps->merged == 0) return std::monostate{};
    moves_.add(mesh_.positions, mesh_.triangles, steps->farthest);
    check_.moved += steps->merged;
    examine();
    if (!left_.fewer_than(before.left)) restore(before);
    return std::monostate{};
  }

  /// What is thin now, mm.
  [[nodiscard]] double widest() const {
    if (lattice_ == 0) return kLastWidth * unit_of(precision_, mesh_.positions);
    return std::ldexp(1.0, std::min(lattice_exponent() + kBeyondLattice, coarsest_exponent()));
  }

  /// Steps of two floats (where the mesh is farthest from the origin), then eight, 32 and so on:
  /// what is snapped must get clear of what is rounded.
  [[nodiscard]] int lattice_exponent() const {
    const int finest = lattice_of(mesh_.positions).exponent;
    // A float's step is eight steps of the engine's lattice; doubles approach that from below.
    return precision_ == Precision::kFloat ? finest + 2 + 2 * lattice_ : finest - 25 + 5 * lattice_;
  }
  [[nodiscard]] int coarsest_exponent() const {
    return lattice_of(mesh_.positions).exponent +
           (precision_ == Precision::kFloat ? kCoarsestFloatLattice : kCoarsestDoubleLattice);
  }

  /// The triangles of which something is wrong.
  [[nodiscard]] std::vector<uint32_t> offenders() const {
    std::vector<uint32_t> wrong = bad_triangles(left_);
    for (const TriangleCrossing& crossing : left_.crossings) {
      wrong.insert(wrong.end(), crossing.triangles.begin(), crossing.triangles.end());
    }
    wrong.insert(wrong.end(), left_.inverted.begin(), left_.inverted.end());
    std::sort(wrong.begin(), wrong.end());
    wrong.erase(std::unique(wrong.begin(), wrong.end()), wrong.end());
    return wrong;
  }

  [[nodiscard]] double lattice_step() const { return std::ldexp(1.0, lattice_exponent()); }

  Status snap() {
    Lattice lattice{lattice_step(), kOrigins[origin_]};
    for (double& o : lattice.origin) o *= lattice.step;
    std::vector<bool> offends(mesh_.positions.size(), false);
    for (const uint32_t t : offenders()) {
      for (const uint32_t v : mesh_.triangles[t]) offends[v] = true;
    }
    std::vector<glm::dvec3> cells;
    for (size_t v = 0; v < offends.size(); ++v) {
      if (offends[v]) cells.push_back(lattice.snapped(mesh_.positions[v]));
    }
    std::sort(cells.begin(), cells.end(), precedes);
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    std::vector<glm::dvec3> positions = mesh_.positions;
    double farthest = 0;
    for (glm::dvec3& p : positions) {
      const glm::dvec3 cell = lattice.snapped(p);
      if (cell == p || !std::binary_search(cells.begin(), cells.end(), cell, precedes)) continue;
      farthest = std::max(farthest, glm::distance(p, cell));
      p = cell;
      ++check_.moved;
    }
    moves_.add(mesh_.positions, mesh_.triangles, farthest);
    return move_vertices(mesh_, std::move(positions));
  }

  RoundedMesh& mesh_;
  MeshFaces faces_;
  Precision precision_;
  const Fidelity& fidelity_;
  const WriteOptions& options_;
  Defects& left_;
  MeshCheck& check_;
  Moves moves_;
  State best_;            ///< what undone rounds go back to
  CleanTriangles clean_;  ///< of the mesh that was looked at last
  std::string breach_;    ///< why the last round was undone, if the mesh became another
  int lattice_ = 0;       ///< the number of the lattice; 0: nothing is snapped yet
  size_t origin_ = 0;     ///< into kOrigins
};

}  // namespace

Status repair(RoundedMesh& mesh, std::vector<glm::dvec3> directions, Precision precision,
              const Fidelity& fidelity, const WriteOptions& options, Defects& left,
              MeshCheck& check) {
  return Repair(mesh, std::move(directions), precision, fidelity, options, left, check).run();
}

}  // namespace csgrun

#include "engine/bsp/evaluate_boxes.h"

#include <algorithm>
#include <bit>

#include "engine/bsp/lattice_surface.h"
#include "engine/bsp/pruned_expression.h"

namespace csgrun {
namespace {

/// Squares of three cells along each axis are told from four: a window's cells are the bits of a
/// word, 1, 4 and 16 apart along x, y and z, and the last ones along each axis belong to the next.
constexpr uint32_t kOwn = 3;
constexpr std::array<int, 3> kShift{1, 4, 16};

/// The cells whose place along an axis is among the four bits of `places`.
consteval uint64_t cells_at(int axis, uint32_t places) {
  uint64_t word = 0;
  for (uint32_t cell = 0; cell < 64; ++cell) {
    const uint32_t at = axis == 0 ? cell % 4 : axis == 1 ? cell / 4 % 4 : cell / 16;
    if (places >> at & 1) word |= uint64_t{1} << cell;
  }
  return word;
}

consteval auto all_cells_at() {
  std::array<std::array<uint64_t, 16>, 3> words{};
  for (int axis = 0; axis < 3; ++axis) {
    for (uint32_t places = 0; places < 16; ++places) words[axis][places] = cells_at(axis, places);
  }
  return words;
}
constexpr auto kCellsAt = all_cells_at();
constexpr uint64_t kOwnCells = kCellsAt[0][7] & kCellsAt[1][7] & kCellsAt[2][7];

/// Whether the surface around an edge or a corner within a window is in more than one piece.
bool touches_itself(uint64_t inside) {
  for (int k = 0; k < 3; ++k) {
    const int s = kShift[k], t = kShift[(k + 1) % 3];
    const uint64_t a = inside, b = inside >> s, c = inside >> t, d = inside >> (s + t);
    if (kOwnCells & ~(a ^ d) & ~(b ^ c) & (a ^ b)) return true;
  }
  // Two cells in opposite corners, and six of the other kind.
  std::array<uint64_t, 8> corner;
  for (int c = 0; c < 8; ++c) corner[c] = inside >> ((c & 1) + 4 * (c >> 1 & 1) + 16 * (c >> 2));
  for (int c = 0; c < 4; ++c) {
    uint64_t others_all = ~uint64_t{0}, others_any = 0;
    for (int o = 0; o < 8; ++o) {
      if (o == c || o == 7 - c) continue;
      others_all &= corner[o];
      others_any |= corner[o];
    }
    const uint64_t both = corner[c] & corner[7 - c], none = ~(corner[c] | corner[7 - c]);
    if (kOwnCells & ((both & ~others_any) | (none & others_all))) return true;
  }
  return false;
}

class BoxEvaluator {
 public:
  BoxEvaluator(const BoxLattice& lattice, const KernelOptions& options, EvaluateStats& stats)
      : lattice_(lattice), cancel_(options.cancel), stats_(stats), surface_(lattice) {
    constant_.assign(lattice.boxes.size(), Inside::kUnknown);
    mentioned_.assign(lattice.boxes.size(), 0);
  }

  Result<std::shared_ptr<BoundaryMesh>> run(const Expression& expression) {
    Block all;
    for (int k = 0; k < 3; ++k) all.hi[k] = (lattice_.plane_count(k) + kOwn - 1) / kOwn;
    for (uint32_t o = 0; o < lattice_.boxes.size(); ++o) present_.push_back(o);
    visit(all, 0, PrunedExpression(expression));
    if (is_cancelled()) return Error{ErrorCode::kCancelled, "the evaluation was cancelled", {}};
    auto mesh = std::make_shared<BoundaryMesh>(surface_.boundary());
    mesh->may_touch = !touches_.empty();
    mesh->touches = std::move(touches_);
    return mesh;
  }

 private:
  /// Windows lo up to hi, along each axis.
  struct Block {
    std::array<uint32_t, 3> lo{0, 0, 0}, hi{0, 0, 0};
  };

  [[nodiscard]] bool is_cancelled() const {
    return cancel_ && cancel_->load(std::memory_order_relaxed);
  }

  /// What a box is in all cells of a block, if it is one thing.
  [[nodiscard]] Inside value_in(const BoxLattice::Box& box, const Block& block) const {
    bool all = true;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t first = kOwn * block.lo[k], last = kOwn * block.hi[k];
      if (box.hi[k] < first || box.lo[k] >= last) return Inside::kNo;
      all &= box.lo[k] < first && last <= box.hi[k];
    }
    return all ? Inside::kYes : Inside::kUnknown;
  }

  /// Handles a block in which the boxes present_[first..] have surface.
  void visit(const Block& block, size_t first, const PrunedExpression& expression) {
    ++stats_.cells;
    using Form = PrunedExpression::Form;
    if (expression.form() == Form::kEmpty || expression.form() == Form::kFull) return;
    if (is_cancelled()) return;
    size_t axis = 0;
    for (size_t k = 1; k < 3; ++k) {
      if (block.hi[k] - block.lo[k] > block.hi[axis] - block.lo[axis]) axis = k;
    }
    const uint32_t size = block.hi[axis] - block.lo[axis];
    if (size == 1) return solve(block.lo, present_.size() - first, expression);
    const size_t end = present_.size();
    for (const bool upper : {false, true}) {
      Block half = block;
      (upper ? half.lo : half.hi)[axis] = block.lo[axis] + size / 2;
      for (size_t i = first; i < end; ++i) {
        const uint32_t o = present_[i];
        const Inside value = value_in(lattice_.boxes[o], half);
        constant_[o] = value;
        if (value == Inside::kUnknown) present_.push_back(o);
      }
      enter(half, first, end, expression);
      present_.resize(end);
    }
  }

  /// Folds the expression with the constants of the boxes present_[first, end) before the visit.
  void enter(const Block& block, size_t first, size_t end, const PrunedExpression& outer) {
    if (present_.size() - end == end - first) return visit(block, end, outer);
    const PrunedExpression folded = outer.fold([this](uint32_t o) { return constant_[o]; });
    folded.each_operand([this](uint32_t o) { mentioned_[o] = 1; });
    size_t kept = end;
    for (size_t i = end; i < present_.size(); ++i) {
      const uint32_t o = present_[i];
      if (mentioned_[o]) present_[kept++] = o;
      mentioned_[o] = 0;
    }
    present_.resize(kept);
    visit(block, end, folded);
  }

  /// The cells of a box in a window whose first cell is given.
  [[nodiscard]] static uint64_t cells_of(const BoxLattice::Box& box,
                                         const std::array<uint32_t, 3>& start) {
    uint64_t word = ~uint64_t{0};
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t from = std::max(box.lo[k] + 1, start[k]) - start[k];
      const uint32_t to = std::min(box.hi[k] + 1 - start[k], kOwn + 1);
      word &= kCellsAt[k][(1u << to) - (1u << from)];
    }
    return word;
  }

  void solve(const std::array<uint32_t, 3>& window, size_t boxes,
             const PrunedExpression& expression) {
    ++stats_.surface_cells;
    if (boxes > 1) ++stats_.solved_cells, ++stats_.critical_cells;
    std::array<uint32_t, 3> start;
    for (size_t k = 0; k < 3; ++k) start[k] = kOwn * window[k];
    expression.evaluate_words([&](uint32_t o) { return cells_of(lattice_.boxes[o], start); },
                              words_);
    const uint64_t inside = words_.back();
    for (size_t axis = 0; axis < 3; ++axis) {
      expression.split_boundary(words_, kShift[axis], kOwnCells, scratch_,
                                [&](uint32_t o, uint64_t squares) {
                                  add_squares(axis, start, lattice_.boxes[o], inside, squares);
                                });
    }
    if (touches_itself(inside)) add_touching(start);
  }

  /// The squares above cells of a window that belong to a box.
  void add_squares(size_t axis, const std::array<uint32_t, 3>& start, const BoxLattice::Box& box,
                   uint64_t inside, uint64_t squares) {
    for (; squares != 0; squares &= squares - 1) {
      const auto bit = static_cast<uint32_t>(std::countr_zero(squares));
      const std::array<uint32_t, 3> cell{start[0] + bit % 4, start[1] + bit / 4 % 4,
                                         start[2] + bit / 16};
      // The box is on one side of the square only.
      const bool is_upper_side = cell[axis] == box.hi[axis];
      surface_.add(static_cast<int>(axis), cell, box.label[axis][is_upper_side], inside >> bit & 1);
    }
  }

  void add_touching(const std::array<uint32_t, 3>& start) {
    GridBox& box = touches_.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      const std::vector<int64_t>& planes = lattice_.planes[k];
      box.lo[k] = planes[std::max(start[k], 1u) - 1];
      box.hi[k] = planes[std::min<size_t>(start[k] + kOwn, planes.size()) - 1];
    }
  }

  const BoxLattice& lattice_;
  const std::atomic<bool>* cancel_;
  EvaluateStats& stats_;
  LatticeSurface surface_;
  std::vector<uint32_t> present_;  ///< a stack: boxes with surface in the blocks on the way down
  std::vector<Inside> constant_;   ///< per box, in the block at hand
  std::vector<uint8_t> mentioned_;
  std::vector<uint64_t> words_, scratch_;
  std::vector<GridBox> touches_;
};

}  // namespace

std::optional<Result<std::shared_ptr<BoundaryMesh>>> evaluate_boxes(
    const std::vector<Operand>& operands, const Expression& expression,
    const KernelOptions& options, EvaluateStats& stats) {
  const bool has_symmetric = std::any_of(
      expression.nodes.begin(), expression.nodes.end(),
      [](const Expression::Node& n) { return n.op == BooleanOp::kSymmetricDifference; });
  if (has_symmetric || expression.nodes.empty()) return std::nullopt;
  const auto lattice = make_lattice(operands);
  if (!lattice) return std::nullopt;
  return BoxEvaluator(*lattice, options, stats).run(expression);
}

}  // namespace csgrun

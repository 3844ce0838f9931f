#include "engine/bsp/cell_solver.h"

namespace csgrun {

CellSolver::CellSolver(const Job& job) : job_(job), geometry_(job.planes(), &job) {
  slot_of_operand_.assign(job.operand_count(), kNone);
}

void CellSolver::copy(uint32_t polygon, const CellBox& box, const CellWalls& walls, bool flip,
                      FragmentSet& out) {
  geometry_.clear();
  numbers_.clear();
  Fragment f = geometry_.load(polygon);
  if (clip_to_cell(geometry_, job_, box, walls, f)) out.add(geometry_, f, flip, numbers_);
}

void CellSolver::solve(const Octree& tree, const CriticalCell& cell, const CellWalls& walls,
                       FragmentSet& out) {
  geometry_.clear();
  numbers_.clear();
  operand_count_ = cell.presence_count;
  if (operands_.size() < operand_count_) operands_.resize(operand_count_);
  for (uint32_t i = 0; i < operand_count_; ++i) {
    const CriticalCell::Presence& presence = tree.presences[cell.first_presence + i];
    Operand& operand = operands_[i];
    operand.id = presence.operand;
    operand.polygons.clear();
    for (uint32_t k = 0; k < presence.count; ++k) {
      Fragment f = geometry_.load(tree.cell_polygons[presence.first_polygon + k]);
      if (clip_to_cell(geometry_, job_, cell.box, walls, f)) operand.polygons.push_back(f);
    }
    operand.bsp.build(geometry_, operand.polygons, presence.corner_inside);
    slot_of_operand_[presence.operand] = i;
  }
  contact_ = false;
  geometry_.met_plane = false;
  for (uint32_t i = 0; i < operand_count_; ++i) {
    for (const Fragment& f : operands_[i].polygons) {
      if (tree.is_wanted(f.polygon)) solve_polygon(cell.expression, i, f, out);
    }
  }
  cells_with_contact_ += contact_;
  may_touch_ = geometry_.met_plane;
}

void CellSolver::solve_polygon(const PrunedExpression& expression, uint32_t own, const Fragment& f,
                               FragmentSet& out) {
  Labelled start{f, std::vector<Inside>(operand_count_, Inside::kUnknown),
                 std::vector<Inside>(operand_count_, Inside::kUnknown)};
  start.front[own] = Inside::kNo;
  start.back[own] = Inside::kYes;
  current_.clear();
  current_.push_back(std::move(start));
  const auto value = [&](const std::vector<Inside>& labels) {
    return expression.evaluate([&](uint32_t o) { return labels[slot_of_operand_[o]]; }, scratch_);
  };
  for (uint32_t other = 0; other < operand_count_ && !current_.empty(); ++other) {
    if (other == own) continue;
    next_.clear();
    for (Labelled& l : current_) {
      pieces_.clear();
      operands_[other].bsp.classify(geometry_, l.fragment, pieces_);
      contact_ |= pieces_.size() > 1 || pieces_[0].front_inside != pieces_[0].back_inside;
      for (const LocalBsp::Piece& p : pieces_) {
        Labelled r{p.fragment, l.front, l.back};
        r.front[other] = p.front_inside ? Inside::kYes : Inside::kNo;
        r.back[other] = p.back_inside ? Inside::kYes : Inside::kNo;
        const Inside front = value(r.front);
        if (front != Inside::kUnknown && front == value(r.back)) continue;  // never boundary
        next_.push_back(std::move(r));
      }
    }
    std::swap(current_, next_);
  }
  for (const Labelled& l : current_) {
    const auto is_inside = [&](const std::vector<Inside>& labels) {
      return [&](uint32_t o) { return labels[slot_of_operand_[o]] == Inside::kYes; };
    };
    const auto b = expression.boundary(is_inside(l.front), is_inside(l.back), boundary_scratch_);
    // Where several operands have surface here, the lowest that counts gives the piece, once.
    if (b.operand != operands_[own].id) continue;
    out.add(geometry_, l.fragment, b.front, numbers_);
  }
}

}  // namespace csgrun

#include "engine/bsp/patch_labels.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/ray_label.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {

namespace {

std::vector<SquareBins::Box> boxes_of_operands(const Job& job) {
  std::vector<SquareBins::Box> boxes;
  for (uint32_t o = 0; o < job.operand_count(); ++o) {
    const PolygonBox& box = job.operand_box(o);
    // A step more: a point is not known to the last bit.
    SquareBins::Box& wide = boxes.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      wide.lo[k] = static_cast<double>(box.lo[k]) - 1;
      wide.hi[k] = static_cast<double>(box.hi[k]) + 1;
    }
  }
  return boxes;
}

/// A ray through bins meets fewer faces than all.
constexpr size_t kFewPlanes = 512;

/// A square an operand, about.
uint32_t squares_for(size_t operands) {
  constexpr size_t kMost = 64 * 64;
  return static_cast<uint32_t>(std::clamp<size_t>(operands, 1, kMost));
}

}  // namespace

PatchLabels::PatchLabels(const Job& job, const Expression& expression,
                         const PlainlyCovered& plainly)
    : job_(job),
      plainly_(plainly),
      boundary_(expression),
      signs_(job, true),  // rays meet pieces that the job does not have
      boxes_(job),
      bins_(boxes_of_operands(job), squares_for(job.operand_count())) {}

/// Whether they tell that nothing there is boundary, whatever else there is: part of the patch is
/// inside of a remover or outside of a confiner, or hidden surface passes through it.
bool PatchLabels::are_decisive(std::span<const CutLoops::Fact> facts) const {
  const DeadSpace& dead = *plainly_.dead;
  for (size_t f = 0; f < facts.size(); ++f) {
    const CutLoops::Fact& fact = facts[f];
    if (fact.front && fact.back && dead.is_remover(fact.operand)) return true;
    if (!fact.front && !fact.back && dead.is_confiner(fact.operand)) return true;
    if (f > 0 && facts[f - 1].operand == facts[f].operand) return true;
  }
  return false;
}

PatchFate PatchLabels::fate(uint32_t own, const std::array<double, 3>& point, double error,
                            std::span<const CutLoops::Fact> facts, bool is_at_first) {
  if (are_decisive(facts)) return PatchFate::kDrop;
  // Boxes are clamped; what is beyond is not told by them.
  for (const double c : point) {
    if (std::fabs(c) >= 0x1p30 || error >= 1) return PatchFate::kUnknown;
  }
  if (plainly_.dead->is_beside_result(point, error) ||
      plainly_.dead->inner_boxes().hold(point, error)) {
    return PatchFate::kDrop;
  }
  const auto is_known = [&](const CutLoops::Fact& f) {
    return !plainly_.is_open[f.operand] || f.front != f.back || (is_at_first && !f.is_elsewhere);
  };
  patch_.first = own;
  Sides& inside = patch_.second;
  inside.clear();
  asked_.clear();
  for (const CutLoops::Fact& f : facts) {
    if (!is_known(f)) continue;
    if (f.front) inside.push_back(2 * uint64_t{f.operand});
    if (f.back) inside.push_back(2 * uint64_t{f.operand} + 1);
  }
  for (const uint32_t o : bins_.at(point)) {
    if (o == own || !may_hold(job_.operand_box(o), point, error) ||
        std::any_of(facts.begin(), facts.end(),
                    [&](const auto& f) { return f.operand == o && is_known(f); })) {
      continue;
    }
    const OperandBalls::Side side = error < OperandBalls::kMostWrong
                                        ? plainly_.dead->balls().side(o, point)
                                        : OperandBalls::Side::kUnknown;
    if (side == OperandBalls::Side::kUnknown) {
      asked_.push_back(o);
    } else if (note(o, side == OperandBalls::Side::kInside)) {
      return PatchFate::kDrop;
    }
  }
  bool is_unsure = false;
  for (const uint32_t o : asked_) {
    Inside label = Inside::kUnknown;
    if (plainly_.dead->balls().has(o) && job_.is_convex(o) &&
        job_.leaf(o)->face_count() <= kFewPlanes) {
      label = convex_sides_.side(job_.operands(), o, point);
    }
    if (label == Inside::kUnknown) label = ray_label(job_, signs_, boxes_, o, point, error);
    is_unsure |= label == Inside::kUnknown;
    if (label != Inside::kUnknown && note(o, label == Inside::kYes)) return PatchFate::kDrop;
  }
  if (is_unsure) return PatchFate::kUnknown;
  std::sort(inside.begin(), inside.end());
  const auto [known, is_new] = known_.try_emplace(patch_, PatchFate::kDrop);
  if (is_new) known->second = evaluate(own, inside);
  return known->second;
}

/// Notes whether a point is inside of an operand, unless that tells already that nothing there is
/// boundary: then it is true.
bool PatchLabels::note(uint32_t operand, bool is_inside) {
  const DeadSpace& dead = *plainly_.dead;
  if (is_inside ? dead.is_remover(operand) : dead.is_confiner(operand)) return true;
  Sides& inside = patch_.second;
  if (is_inside) inside.insert(inside.end(), {2 * uint64_t{operand}, 2 * uint64_t{operand} + 1});
  return false;
}

PatchFate PatchLabels::evaluate(uint32_t own, const Sides& inside) {
  sides_.clear();
  const auto add = [&](uint32_t operand, bool is_back) {
    if (sides_.empty() || sides_.back().operand != operand) {
      sides_.push_back({operand, false, false});
    }
    (is_back ? sides_.back().back : sides_.back().front) = true;
  };
  for (const uint64_t side : inside) add(static_cast<uint32_t>(side / 2), side % 2 == 1);
  add(own, true);
  const auto boundary = boundary_.evaluate(sides_);
  // Where several operands have surface, the lowest that counts gives it, once.
  if (boundary.operand != own) return PatchFate::kDrop;
  return boundary.front ? PatchFate::kFlip : PatchFate::kKeep;
}

}  // namespace csgrun

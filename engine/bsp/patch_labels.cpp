#include "engine/bsp/patch_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/bsp/ray_label.h"

namespace csgrun {

PatchLabels::PatchLabels(const Job& job, const Expression& expression)
    : job_(job), expression_(expression), signs_(job), is_inside_(2 * job.operand_count(), 0) {
  constexpr int32_t lo = std::numeric_limits<int32_t>::min(),
                    hi = std::numeric_limits<int32_t>::max();
  boxes_.assign(job.operand_count(), {{hi, hi, hi}, {lo, lo, lo}});
  for (uint32_t o = 0; o < job.operand_count(); ++o) {
    PolygonBox& box = boxes_[o];
    for (uint32_t p = job.polygon_start(o); p < job.polygon_start(o + 1); ++p) {
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], job.boxes()[p].lo[k]);
        box.hi[k] = std::max(box.hi[k], job.boxes()[p].hi[k]);
      }
    }
  }
}

PatchFate PatchLabels::fate(uint32_t own, const std::array<double, 3>& point, double error,
                            std::span<const CutLoops::Fact> facts) {
  // Boxes are clamped; what is beyond is not told by them.
  for (const double c : point) {
    if (std::fabs(c) >= 0x1p30) return PatchFate::kUnknown;
  }
  Sides inside;
  size_t fact = 0;
  for (uint32_t o = 0; o < job_.operand_count(); ++o) {
    const uint64_t front = 2 * uint64_t{o}, back = front + 1;
    if (fact < facts.size() && facts[fact].operand == o) {
      if (facts[fact].front) inside.push_back(front);
      if (facts[fact++].back) inside.push_back(back);
      continue;
    }
    if (o == own) continue;
    const PolygonBox& box = boxes_[o];
    bool may_hold = true;
    for (int k = 0; k < 3; ++k) {
      may_hold &= point[k] + error >= box.lo[k] && point[k] - error <= box.hi[k];
    }
    if (!may_hold) continue;
    const Inside label = ray_label(job_, signs_, o, point, error);
    if (label == Inside::kUnknown) return PatchFate::kUnknown;
    if (label == Inside::kYes) inside.insert(inside.end(), {front, back});
  }
  const auto [known, is_new] = known_.try_emplace({own, std::move(inside)}, PatchFate::kDrop);
  if (is_new) known->second = evaluate(own, known->first.second);
  return known->second;
}

PatchFate PatchLabels::evaluate(uint32_t own, const Sides& inside) {
  for (const uint64_t side : inside) is_inside_[side] = 1;
  is_inside_[2 * uint64_t{own} + 1] = 1;
  const auto boundary = expression_.boundary(
      [&](uint32_t o) { return is_inside_[2 * uint64_t{o}] != 0; },
      [&](uint32_t o) { return is_inside_[2 * uint64_t{o} + 1] != 0; }, scratch_);
  is_inside_[2 * uint64_t{own} + 1] = 0;
  for (const uint64_t side : inside) is_inside_[side] = 0;
  // Where several operands have surface, the lowest that counts gives it, once.
  if (boundary.operand != own) return PatchFate::kDrop;
  return boundary.front ? PatchFate::kFlip : PatchFate::kKeep;
}

}  // namespace csgrun

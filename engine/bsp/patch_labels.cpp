#include "engine/bsp/patch_labels.h"

#include <algorithm>
#include <cmath>

#include "engine/bsp/ray_label.h"

namespace csgrun {

PatchLabels::PatchLabels(const Job& job, const Expression& expression)
    : job_(job), boundary_(expression), signs_(job) {
  for (uint32_t o = 0; o < job.operand_count(); ++o) boxes_.push_back(job.operand_box(o));
  fill_bins();
}

void PatchLabels::fill_bins() {
  constexpr uint32_t kMost = 64;
  while (bins_ < kMost && bins_ * bins_ < boxes_.size()) bins_ *= 2;
  for (int k = 0; k < 2; ++k) {
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (const PolygonBox& box : boxes_) {
      if (box.lo[k] > box.hi[k]) continue;
      lo = std::min<double>(lo, box.lo[k]);
      hi = std::max<double>(hi, box.hi[k]);
    }
    bin_lo_[k] = lo;
    bins_per_step_[k] = hi > lo ? bins_ / (hi - lo) : 0;
  }
  const auto each_bin = [&](const PolygonBox& box, auto&& f) {
    if (box.lo[0] > box.hi[0]) return;
    // A step more: a point is not known to the last bit.
    const auto first = [&](int k) { return bin(k, static_cast<double>(box.lo[k]) - 1); };
    const auto last = [&](int k) { return bin(k, static_cast<double>(box.hi[k]) + 1); };
    for (uint32_t y = first(1); y <= last(1); ++y) {
      for (uint32_t x = first(0); x <= last(0); ++x) f(y * bins_ + x);
    }
  };
  bin_starts_.assign(bins_ * bins_ + 1, 0);
  for (const PolygonBox& box : boxes_) {
    each_bin(box, [&](uint32_t b) { ++bin_starts_[b + 1]; });
  }
  for (size_t b = 0; b + 1 < bin_starts_.size(); ++b) bin_starts_[b + 1] += bin_starts_[b];
  in_bin_.resize(bin_starts_.back());
  std::vector<uint32_t> next = bin_starts_;
  for (uint32_t o = 0; o < boxes_.size(); ++o) {
    each_bin(boxes_[o], [&](uint32_t b) { in_bin_[next[b]++] = o; });
  }
}

uint32_t PatchLabels::bin(int axis, double coordinate) const {
  // Monotone: what is between the ends of a box is in a bin between theirs.
  const double at = (coordinate - bin_lo_[axis]) * bins_per_step_[axis];
  return static_cast<uint32_t>(std::clamp(at, 0.0, static_cast<double>(bins_ - 1)));
}

PatchFate PatchLabels::fate(uint32_t own, const std::array<double, 3>& point, double error,
                            std::span<const CutLoops::Fact> facts) {
  // Boxes are clamped; what is beyond is not told by them.
  for (const double c : point) {
    if (std::fabs(c) >= 0x1p30 || error >= 1) return PatchFate::kUnknown;
  }
  inside_.clear();
  for (const CutLoops::Fact& f : facts) {
    if (f.front) inside_.push_back(2 * uint64_t{f.operand});
    if (f.back) inside_.push_back(2 * uint64_t{f.operand} + 1);
  }
  const uint32_t b = bin(1, point[1]) * bins_ + bin(0, point[0]);
  for (uint32_t i = bin_starts_[b]; i < bin_starts_[b + 1]; ++i) {
    const uint32_t o = in_bin_[i];
    const PolygonBox& box = boxes_[o];
    bool may_hold = o != own;
    for (int k = 0; k < 3; ++k) {
      may_hold &= point[k] + error >= box.lo[k] && point[k] - error <= box.hi[k];
    }
    if (!may_hold || std::any_of(facts.begin(), facts.end(),
                                 [&](const CutLoops::Fact& f) { return f.operand == o; })) {
      continue;
    }
    const Inside label = ray_label(job_, signs_, o, point, error);
    if (label == Inside::kUnknown) return PatchFate::kUnknown;
    if (label == Inside::kYes)
      inside_.insert(inside_.end(), {2 * uint64_t{o}, 2 * uint64_t{o} + 1});
  }
  std::sort(inside_.begin(), inside_.end());
  const auto [known, is_new] = known_.try_emplace({own, inside_}, PatchFate::kDrop);
  if (is_new) known->second = evaluate(own, known->first.second);
  return known->second;
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

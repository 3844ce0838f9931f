#include "engine/mesh/sweep_status.h"

namespace csgrun {
namespace {

/// A well-mixed function of a counter: the heap priorities need to be unordered, not secret.
uint32_t mix(uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352dU;
  x = (x ^ (x >> 15)) * 0x846ca68bU;
  return x ^ (x >> 16);
}

}  // namespace

void SweepStatus::rotate_up(uint32_t slot) {
  const uint32_t parent = slots_[slot].parent;
  const uint32_t grand = slots_[parent].parent;
  const int side = slots_[parent].child[1] == slot ? 1 : 0;
  const uint32_t inner = slots_[slot].child[1 - side];
  slots_[parent].child[side] = inner;
  if (inner != kNone) slots_[inner].parent = parent;
  slots_[slot].child[1 - side] = parent;
  slots_[parent].parent = slot;
  slots_[slot].parent = grand;
  if (grand == kNone) {
    root_ = slot;
  } else {
    slots_[grand].child[slots_[grand].child[1] == parent ? 1 : 0] = slot;
  }
}

uint32_t SweepStatus::insert_before(uint32_t position, uint32_t edge) {
  uint32_t slot;
  if (free_.empty()) {
    slot = static_cast<uint32_t>(slots_.size());
    slots_.emplace_back();
  } else {
    slot = free_.back();
    free_.pop_back();
  }
  const uint32_t before = prev(position);
  slots_[slot] = {edge, kNone, before, position, {kNone, kNone}, mix(++made_)};
  (position == kNone ? last_ : slots_[position].prev) = slot;
  if (before != kNone) slots_[before].next = slot;

  // In the tree the gap is the left child of `position` or the right child of the slot before it.
  if (position != kNone && slots_[position].child[0] == kNone) {
    slots_[position].child[0] = slot;
    slots_[slot].parent = position;
  } else if (before != kNone) {
    slots_[before].child[1] = slot;
    slots_[slot].parent = before;
  } else {
    root_ = slot;
  }
  while (slots_[slot].parent != kNone &&
         slots_[slots_[slot].parent].priority < slots_[slot].priority) {
    rotate_up(slot);
  }
  return slot;
}

void SweepStatus::erase(uint32_t slot) {
  for (;;) {
    const uint32_t low = slots_[slot].child[0], high = slots_[slot].child[1];
    if (low == kNone && high == kNone) break;
    if (low == kNone) {
      rotate_up(high);
    } else if (high == kNone || slots_[low].priority > slots_[high].priority) {
      rotate_up(low);
    } else {
      rotate_up(high);
    }
  }
  const uint32_t parent = slots_[slot].parent;
  if (parent == kNone) {
    root_ = kNone;
  } else {
    slots_[parent].child[slots_[parent].child[1] == slot ? 1 : 0] = kNone;
  }
  const uint32_t before = slots_[slot].prev, after = slots_[slot].next;
  if (before != kNone) slots_[before].next = after;
  (after == kNone ? last_ : slots_[after].prev) = before;
  free_.push_back(slot);
}

}  // namespace csgrun

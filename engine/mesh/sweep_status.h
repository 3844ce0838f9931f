// The edges that a sweep line crosses, from bottom to top: a treap that is searched by a predicate
// and changed in place, so that no two edges are ever compared with one another.
#pragma once

#include <cstdint>
#include <vector>

namespace csgrun {

/// An ordered sequence of edge numbers. Slots are stable handles; kNone stands before the first and
/// behind the last. Every operation costs O(log n) expected; the shape depends only on the order of
/// the calls, and no result depends on the shape.
class SweepStatus {
 public:
  static constexpr uint32_t kNone = UINT32_MAX;

  [[nodiscard]] bool empty() const { return root_ == kNone; }
  /// Back to the state in which it was made, but for the memory that it has.
  void clear() {
    slots_.clear();
    free_.clear();
    root_ = last_ = kNone;
    made_ = 0;
  }
  [[nodiscard]] uint32_t edge(uint32_t slot) const { return slots_[slot].edge; }
  [[nodiscard]] uint32_t next(uint32_t slot) const { return slots_[slot].next; }
  [[nodiscard]] uint32_t prev(uint32_t slot) const {
    return slot == kNone ? last_ : slots_[slot].prev;
  }

  /// Puts another edge in the place of the slot's own.
  void replace(uint32_t slot, uint32_t edge) { slots_[slot].edge = edge; }

  /// Inserts `edge` right before `position` (kNone: at the end) and returns its slot.
  uint32_t insert_before(uint32_t position, uint32_t edge);
  void erase(uint32_t slot);

  /// The first slot, from the bottom, whose edge is not `below`; kNone when all are. `below` must
  /// be true for a prefix of the sequence.
  template <class Below>
  [[nodiscard]] uint32_t first_not(Below below) const {
    uint32_t found = kNone;
    for (uint32_t at = root_; at != kNone;) {
      if (below(slots_[at].edge)) {
        at = slots_[at].child[1];
      } else {
        found = at;
        at = slots_[at].child[0];
      }
    }
    return found;
  }

 private:
  struct Slot {
    uint32_t edge, parent, prev, next;
    uint32_t child[2];
    uint32_t priority;
  };

  void rotate_up(uint32_t slot);

  std::vector<Slot> slots_;
  std::vector<uint32_t> free_;
  uint32_t root_ = kNone, last_ = kNone;
  uint32_t made_ = 0;
};

}  // namespace csgrun

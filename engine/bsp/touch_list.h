// Where results may touch themselves, as boxes: few of them, and a list that versions of a result
// share, so that one more operation costs what it adds.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

/// So many boxes say well enough where a result may touch itself.
constexpr size_t kMostTouches = 4096;
/// Leaves kMostTouches at most, around what there was. Neighbours in the list are near each other
/// mostly; a result has no use for a box a contact.
void keep_few(std::vector<GridBox>& boxes);

class TouchList {
 public:
  /// This list and more boxes. Amortised O(more): a long list is put together anew, with boxes
  /// around several in place of them (keep_few).
  [[nodiscard]] TouchList with(std::vector<GridBox> more) const;
  /// All boxes, those that were added first before the others. O(n).
  [[nodiscard]] std::vector<GridBox> boxes() const;

 private:
  struct Node {
    std::vector<GridBox> boxes;
    std::shared_ptr<const Node> before;
    size_t count = 0;  ///< of boxes here and before
  };
  std::shared_ptr<const Node> last_;
};

}  // namespace csgrun

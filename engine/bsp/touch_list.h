// Where versions of a result may touch themselves: a list that they share, so that one more
// operation costs what it adds.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/bsp/operand.h"

namespace csgrun {

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

#include "engine/bsp/unate.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace csgrun {
namespace {

constexpr uint8_t kAdds = 1, kTakes = 2;

uint8_t turned(uint8_t ways) {
  return static_cast<uint8_t>((ways & kAdds ? kTakes : 0) | (ways & kTakes ? kAdds : 0));
}

}  // namespace

bool is_unate(const Expression& expression) {
  const std::vector<Expression::Node>& nodes = expression.nodes;
  if (nodes.empty()) return true;
  std::vector<uint8_t> ways(nodes.size(), 0), ways_of_operand;
  ways.back() = kAdds;
  for (size_t n = nodes.size(); n-- > 0;) {
    const Expression::Node& node = nodes[n];
    if (node.is_operand) {
      if (node.operand >= ways_of_operand.size()) ways_of_operand.resize(node.operand + 1, 0);
      ways_of_operand[node.operand] |= ways[n];
      continue;
    }
    for (uint32_t c = 0; c < node.child_count; ++c) {
      uint8_t& of_child = ways[expression.children[node.first_child + c]];
      switch (node.op) {
        case BooleanOp::kUnion:
        case BooleanOp::kIntersection:
          of_child |= ways[n];
          break;
        case BooleanOp::kDifference:
          of_child |= c == 0 ? ways[n] : turned(ways[n]);
          break;
        case BooleanOp::kSymmetricDifference:
          of_child |= ways[n] | turned(ways[n]);
          break;
      }
    }
  }
  return std::none_of(ways_of_operand.begin(), ways_of_operand.end(),
                      [](uint8_t of_operand) { return of_operand == (kAdds | kTakes); });
}

}  // namespace csgrun

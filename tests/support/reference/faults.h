// Deliberate faults of the reference. A reference that nobody has seen fail proves nothing: tests
// turn each of these on and demand that known truths notice it.
#pragma once

#include <array>
#include <cstdint>

namespace csgrun::reference {

enum class Fault : uint8_t {
  kNone,
  kUnionAsXor,
  kXorAsUnion,
  kDifferenceTurned,  ///< b - a for a - b
  kOtherRule,         ///< even-odd for non-zero, non-zero for the others
  kLostFace,          ///< the last face of the last leaf is not seen
  kTurnedOver,        ///< the first leaf's sections run the wrong way
  kOneSide,           ///< what touches a plane from below is taken to touch it from above
  kNoCrossings,       ///< lines that cross keep their order
  kUpperLabel,        ///< on an overlap the last operand gives the label
  kWrongWay,          ///< a flood passes fronts and is stopped by backs
  kLeak,              ///< a flood passes faces that look down
};

inline constexpr std::array kFaults{
    Fault::kUnionAsXor, Fault::kXorAsUnion,  Fault::kDifferenceTurned,
    Fault::kOtherRule,  Fault::kLostFace,    Fault::kTurnedOver,
    Fault::kOneSide,    Fault::kNoCrossings, Fault::kUpperLabel,
    Fault::kWrongWay,   Fault::kLeak};

}  // namespace csgrun::reference

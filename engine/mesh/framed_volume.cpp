// The map to the world is q -> 2^40 adj(m) q / det(m), with m the frame's matrix. Its determinant
// is 2^120 / det(m), and a normal n becomes 2^80 m^T n / det(m). From det(a - o, b - o, c - o) =
// det(a, b, c) - o . (b - a) x (c - a), all sums have det(m) for their denominator:
//   2^80 (2^40 determinants - o . m^T normals) / det(m).
// m has entries of 56 bits, and o of 41: the difference has less than 200 bits, times 2^(80 + 192)
// less than 480.
#include "engine/mesh/framed_volume.h"

#include <algorithm>
#include <span>

#include "engine/mesh/fixed_sums.h"
#include "engine/mesh/natural.h"

namespace csgrun {

Int<6> framed_determinants(const FramedSums& sums, const FrameMap& map, const IVec3& o, bool& cut) {
  const auto& m = map.frame().matrix;
  Int<4> sum = Int<4>::from_int128(sums.determinants).shifted_left(Frame::kShift);
  for (size_t j = 0; j < 3; ++j) {
    Int<3> normal;
    for (size_t i = 0; i < 3; ++i) {
      normal += full_product(Int<1>(m[i][j]), Int<2>::from_int128(sums.normals[i]));
    }
    sum -= full_product(Int<1>(o[j]), normal);
  }
  constexpr int kFraction = 2 * Frame::kShift + 192;
  const Int<4> divisor = map.determinant().magnitude();
  const int bits = divisor.bit_width(), lift = (64 - bits % 64) % 64;
  const auto limbs = static_cast<size_t>((bits + 63) / 64);
  const Int<4> lifted = divisor.shifted_left(lift);
  Int<10> dividend = Int<10>::from(sum.magnitude()).shifted_left(kFraction + lift);
  std::array<uint64_t, 10> digits{};
  divide_normalised(dividend.limb, std::span(lifted.limb.data(), limbs),
                    std::span(digits.data(), dividend.limb.size() - limbs));
  cut = cut || !dividend.is_zero();
  Int<6> result;
  std::copy_n(digits.begin(), result.limb.size(), result.limb.begin());
  return sum.negative() ? -result : result;  // of a negative det(m) the loops run back
}

}  // namespace csgrun

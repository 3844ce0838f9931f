// Each round sums in fixed point (fixed_sums.h) and keeps the results whose lower and upper bounds
// round to one double. Where an exact value is zero or stands in the middle of two doubles the
// bounds never agree: then the sums are formed modulo two primes and compared with that value.
#include "engine/mesh/measure.h"

#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "engine/mesh/fixed_sums.h"
#include "engine/mesh/natural.h"
#include "engine/mesh/residues.h"

namespace csgrun {
namespace {

constexpr std::array<uint64_t, 5> kPrimes{(1ull << 61) - 1, (1ull << 61) - 31, (1ull << 61) - 45,
                                          (1ull << 61) - 229, (1ull << 61) - 259};
constexpr size_t kPrimesNeeded = 2;

Error failure(const char* what) {
  return {ErrorCode::kInternal, std::string("cannot measure a result: ") + what, {}};
}

/// mantissa * 2^exponent.
struct Dyadic {
  int64_t mantissa = 0;
  int exponent = 0;
};

/// The middle of two neighbouring doubles.
Dyadic middle(double low, double high) {
  int exponent = 0;
  std::frexp(std::fmax(std::fabs(low), std::fabs(high)), &exponent);
  const auto whole = [&](double x) { return static_cast<int64_t>(std::ldexp(x, 54 - exponent)); };
  return {whole(low) + whole(high), exponent - 55};
}

/// The sums of fixed_sums.h modulo a prime.
struct Residues {
  PrimeField field;
  uint64_t six_volumes = 0;
  std::array<uint64_t, 3> moments{};

  [[nodiscard]] uint64_t residue(const Dyadic& d) const {
    return field.multiply(field.residue(d.mantissa), field.power_of_two(d.exponent));
  }
  [[nodiscard]] uint64_t residue(const GridStep& s) const {
    return field.multiply(
        field.multiply(field.residue(s.numerator), field.inverse(field.residue(s.denominator))),
        field.power_of_two(s.exponent));
  }
};

struct Mesh {
  const PointAccess& point;
  TriangleSpan triangles;
  std::vector<bool> used;
  std::array<int64_t, 3> origin{};
  Wanted wanted = Wanted::kAll;
};

/// Nothing when the prime divides a denominator.
std::optional<Residues> residues_of(const Mesh& mesh, uint64_t prime) {
  Residues r{PrimeField(prime)};
  const PrimeField& f = r.field;
  std::vector<std::array<uint64_t, 3>> points(mesh.used.size());
  for (uint32_t v = 0; v < points.size(); ++v) {
    if (!mesh.used[v]) continue;
    const Point p = mesh.point(v);
    const uint64_t w = f.residue(p.w);
    if (w == 0) return std::nullopt;
    const uint64_t inverse = f.inverse(w);
    for (int k = 0; k < 3; ++k) {
      points[v][k] =
          f.subtract(f.multiply(f.residue(coordinate(p, k)), inverse), f.residue(mesh.origin[k]));
    }
  }
  for (const auto& t : mesh.triangles) {
    const auto &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    uint64_t determinant = 0;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      const uint64_t minor = f.subtract(f.multiply(b[i], c[j]), f.multiply(b[j], c[i]));
      determinant = f.add(determinant, f.multiply(a[k], minor));
    }
    r.six_volumes = f.add(r.six_volumes, determinant);
    for (int k = 0; k < 3; ++k) {
      const uint64_t sum = f.add(f.add(a[k], b[k]), c[k]);
      r.moments[k] = f.add(r.moments[k], f.multiply(determinant, sum));
    }
  }
  return r;
}

/// The least and the greatest volume in mm^3 that a sum of determinants leaves, each rounded.
std::array<double, 2> volume_bounds(const Sum& six_volumes, int fraction_bits,
                                    const GridStep& step) {
  const auto cube = [](const Natural& n) { return multiply(multiply(n, n), n); };
  const auto rounded = [&](bool low) {
    const Signed bound = add(six_volumes.value, {low, six_volumes.error});
    return round_quotient(multiply(bound, cube(natural(Int<1>(step.numerator)))),
                          multiply(cube(natural(Int<1>(step.denominator))), natural(6)),
                          3 * (step.exponent - fraction_bits));
  };
  return {rounded(true), rounded(false)};
}

/// Turns sums into results; keeps what is certain from one round to the next.
class Rounder {
 public:
  Rounder(const Mesh& mesh, const GridStep& step)
      : mesh_(mesh),
        step_(step),
        numerator_(natural(Int<1>(step.numerator))),
        denominator_(natural(Int<1>(step.denominator))) {}

  /// Takes the results that the sums make certain. Returns whether that is all that is wanted.
  bool take(const Sums& sums) {
    take_volume(sums);
    if (mesh_.wanted == Wanted::kVolume) return volume_.has_value();
    take_area(sums);
    if (mesh_.wanted == Wanted::kVolumeAndArea) return volume_ && area_;
    for (int k = 0; k < 3; ++k) take_centroid(sums, k);
    return volume_ && area_ && centroid_[0] && centroid_[1] && centroid_[2];
  }

  [[nodiscard]] MassProperties result() const {
    if (mesh_.wanted == Wanted::kVolume) return {*volume_, 0, {}};
    if (mesh_.wanted == Wanted::kVolumeAndArea) return {*volume_, *area_, {}};
    return {*volume_, *area_, {*centroid_[0], *centroid_[1], *centroid_[2]}};
  }

 private:
  void take_volume(const Sums& sums) {
    if (volume_) return;
    const auto [low, high] = volume_bounds(sums.six_volumes, sums.fraction_bits, step_);
    volume_ = settle(low, high, sums, [&](const Residues& r, Dyadic value) {
      const PrimeField& f = r.field;
      return f.multiply(r.six_volumes, f.power(r.residue(step_), 3)) ==
             f.multiply(6, r.residue(value));
    });
    if (volume_ && *volume_ == 0) {
      for (auto& c : centroid_) c = 0.0;
    }
  }

  /// A coordinate of the centroid is (origin + moment / (4 six_volumes)) * step.
  void take_centroid(const Sums& sums, int axis) {
    if (centroid_[axis]) return;
    const Sum &moment = sums.moments[axis], &volume = sums.six_volumes;
    if (compare(volume.value.magnitude, volume.error) <= 0) return;  // its sign is not certain
    const auto rounded = [&](bool low) {
      Signed top = moment.value;
      if (volume.value.negative) top.negative = !top.negative;
      top = add(top, {low, moment.error});
      // A positive quotient is least for the greatest divisor, a negative one for the least.
      const Natural bottom = top.negative == low ? subtract(volume.value.magnitude, volume.error)
                                                 : add(volume.value.magnitude, volume.error);
      const Natural divisor = shift_left(bottom, sums.fraction_bits + 2);
      const Signed origin = signed_value(Int<1>(mesh_.origin[axis]));
      return round_quotient(multiply(add(multiply(origin, divisor), top), numerator_),
                            multiply(divisor, denominator_), step_.exponent);
    };
    centroid_[axis] =
        settle(rounded(true), rounded(false), sums, [&](const Residues& r, Dyadic value) {
          const PrimeField& f = r.field;
          const uint64_t volumes = f.multiply(4, r.six_volumes);
          const uint64_t whole =
              f.add(f.multiply(f.residue(mesh_.origin[axis]), volumes), r.moments[axis]);
          return f.multiply(whole, r.residue(step_)) == f.multiply(volumes, r.residue(value));
        });
  }

  void take_area(const Sums& sums) {
    if (area_ || sums.twice_area_error > 0x1p-60 * sums.twice_area.hi) return;
    area_ = round_area(sums.twice_area, step_);
  }

  /// The rounded value when both bounds round to one double, or when the exact value is found to be
  /// zero or the middle of two neighbours.
  template <class IsExactly>
  std::optional<double> settle(double low, double high, const Sums& sums, IsExactly is_exactly) {
    if (low == high) return low;
    // Another round is cheaper than residues, and mostly enough.
    if (sums.fraction_bits < 128) return std::nullopt;
    const auto holds = [&](Dyadic value) {
      if (!residues_ready_) make_residues();
      if (residues_.size() < kPrimesNeeded) return false;
      for (const Residues& r : residues_) {
        if (!is_exactly(r, value)) return false;
      }
      return true;
    };
    if (low < 0 && high > 0) {
      if (holds({})) return 0.0;
    } else if (std::nextafter(low, high) == high && holds(middle(low, high))) {
      return std::bit_cast<uint64_t>(low) & 1 ? high : low;
    }
    return std::nullopt;
  }

  void make_residues() {
    residues_ready_ = true;
    for (uint64_t prime : kPrimes) {
      if (residues_.size() == kPrimesNeeded) break;
      if (auto r = residues_of(mesh_, prime)) residues_.push_back(*r);
    }
  }

  const Mesh& mesh_;
  GridStep step_;
  Natural numerator_, denominator_;
  std::optional<double> volume_, area_;
  std::array<std::optional<double>, 3> centroid_;
  bool residues_ready_ = false;
  std::vector<Residues> residues_;
};

/// Rounds of K, 2 K, ... limbs of fraction.
template <int K>
Result<MassProperties> measure_from(const Mesh& mesh, Rounder& rounder) {
  constexpr int kLastRound = 8;
  {
    const FixedRound<K> round(mesh.point, mesh.triangles, mesh.used, mesh.origin, mesh.wanted);
    if (!round.in_range()) return failure("a point is out of range");
    if (rounder.take(round.sums())) return rounder.result();
  }
  if constexpr (K < kLastRound) {
    return measure_from<2 * K>(mesh, rounder);
  } else {
    return failure("no number of digits suffices");
  }
}

}  // namespace

Result<MassProperties> measure_mesh(size_t point_count, const PointAccess& point,
                                    TriangleSpan triangles, const GridStep& step, Wanted wanted) {
  if (triangles.empty()) return MassProperties{};
  Mesh mesh{point, triangles, std::vector<bool>(point_count), {}, wanted};
  for (const auto& t : triangles) {
    for (uint32_t v : t) {
      if (v >= point_count) return failure("an index is out of range");
      mesh.used[v] = true;
    }
  }
  const Point near = point(triangles[0][0]);
  const FixedQuotients<1> over_w(near.w);
  for (int k = 0; k < 3; ++k) {
    Int<2> x;
    bool cut = false;
    if (!over_w.divide(coordinate(near, k), x, cut)) {
      return failure("a point is out of range");
    }
    mesh.origin[k] = static_cast<int64_t>(x.limb[1]);
  }
  Rounder rounder(mesh, step);
  return measure_from<1>(mesh, rounder);
}

std::optional<double> round_volume(const Sum& six_volumes, int fraction_bits,
                                   const GridStep& step) {
  const auto [low, high] = volume_bounds(six_volumes, fraction_bits, step);
  if (low != high) return std::nullopt;
  return low;
}

double round_area(const DoubleDouble& twice_area, const GridStep& step) {
  const DoubleDouble mm =
      double_double(Int<1>(step.numerator)) / double_double(Int<1>(step.denominator));
  return (twice_area * mm * mm).scaled(2 * step.exponent - 1).hi;
}

}  // namespace csgrun

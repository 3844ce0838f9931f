#include "engine/csg/grid.h"

#include <bit>
#include <cmath>
#include <numeric>
#include <string>

namespace csgrun {
namespace {

using Int128 = __int128;

// Beyond these the exact rounding below would not fit 128 bits, nor one division be correctly
// rounded.
constexpr int64_t kLargestPart = (int64_t{1} << 53) - 1;

/// Of exponents that are in range with any numerator and denominator.
constexpr int kFarthest = 300;

GridStep reduced(int64_t numerator, int64_t denominator, int exponent) {
  const int64_t g = std::gcd(numerator, denominator);
  numerator /= g;
  denominator /= g;
  const int up = std::countr_zero(static_cast<uint64_t>(numerator));
  const int down = std::countr_zero(static_cast<uint64_t>(denominator));
  return {numerator >> up, denominator >> down, exponent + up - down};
}

Error bad_step(const std::string& text, const std::string& why) {
  return {ErrorCode::kInvalidArgument,
          "grid step '" + text + "' " + why + " (expected millimetres such as 0.001 or 2^-20mm)",
          {}};
}

/// Digits as a number of at most 18 places; std::nullopt when there are none or too many.
std::optional<int64_t> parse_digits(const std::string& digits) {
  if (digits.empty() || digits.size() > 18) return std::nullopt;
  int64_t value = 0;
  for (char c : digits) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

std::optional<int> parse_exponent(const std::string& text) {
  const bool negative = !text.empty() && text[0] == '-';
  const size_t sign = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const auto value = parse_digits(text.substr(sign));
  if (!value || *value > 1000) return std::nullopt;
  return static_cast<int>(negative ? -*value : *value);
}

}  // namespace

double GridStep::millimetres() const {
  return std::ldexp(static_cast<double>(numerator) / static_cast<double>(denominator), exponent);
}

std::string GridStep::problem() const {
  if (automatic()) return {};
  if (numerator < 0 || denominator <= 0) return "is not positive";
  if (numerator > kLargestPart || denominator > kLargestPart) return "has too many digits";
  const bool is_far = exponent < -kFarthest || exponent > kFarthest;
  if (is_far || !(millimetres() >= 0x1p-200 && millimetres() <= 0x1p200)) {
    return "is out of range";
  }
  if (!(*this == reduced(numerator, denominator, exponent))) return "is not in lowest terms";
  return {};
}

Result<GridStep> GridStep::parse(const std::string& text) {
  std::string body = text;
  if (body.size() >= 2 && body.ends_with("mm")) body.resize(body.size() - 2);
  while (!body.empty() && body.back() == ' ') body.pop_back();
  GridStep step;
  if (body.starts_with("2^")) {
    const auto exponent = parse_exponent(body.substr(2));
    if (!exponent || *exponent < -200 || *exponent > 200) {
      return bad_step(text, "is not a power of two in range");
    }
    step = {1, 1, *exponent};
  } else {
    int tens = 0;
    if (const size_t e = body.find_first_of("eE"); e != std::string::npos) {
      const auto exponent = parse_exponent(body.substr(e + 1));
      if (!exponent) return bad_step(text, "is not a number");
      tens = *exponent;
      body.resize(e);
    }
    std::string digits = body;
    if (const size_t point = body.find('.'); point != std::string::npos) {
      digits = body.substr(0, point) + body.substr(point + 1);
      tens -= static_cast<int>(body.size() - point - 1);
    }
    while (digits.size() > 1 && digits.ends_with('0') && tens < 0) {
      digits.pop_back();
      ++tens;
    }
    while (digits.size() > 1 && digits.starts_with('0')) digits.erase(0, 1);
    const auto value = parse_digits(digits);
    if (!value) return bad_step(text, "is not a number of at most 18 digits");
    if (*value == 0) return bad_step(text, "is zero");
    // 10^tens = 5^tens 2^tens: only the powers of five take room.
    int64_t numerator = *value, denominator = 1;
    for (int i = 0; i < std::abs(tens); ++i) {
      int64_t& part = tens > 0 ? numerator : denominator;
      if (tens < 0 && numerator % 5 == 0) {
        numerator /= 5;
      } else if (part > kLargestPart / 5) {
        return bad_step(text, "is out of range");
      } else {
        part *= 5;
      }
    }
    step = reduced(numerator, denominator, tens);
  }
  if (const std::string fault = step.problem(); !fault.empty()) return bad_step(text, fault);
  return step;
}

Quantiser::Quantiser(const GridStep& step)
    : step_(step),
      step_mm_(step.millimetres()),
      limit_mm_(std::ldexp(step_mm_, 41)),
      steps_per_mm_(1 / step_mm_) {}

int64_t Quantiser::round_exactly(double x) const {
  // x = m 2^k, so x / step = (m denominator) 2^s / numerator with an exact product of 106 bits.
  const uint64_t bits = std::bit_cast<uint64_t>(x);
  const int biased = static_cast<int>((bits >> 52) & 0x7ff);
  int64_t m = static_cast<int64_t>(bits & 0xfffffffffffffULL);
  if (biased != 0) m |= int64_t{1} << 52;
  if (bits >> 63) m = -m;
  const int s = std::max(biased, 1) - 1075 - step_.exponent;
  Int128 value = static_cast<Int128>(m) * step_.denominator;
  const Int128 n = step_.numerator;
  // floor((4096 value 2^s + 2049 n) / (4096 n)); below 2^-u the fraction is cut, which floor allows
  // because 2049 n 2^u is whole.
  constexpr int kMostFraction = 60;
  int u = 0;
  value *= 4096;
  if (s >= 0) {
    value <<= s;  // |value / n| < 2^53 after this, as |x / step| < 2^41: no overflow
  } else {
    u = std::min(-s, kMostFraction);
    const int cut = -s - u;
    value = cut > 126 ? (value < 0 ? -1 : 0) : value >> cut;
  }
  value += (n * 2049) << u;
  if (n == 1) return static_cast<int64_t>(value >> (12 + u));
  const Int128 divisor = (n * 4096) << u;
  Int128 quotient = value / divisor;
  if (value % divisor < 0) --quotient;
  return static_cast<int64_t>(quotient);
}

GridStep nanometre_step(int g) { return reduced(1, 1000000, g); }

bool step_fits(const GridStep& step, double reach, double far) {
  const double mm = step.millimetres();
  return reach < mm * static_cast<double>(kGridLimit - kGridMargin) &&
         far < mm * static_cast<double>(kFarLimit - kGridMargin);
}

GridStep decimal_step(int tens) {
  int64_t fives = 1;
  for (int i = 0; i < std::abs(tens); ++i) fives *= 5;
  return reduced(tens > 0 ? fives : 1, tens > 0 ? 1 : fives, tens);
}

GridStep choose_step(double reach, double far) {
  if (!(reach > 0) && !(far > 0)) return nanometre_step(-6);
  // Below 10^-4 mm powers of two nm hold what decimals of a part there are; in the range of parts
  // that are made they double, elsewhere they grow eightfold (numerics.md).
  constexpr int kFinest = -300, kCoarsest = 900, kLastOfParts = 6;
  for (int g = kFinest; g <= kLastOfParts; g += g >= 3 ? 1 : 3) {
    if (step_fits(nanometre_step(g), reach, far)) return nanometre_step(g);
  }
  // What is larger is measured in whole millimetres, or tenths of them.
  constexpr int kFirstTens = -4, kLastTens = 22;  // 5^22 is below 2^53
  for (int tens = kFirstTens; tens <= kLastTens; ++tens) {
    if (step_fits(decimal_step(tens), reach, far)) return decimal_step(tens);
  }
  int g = 96;  // 2^96 nm are 8 10^22 mm
  while (g < kCoarsest && !step_fits(nanometre_step(g), reach, far)) g += 3;
  return nanometre_step(g);
}

}  // namespace csgrun

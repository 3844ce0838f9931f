// Trigonometry in degrees, correctly rounded and the same on every machine.
#include <cmath>

#include <fmt/format.h>

#include <csgrun/primitives/trig.h>

#include "lua_bindings/api.h"
#include "lua_bindings/guard.h"

namespace csgrun {
namespace {

constexpr Option kAngle[] = {{"a", ArgumentType::kNumber, "", "degrees", true}};
constexpr Option kRatio[] = {{"x", ArgumentType::kNumber, "", "ratio", true}};
constexpr Option kSides[] = {
    {"y", ArgumentType::kNumber, "", "opposite side", true},
    {"x", ArgumentType::kNumber, "", "adjacent side", true},
};

constexpr FunctionSpec kSin{"sin", "Sine of an angle in degrees.", kAngle, false, "sin(30)"},
    kSind{"sind", "The same as sin.", kAngle, false, "sind(30)"};
constexpr FunctionSpec kCos{"cos", "Cosine of an angle in degrees.", kAngle, false, "cos(60)"},
    kCosd{"cosd", "The same as cos.", kAngle, false, "cosd(60)"};
constexpr FunctionSpec kTan{"tan", "Tangent of an angle in degrees.", kAngle, false, "tan(45)"},
    kTand{"tand", "The same as tan.", kAngle, false, "tand(45)"};
constexpr FunctionSpec kAsin{"asin", "Arc sine in degrees.", kRatio, false, "asin(0.5)"},
    kAsind{"asind", "The same as asin.", kRatio, false, "asind(0.5)"};
constexpr FunctionSpec kAcos{"acos", "Arc cosine in degrees.", kRatio, false, "acos(0.5)"},
    kAcosd{"acosd", "The same as acos.", kRatio, false, "acosd(0.5)"};
constexpr FunctionSpec kAtan{"atan", "Arc tangent in degrees.", kRatio, false, "atan(1)"},
    kAtand{"atand", "The same as atan.", kRatio, false, "atand(1)"};
constexpr FunctionSpec kAtan2{"atan2", "Angle of the direction (x, y) in degrees.", kSides, false,
                              "atan2(1, -1)"},
    kAtan2d{"atan2d", "The same as atan2.", kSides, false, "atan2d(1, -1)"};

template <const FunctionSpec& Spec, double (*Function)(double), bool kUnitRange = false>
int of_one(lua_State* L) {
  const Arguments arguments(L, Spec, 1);
  const char* name = Spec.options[0].name;
  if (!arguments.has(name)) fail_in(Spec, "needs a number");
  const double x = arguments.number(name, 0);
  if (kUnitRange && std::abs(x) > 1)
    fail_in(Spec, fmt::format("the ratio must be from -1 to 1, got {:.14g}", x));
  lua_pushnumber(L, Function(x));
  return 1;
}

template <const FunctionSpec& Spec>
int of_two(lua_State* L) {
  const Arguments arguments(L, Spec, 1);
  if (!arguments.has("y") || !arguments.has("x")) fail_in(Spec, "needs two numbers, y and x");
  lua_pushnumber(L, atan2_deg(arguments.number("y", 0), arguments.number("x", 0)));
  return 1;
}

constexpr Binding kMathBindings[] = {
    {&kSin, guarded<of_one<kSin, sin_deg>>, nullptr, nullptr},
    {&kCos, guarded<of_one<kCos, cos_deg>>, nullptr, nullptr},
    {&kTan, guarded<of_one<kTan, tan_deg>>, nullptr, nullptr},
    {&kAsin, guarded<of_one<kAsin, asin_deg, true>>, nullptr, nullptr},
    {&kAcos, guarded<of_one<kAcos, acos_deg, true>>, nullptr, nullptr},
    {&kAtan, guarded<of_one<kAtan, atan_deg>>, nullptr, nullptr},
    {&kAtan2, guarded<of_two<kAtan2>>, nullptr, nullptr},
    {&kSind, guarded<of_one<kSind, sin_deg>>, nullptr, nullptr},
    {&kCosd, guarded<of_one<kCosd, cos_deg>>, nullptr, nullptr},
    {&kTand, guarded<of_one<kTand, tan_deg>>, nullptr, nullptr},
    {&kAsind, guarded<of_one<kAsind, asin_deg, true>>, nullptr, nullptr},
    {&kAcosd, guarded<of_one<kAcosd, acos_deg, true>>, nullptr, nullptr},
    {&kAtand, guarded<of_one<kAtand, atan_deg>>, nullptr, nullptr},
    {&kAtan2d, guarded<of_two<kAtan2d>>, nullptr, nullptr},
};

}  // namespace

std::span<const Binding> math_bindings() { return kMathBindings; }

}  // namespace csgrun

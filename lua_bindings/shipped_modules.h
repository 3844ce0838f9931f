// The library that the program carries in itself: modules in Lua, for require "csg.gears" and the
// like. Their texts stand in lua_bindings/library and are put into the program when it is built.
#pragma once

#include <span>
#include <string_view>

namespace csgrun {

struct ShippedModule {
  std::string_view name;  ///< "csg.gears"
  std::string_view text;
};

/// A module's file as messages and call sites name it: this and its name, "csgrun:csg.gears".
inline constexpr std::string_view kShippedPlace = "csgrun:";

/// All of them, by name.
std::span<const ShippedModule> shipped_modules();

}  // namespace csgrun

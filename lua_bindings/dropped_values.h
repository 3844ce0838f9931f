// Statements of a script that make a solid and drop it: OpenSCAD's `translate([0, 0, 5]) cube(10)`
// is two of them in Lua.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace csgrun {

struct DroppedValue {
  size_t line;           ///< from 1
  std::string message;   ///< what was dropped, and what to write
  size_t last_line;      ///< of the statement, which begins at `line`
  size_t function_line;  ///< where the function begins that it stands in; 0: in none
};

/// Those of a text that Lua accepts, in its order: calls of functions that only give a value
/// (`translate(...)`, `part:rotate(...)`), where a statement stands. Functions that the script
/// defines anew are its own. O(n).
std::vector<DroppedValue> find_dropped_values(std::string_view text);

}  // namespace csgrun

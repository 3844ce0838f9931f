// The bytes of the fonts that are part of the program.
#pragma once

#include <string_view>

namespace csgrun {

/// A face of Liberation Sans 2 (SIL Open Font License 1.1).
std::string_view shipped_font(bool bold, bool italic);

}  // namespace csgrun

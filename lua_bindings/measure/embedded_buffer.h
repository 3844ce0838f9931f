// The data that a glTF file carries within its JSON.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace csgrun {

/// The bytes of a "data:...;base64,..." address; nothing when it is none, or is malformed.
std::optional<std::string> decode_data_address(std::string_view address);

}  // namespace csgrun

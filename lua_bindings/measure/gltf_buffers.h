// The bytes that a glTF file refers to.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/error.h>

#include "lua_bindings/measure/json_place.h"

namespace csgrun {

/// The buffers of a document, in their order: of a GLB the first may be its `binary`, others are in
/// the JSON as base64, or files that `open` reads, if there is one. One without an address is
/// empty. Throws Malformed, also for an address of a buffer or a picture that leads out of the
/// file's folder: a file that asks for it is told apart from one that is merely without textures.
std::vector<std::string> read_buffers(
    const JsonPlace& root, std::string_view binary,
    const std::function<Result<std::string>(const std::string&)>& open);

}  // namespace csgrun

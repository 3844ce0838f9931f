// The bytes that a glTF file refers to.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/error.h>

#include "lua_bindings/measure/json_place.h"

namespace csgrun {

/// The buffers of a document that its accessors reach, in their order; others are empty: of a GLB
/// the first may be its `binary`, others are in the JSON as base64, or files that `open` reads, if
/// there is one, each once. One without an address is empty. Throws Malformed, also for an address
/// of any buffer that leads out of the file's folder, and for files of more than 1 GiB together.
/// Pictures are not read: where they are does not matter.
class GltfBuffers {
 public:
  GltfBuffers(const JsonPlace& root, std::string_view binary,
              const std::function<Result<std::string>(const std::string&)>& open);
  GltfBuffers(const GltfBuffers&) = delete;
  GltfBuffers& operator=(const GltfBuffers&) = delete;

  [[nodiscard]] const std::vector<std::string_view>& bytes() const { return bytes_; }

 private:
  std::map<std::string, std::string> by_address_;  ///< with "./" and "a/.." taken out
  std::deque<std::string> embedded_;
  std::vector<std::string_view> bytes_;
};

}  // namespace csgrun

#include "lua_bindings/measure/gltf_buffers.h"

#include <filesystem>
#include <utility>

#include <csgrun/primitives/file_path.h>

#include "lua_bindings/measure/embedded_buffer.h"

namespace csgrun {
namespace {

constexpr size_t kMostBytes = size_t{1} << 30;  // of all files together

int hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// An address with what "%20" and the like stand for.
std::string decoded(std::string_view address) {
  std::string path;
  for (size_t i = 0; i < address.size(); ++i) {
    const bool is_code = address[i] == '%' && i + 2 < address.size() &&
                         hexadecimal(address[i + 1]) >= 0 && hexadecimal(address[i + 2]) >= 0;
    path += is_code
                ? static_cast<char>(hexadecimal(address[i + 1]) * 16 + hexadecimal(address[i + 2]))
                : address[i];
    if (is_code) i += 2;
  }
  return path;
}

Malformed outside(const JsonPlace& entry, const std::string& address, const char* why) {
  return {entry.name() + " is at \"" + address.substr(0, 60) + "\", outside of the file" + why};
}

/// By buffer: whether an accessor reaches it, through its view or those of its sparse part.
std::vector<bool> reached_buffers(const JsonPlace& root, size_t count) {
  std::vector<bool> reached(count, false);
  if (!root.has("accessors") || !root.has("bufferViews")) return reached;
  const JsonPlace accessors = root.at("accessors"), views = root.at("bufferViews");
  const auto reach = [&](const JsonPlace& owner) {
    if (!owner.has("bufferView")) return;
    const size_t view = owner.at("bufferView").whole();
    if (view >= views.size()) return;  // told when it is read
    const size_t buffer = views.at(view).whole("buffer", count);
    if (buffer < count) reached[buffer] = true;
  };
  for (size_t a = 0; a < accessors.size(); ++a) {
    const JsonPlace accessor = accessors.at(a);
    reach(accessor);
    if (!accessor.has("sparse")) continue;
    for (const char* list : {"indices", "values"}) {
      if (accessor.at("sparse").has(list)) reach(accessor.at("sparse").at(list));
    }
  }
  return reached;
}

}  // namespace

GltfBuffers::GltfBuffers(const JsonPlace& root, std::string_view binary,
                         const std::function<Result<std::string>(const std::string&)>& open) {
  if (!root.has("buffers")) return;
  const JsonPlace buffers = root.at("buffers");
  const std::vector<bool> reached = reached_buffers(root, buffers.size());
  size_t total = 0;
  for (size_t i = 0; i < buffers.size(); ++i) {
    const JsonPlace buffer = buffers.at(i);
    const std::string address = buffer.text("uri", "");
    const bool is_file = !address.empty() && !address.starts_with("data:");
    const std::string path = is_file ? decoded(address) : "";
    if (is_file && leads_out_of_folder(path)) throw outside(buffer, address, "'s folder");
    bytes_.emplace_back();
    if (!reached[i]) continue;
    if (address.empty()) {
      if (i == 0) bytes_.back() = binary;
    } else if (!is_file) {
      auto data = decode_data_address(address);
      if (!data) throw Malformed{buffer.name() + " has an address that is no base64"};
      bytes_.back() = embedded_.emplace_back(*std::move(data));
    } else {
      if (!open) throw outside(buffer, address, ": only data in the file itself is read");
      const std::string key = std::filesystem::path(path).lexically_normal().string();
      auto known = by_address_.find(key);
      if (known == by_address_.end()) {
        auto data = open(path);
        if (!data) throw Malformed{buffer.name() + ": " + data.error().message};
        total += data->size();
        if (total > kMostBytes)
          throw Malformed{"its buffers are more than " + std::to_string(kMostBytes) + " bytes"};
        known = by_address_.emplace(key, *std::move(data)).first;
      }
      bytes_.back() = known->second;
    }
    // A GLB's chunk is padded. Without any data it is told where somebody asks for them.
    std::string_view& bytes = bytes_.back();
    const size_t length = buffer.whole("byteLength", bytes.size());
    if (!bytes.empty() && length > bytes.size()) {
      throw Malformed{buffer.name() + " has " + std::to_string(bytes.size()) +
                      " bytes, and byteLength says " + std::to_string(length)};
    }
    bytes = bytes.substr(0, length);
  }
}

}  // namespace csgrun

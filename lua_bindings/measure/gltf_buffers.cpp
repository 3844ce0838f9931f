#include "lua_bindings/measure/gltf_buffers.h"

#include <optional>
#include <utility>

#include "lua_bindings/measure/embedded_buffer.h"

namespace csgrun {
namespace {

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

bool leads_out(const std::string& path) {
  return path.find("..") != std::string::npos || path.find(':') != std::string::npos ||
         path.find('\\') != std::string::npos || path.find('\0') != std::string::npos ||
         path.starts_with('/');
}

Malformed outside(const JsonPlace& entry, const std::string& address, const char* why) {
  return {entry.name() + " is at \"" + address.substr(0, 60) + "\", outside of the file" + why};
}

}  // namespace

std::vector<std::string> read_buffers(
    const JsonPlace& root, std::string_view binary,
    const std::function<Result<std::string>(const std::string&)>& open) {
  for (const char* list : {"buffers", "images"}) {
    if (!root.has(list)) continue;
    const JsonPlace entries = root.at(list);
    for (size_t i = 0; i < entries.size(); ++i) {
      const std::string address = entries.at(i).text("uri", "");
      if (!address.starts_with("data:") && leads_out(decoded(address)))
        throw outside(entries.at(i), address, "'s folder");
    }
  }
  std::vector<std::string> result;
  if (!root.has("buffers")) return result;
  const JsonPlace buffers = root.at("buffers");
  for (size_t i = 0; i < buffers.size(); ++i) {
    const JsonPlace buffer = buffers.at(i);
    const std::string address = buffer.text("uri", "");
    if (address.empty()) {
      result.emplace_back(i == 0 ? binary : std::string_view());
    } else if (address.starts_with("data:")) {
      auto data = decode_data_address(address);
      if (!data) throw Malformed{buffer.name() + " has an address that is no base64"};
      result.push_back(*std::move(data));
    } else {
      if (!open) throw outside(buffer, address, ": only data in the file itself is read");
      auto data = open(decoded(address));
      if (!data) throw Malformed{buffer.name() + ": " + data.error().message};
      result.push_back(*std::move(data));
    }
  }
  return result;
}

}  // namespace csgrun

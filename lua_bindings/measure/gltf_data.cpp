#include "lua_bindings/measure/gltf_data.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

namespace csgrun {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF is read as it lies in memory");

constexpr size_t kSignedByte = 5120, kByte = 5121, kSignedShort = 5122, kShort = 5123, kInt = 5125,
                 kFloat = 5126;

template <class Number>
double number_at(const char* data) {
  Number number;
  std::memcpy(&number, data, sizeof number);
  return number;
}

/// How a component of a position is stored.
struct Component {
  size_t size;
  double (*read)(const char*);
  double full;  ///< what stands for 1 where integers are fractions
};

std::optional<Component> component_of(size_t type) {
  switch (type) {
    case kSignedByte:
      return Component{1, number_at<int8_t>, 127};
    case kByte:
      return Component{1, number_at<uint8_t>, 255};
    case kSignedShort:
      return Component{2, number_at<int16_t>, 32767};
    case kShort:
      return Component{2, number_at<uint16_t>, 65535};
    case kFloat:
      return Component{4, number_at<float>, 1};
    default:
      return std::nullopt;
  }
}

}  // namespace

/// `count` elements of a buffer view, from a byte on that `owner` names.
GltfData::Elements GltfData::elements(const JsonPlace& owner, size_t count, size_t size) const {
  const JsonPlace view = root_.at("bufferViews").at(owner.at("bufferView").whole());
  for (const char* compression : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (view.has("extensions") && view.at("extensions").has(compression)) {
      throw Malformed{std::string("its meshes are compressed (") + compression +
                      "), which is not read: write it without"};
    }
  }
  const size_t buffer = view.at("buffer").whole();
  if (buffer >= buffers_.size()) throw Malformed{view.name() + " has a buffer that is not there"};
  std::string_view bytes = buffers_[buffer];
  if (bytes.empty() && count > 0)
    throw Malformed{"buffers[" + std::to_string(buffer) +
                    "] has no data in the file, nor an address"};
  const size_t stride = view.whole("byteStride", size);
  const size_t offset = view.whole("byteOffset", 0), more = owner.whole("byteOffset", 0);
  const size_t length = view.at("byteLength").whole();
  if (offset > bytes.size() || length > bytes.size() - offset)
    throw Malformed{view.name() + " reaches beyond the end of the data"};
  // What is beyond a view belongs to others.
  bytes = bytes.substr(offset, length);
  if (stride < size || more > bytes.size() ||
      (count > 0 &&
       (size > bytes.size() - more || (count - 1) > (bytes.size() - more - size) / stride))) {
    throw Malformed{owner.name() + " reaches beyond the end of its view"};
  }
  return {bytes.data() + more, count, stride};
}

size_t GltfData::size() const {
  size_t bytes = 0;
  for (const std::string_view buffer : buffers_) bytes += buffer.size();
  return bytes;
}

/// An accessor without data is zeros: no more of them than there are bytes in all.
void GltfData::refuse_endless_zeros(const JsonPlace& accessor, size_t count) const {
  if (count > size()) throw Malformed{accessor.name() + " has no data, and no end"};
}

void GltfData::read_positions(const JsonPlace& owner, const JsonPlace& typed, size_t count,
                              const std::vector<uint32_t>* wanted,
                              std::vector<glm::dvec3>& points) const {
  const auto component = component_of(typed.at("componentType").whole());
  if (!component || typed.at("type").text() != "VEC3") {
    throw Malformed{typed.name() +
                    ": positions must be three floats, or integers of one or two "
                    "bytes"};
  }
  const bool are_fractions = typed.truth("normalized", false);
  const Elements values = elements(owner, count, 3 * component->size);
  const size_t number_of_points = wanted == nullptr ? count : wanted->size();
  points.reserve(number_of_points);
  for (size_t n = 0; n < number_of_points; ++n) {
    const size_t i = wanted == nullptr ? n : (*wanted)[n];
    glm::dvec3 p;
    for (int axis = 0; axis < 3; ++axis) {
      const size_t place = i * values.stride + static_cast<size_t>(axis) * component->size;
      const double number = component->read(values.data + place);
      p[axis] = are_fractions ? std::max(number / component->full, -1.0) : number + 0.0;
      if (!std::isfinite(number)) throw Malformed{"a position is not finite"};
    }
    points.push_back(p);
  }
}

std::vector<glm::dvec3> GltfData::positions(const JsonPlace& accessor) const {
  const size_t count = accessor.at("count").whole();
  std::vector<glm::dvec3> points;
  if (accessor.has("bufferView")) {
    read_positions(accessor, accessor, count, nullptr, points);
  } else {
    refuse_endless_zeros(accessor, count);
    points.assign(count, glm::dvec3(0));
  }
  if (!accessor.has("sparse")) return points;
  const JsonPlace sparse = accessor.at("sparse");
  const size_t changed = sparse.at("count").whole();
  const std::vector<uint32_t> at =
      read_integers(sparse.at("indices"), sparse.at("indices"), changed);
  std::vector<glm::dvec3> to;
  read_positions(sparse.at("values"), accessor, changed, nullptr, to);
  for (size_t i = 0; i < changed; ++i) {
    if (at[i] >= count) throw Malformed{sparse.name() + ": an index is out of range"};
    points[at[i]] = to[i];
  }
  return points;
}

std::vector<glm::dvec3> GltfData::positions(const JsonPlace& accessor,
                                            const std::vector<uint32_t>& wanted) const {
  std::vector<glm::dvec3> points;
  if (accessor.has("bufferView") && !accessor.has("sparse")) {
    read_positions(accessor, accessor, count_of(accessor), &wanted, points);
    return points;
  }
  const std::vector<glm::dvec3> all = positions(accessor);
  for (const uint32_t i : wanted) points.push_back(all[i]);
  return points;
}

/// Unsigned integers, as `owner` describes them; their type stands with `typed`.
std::vector<uint32_t> GltfData::read_integers(const JsonPlace& owner, const JsonPlace& typed,
                                              size_t count) const {
  const size_t type = typed.at("componentType").whole();
  const size_t size = type == kByte ? 1 : type == kShort ? 2 : type == kInt ? 4 : 0;
  if (size == 0) throw Malformed{typed.name() + ": indices must be unsigned integers"};
  const Elements values = elements(owner, count, size);
  std::vector<uint32_t> integers(count);
  for (size_t i = 0; i < count; ++i)
    std::memcpy(&integers[i], values.data + i * values.stride, size);
  return integers;
}

std::vector<uint32_t> GltfData::indices(const JsonPlace& accessor) const {
  const size_t count = accessor.at("count").whole();
  std::vector<uint32_t> indices;
  if (accessor.has("bufferView") || !accessor.has("sparse")) {
    indices = read_integers(accessor, accessor, count);
  } else {
    refuse_endless_zeros(accessor, count);
    indices.assign(count, 0);
  }
  if (!accessor.has("sparse")) return indices;
  const JsonPlace sparse = accessor.at("sparse");
  const size_t changed = sparse.at("count").whole();
  const std::vector<uint32_t> at =
      read_integers(sparse.at("indices"), sparse.at("indices"), changed);
  const std::vector<uint32_t> to = read_integers(sparse.at("values"), accessor, changed);
  for (size_t i = 0; i < changed; ++i) {
    if (at[i] >= indices.size()) throw Malformed{sparse.name() + ": an index is out of range"};
    indices[at[i]] = to[i];
  }
  return indices;
}

}  // namespace csgrun

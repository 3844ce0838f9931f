#include "lua_bindings/measure/read_glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "lua_bindings/measure/embedded_buffer.h"

namespace csgrun {
namespace {

static_assert(std::endian::native == std::endian::little, "GLB is read as it lies in memory");

using Json = nlohmann::json;

// Khronos glTF 2.0, section 4.4 (GLB) and 3.6 (accessors).
constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr size_t kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126;
constexpr size_t kTriangles = 4;
constexpr size_t kLongestName = 4096;

/// Not a GLB, or one that is made wrongly.
struct Malformed {
  std::string what;
};

uint32_t read_word(std::string_view bytes, size_t at) {
  if (at + 4 > bytes.size()) throw Malformed{"the file is truncated"};
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// An index or a count. The library would cast anything.
size_t whole(const Json& value) {
  if (!value.is_number_unsigned()) throw Malformed{"an index or a count is no whole number"};
  return value.get<size_t>();
}

size_t whole(const Json& object, const char* key, size_t otherwise) {
  const auto found = object.find(key);
  return found == object.end() ? otherwise : whole(*found);
}

std::vector<size_t> indices_in(const Json& object, const char* key) {
  std::vector<size_t> indices;
  if (const auto found = object.find(key); found != object.end()) {
    for (const Json& index : *found) indices.push_back(whole(index));
  }
  return indices;
}

class Reader {
 public:
  Reader(Json json, std::string_view binary) : json_(std::move(json)), binary_(binary) {}

  /// The meshes of all nodes where the nodes put them, in the order of the nodes. A node's name is
  /// that of its groups and its own, as in "legs/left".
  std::vector<TriangleMesh> meshes() const {
    std::vector<TriangleMesh> result;
    if (!json_.contains("nodes")) return result;
    const Json& nodes = json_.at("nodes");
    const auto is_object = [](const Json& node) { return node.is_object(); };
    if (!nodes.is_array() || !std::all_of(nodes.begin(), nodes.end(), is_object)) {
      throw Malformed{"its nodes are no list of objects"};
    }
    const std::vector<Place> places = places_of(nodes);
    for (size_t n = 0; n < nodes.size(); ++n) {
      if (!places[n].is_reached || !nodes[n].contains("mesh")) continue;
      const Json& mesh = json_.at("meshes").at(whole(nodes[n].at("mesh")));
      TriangleMesh triangles;
      triangles.name = places[n].name.empty() ? mesh.value("name", "mesh") : places[n].name;
      for (const Json& primitive : mesh.at("primitives")) add_primitive(primitive, triangles);
      put(triangles, places[n].map);
      weld(triangles);
      result.push_back(std::move(triangles));
    }
    return result;
  }

 private:
  /// Where a node stands and what it is called there.
  struct Place {
    bool is_reached = false;
    glm::dmat4 map{1};
    std::string name;
  };

  /// From the roots down. The only root, if it is no part itself, is the file's frame around its
  /// parts, which turns and scales to glTF's axes and units: lengths stay those of the meshes.
  std::vector<Place> places_of(const Json& nodes) const {
    std::vector<Place> places(nodes.size());
    std::vector<size_t> stack = roots_of(nodes);
    for (const size_t root : stack) {
      Place& place = places.at(root);
      place.is_reached = true;
      if (stack.size() == 1 && !nodes[root].contains("mesh")) continue;
      place.map = map_of(nodes[root]);
      place.name = nodes[root].value("name", "");
    }
    while (!stack.empty()) {
      const size_t parent = stack.back();
      stack.pop_back();
      for (const size_t child : indices_in(nodes[parent], "children")) {
        Place& place = places.at(child);
        if (place.is_reached) throw Malformed{"a node has two parents"};
        place.is_reached = true;
        place.map = places[parent].map * map_of(nodes[child]);
        place.name = places[parent].name;
        const std::string own = nodes[child].value("name", "");
        if (!place.name.empty() && !own.empty()) place.name += '/';
        place.name += own;
        // In a chain of nodes, the names together take the square of what the file does.
        if (place.name.size() > kLongestName)
          throw Malformed{"the name of a node and its groups is longer than 4096 bytes"};
        stack.push_back(child);
      }
    }
    return places;
  }

  std::vector<size_t> roots_of(const Json& nodes) const {
    if (json_.contains("scenes")) {
      const Json& scene = json_.at("scenes").at(whole(json_, "scene", 0));
      return indices_in(scene, "nodes");
    }
    std::vector<bool> is_child(nodes.size(), false);
    for (const Json& node : nodes) {
      for (const size_t c : indices_in(node, "children")) is_child.at(c) = true;
    }
    std::vector<size_t> roots;
    for (size_t n = 0; n < nodes.size(); ++n) {
      if (!is_child[n]) roots.push_back(n);
    }
    return roots;
  }

  static glm::dmat4 map_of(const Json& node) {
    using Numbers = std::vector<double>;
    const auto numbers = [&](const char* key, size_t count, Numbers otherwise) {
      Numbers found = node.value(key, std::move(otherwise));
      if (found.size() != count) throw Malformed{std::string("a node's ") + key + " is malformed"};
      return found;
    };
    if (node.contains("matrix")) return glm::make_mat4(numbers("matrix", 16, {}).data());
    const Numbers t = numbers("translation", 3, {0, 0, 0});
    const Numbers r = numbers("rotation", 4, {0, 0, 0, 1});
    const Numbers s = numbers("scale", 3, {1, 1, 1});
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), {t[0], t[1], t[2]});
    return glm::scale(moved * glm::mat4_cast(glm::dquat(r[3], r[0], r[1], r[2])),
                      {s[0], s[1], s[2]});
  }

  static void put(TriangleMesh& mesh, const glm::dmat4& map) {
    if (map == glm::dmat4(1)) return;
    for (glm::dvec3& p : mesh.points) {
      p = glm::dvec3(map * glm::dvec4(p, 1)) + 0.0;
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Malformed{"a node puts its mesh at no finite place"};
    }
    if (glm::determinant(glm::dmat3(map)) >= 0) return;
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }

  /// The bytes of an accessor's elements, each of `size`, `stride` apart.
  struct Elements {
    const char* data;
    size_t count, stride;
  };

  Elements elements(const Json& accessor, size_t size) const {
    if (accessor.contains("sparse")) throw Malformed{"sparse accessors are not read"};
    const size_t count = whole(accessor.at("count"));
    const Json& view = json_.at("bufferViews").at(whole(accessor.at("bufferView")));
    if (whole(view.at("buffer")) != 0) throw Malformed{"there is data outside of the file"};
    const size_t stride = whole(view, "byteStride", size);
    const size_t start = whole(view, "byteOffset", 0) + whole(accessor, "byteOffset", 0);
    if (stride < size || start > binary_.size() ||
        (count > 0 && (size > binary_.size() - start ||
                       (count - 1) > (binary_.size() - start - size) / stride))) {
      throw Malformed{"an accessor reaches beyond the end of the data"};
    }
    return {binary_.data() + start, count, stride};
  }

  void add_primitive(const Json& primitive, TriangleMesh& mesh) const {
    if (whole(primitive, "mode", kTriangles) != kTriangles)
      throw Malformed{"only triangles are read, no strips, fans, lines or points"};
    const Json& accessors = json_.at("accessors");
    const Json& positions = accessors.at(whole(primitive.at("attributes").at("POSITION")));
    if (whole(positions.at("componentType")) != kFloat ||
        positions.at("type").get<std::string>() != "VEC3") {
      throw Malformed{"positions must be three floats"};
    }
    const auto first = static_cast<uint32_t>(mesh.points.size());
    const Elements points = elements(positions, 12);
    for (size_t i = 0; i < points.count; ++i) {
      float p[3];
      std::memcpy(p, points.data + i * points.stride, sizeof p);
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        throw Malformed{"a position is not finite"};
      mesh.points.emplace_back(p[0] + 0.0, p[1] + 0.0, p[2] + 0.0);
    }
    std::vector<uint32_t> indices;
    if (primitive.contains("indices")) {
      indices = read_indices(accessors.at(whole(primitive.at("indices"))));
    } else {
      for (uint32_t i = 0; i < points.count; ++i) indices.push_back(i);
    }
    if (indices.size() % 3 != 0) throw Malformed{"the number of indices is no multiple of three"};
    for (size_t i = 0; i < indices.size(); i += 3) {
      for (size_t k = i; k < i + 3; ++k) {
        if (indices[k] >= points.count) throw Malformed{"an index is out of range"};
      }
      mesh.triangles.push_back(
          {first + indices[i], first + indices[i + 1], first + indices[i + 2]});
    }
  }

  std::vector<uint32_t> read_indices(const Json& accessor) const {
    const size_t type = whole(accessor.at("componentType"));
    const size_t size = type == kByte ? 1 : type == kShort ? 2 : type == kInt ? 4 : 0;
    if (size == 0) throw Malformed{"indices must be unsigned integers"};
    const Elements values = elements(accessor, size);
    std::vector<uint32_t> indices(values.count);
    for (size_t i = 0; i < values.count; ++i)
      std::memcpy(&indices[i], values.data + i * values.stride, size);
    return indices;
  }

  Json json_;
  std::string_view binary_;
};

/// A file of JSON alone, whose only buffer is in it.
std::vector<TriangleMesh> read_text(std::string_view text) {
  Json json = Json::parse(text);
  std::string binary;
  if (json.contains("buffers")) {
    const Json& buffers = json.at("buffers");
    if (buffers.size() > 1) throw Malformed{"only one buffer is read"};
    if (!buffers.empty()) {
      auto data = decode_data_address(buffers.at(0).value("uri", ""));
      if (!data) throw Malformed{"its buffer is not in the file itself, as base64"};
      binary = *std::move(data);
    }
  }
  return Reader(std::move(json), binary).meshes();
}

std::vector<TriangleMesh> read(std::string_view bytes) {
  const size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start != std::string_view::npos && bytes[start] == '{') return read_text(bytes);
  if (read_word(bytes, 0) != kMagic) throw Malformed{"this is not a GLB file"};
  if (read_word(bytes, 4) != 2) throw Malformed{"only version 2 of GLB is read"};
  if (read_word(bytes, 8) != bytes.size()) throw Malformed{"the file is not as long as it says"};
  const size_t json_size = read_word(bytes, 12);
  if (read_word(bytes, 16) != kJsonChunk || json_size > bytes.size() - 20)
    throw Malformed{"the first chunk must be JSON"};
  const std::string_view text = bytes.substr(20, json_size);
  std::string_view binary;
  if (const size_t at = 20 + json_size; at < bytes.size()) {
    const size_t size = read_word(bytes, at);
    if (read_word(bytes, at + 4) != kBinaryChunk || size > bytes.size() - at - 8)
      throw Malformed{"the second chunk must be binary"};
    binary = bytes.substr(at + 8, size);
  }
  return Reader(Json::parse(text), binary).meshes();
}

}  // namespace

Result<std::vector<TriangleMesh>> parse_glb(const std::string& name, std::string_view bytes) {
  try {
    return read(bytes);
  } catch (const Malformed& problem) {
    return Error{ErrorCode::kMalformedFile, name + ": " + problem.what, {}};
  } catch (const std::out_of_range&) {
    return Error{ErrorCode::kMalformedFile, name + ": it names a node that is not there", {}};
  } catch (const Json::exception& problem) {
    return Error{ErrorCode::kMalformedFile, name + ": " + problem.what(), {}};
  }
}

}  // namespace csgrun

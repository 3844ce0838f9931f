#include "lua_bindings/measure/read_glb.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <tuple>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include <csgrun/primitives/model_file.h>

#include "lua_bindings/measure/gltf_buffers.h"
#include "lua_bindings/measure/gltf_data.h"
#include "lua_bindings/measure/json_place.h"

namespace csgrun {
namespace {

static_assert(std::endian::native == std::endian::little, "GLB is read as it lies in memory");

using Json = nlohmann::json;

// Khronos glTF 2.0, section 4.4 (GLB) and 3.7.2.1 (meshes).
constexpr uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
constexpr size_t kTriangles = 4, kFan = 6;  // 5 is a strip
constexpr size_t kLongestName = 4096;
constexpr uint64_t kManyCorners = 15'000'000, kMostCopies = 100, kEndless = uint64_t{1} << 40;
constexpr const char* kManifold = "EXT_mesh_manifold";
constexpr const char* kInstancing = "EXT_mesh_gpu_instancing";
/// What is read, what says nothing of shapes, and what is refused with a word of its own.
constexpr std::string_view kExtensions[] = {kManifold,
                                            "KHR_mesh_quantization",
                                            "KHR_draco_mesh_compression",
                                            "EXT_meshopt_compression",
                                            "KHR_meshopt_compression",
                                            "KHR_lights_punctual",
                                            "KHR_animation_pointer",
                                            "KHR_xmp_json_ld"};

/// Which number an appearance has in a mesh that is being made.
struct AppearanceLess {
  bool operator()(const Appearance& a, const Appearance& b) const {
    const auto key = [](const Appearance& x) {
      return std::tie(x.red, x.green, x.blue, x.alpha, x.metallic, x.roughness, x.name,
                      x.is_default);
    };
    return key(a) < key(b);
  }
};
using LookNumbers = std::map<Appearance, uint32_t, AppearanceLess>;

uint32_t read_word(std::string_view bytes, size_t at) {
  if (at + 4 > bytes.size()) {
    throw Malformed{"the file ends after " + std::to_string(bytes.size()) +
                    " bytes, in a number at " + std::to_string(at)};
  }
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// The points that triangles use, in their order, and nothing else.
void drop_unused_points(TriangleMesh& mesh) {
  std::vector<uint32_t> number(mesh.points.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (const uint32_t corner : triangle) number[corner] = 1;
  }
  uint32_t kept = 0;
  for (size_t p = 0; p < number.size(); ++p) {
    if (number[p] == 0) continue;
    mesh.points[kept] = mesh.points[p];
    number[p] = kept++;
  }
  mesh.points.resize(kept);
  for (auto& triangle : mesh.triangles) {
    for (uint32_t& corner : triangle) corner = number[corner];
  }
}

/// Whether two meshes have the same triangles in the same places.
bool same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
  return std::equal(a.triangles.begin(), a.triangles.end(), b.triangles.begin(), b.triangles.end(),
                    [&](const auto& s, const auto& t) {
                      for (size_t k = 0; k < 3; ++k) {
                        if (a.points[s[k]] != b.points[t[k]]) return false;
                      }
                      return true;
                    });
}

class Reader {
 public:
  /// `binary` is the data that follows the JSON in a GLB.
  Reader(Json json, std::string_view binary, const GltfOptions& options)
      : json_(std::move(json)),
        options_(options),
        buffers_(root(), binary, options.open),
        data_(root(), buffers_.bytes()) {
    refuse_required_extensions();
    read_materials();
  }

  /// The meshes of all nodes where the nodes put them, in the order of the nodes. A node's name is
  /// that of its groups and its own, as in "legs/left".
  std::vector<TriangleMesh> meshes() {
    std::vector<TriangleMesh> result;
    if (!root().has("nodes")) return result;
    const JsonPlace nodes = root().at("nodes");
    const std::vector<Place> places = places_of(nodes);
    refuse_many_copies(nodes, places);
    for (size_t n = 0; n < nodes.size(); ++n) {
      if (!places[n].is_reached || !nodes.at(n).has("mesh")) continue;
      const JsonPlace mesh = root().at("meshes").at(nodes.at(n).at("mesh").whole());
      note_what_is_passed_over(nodes.at(n), mesh);
      TriangleMesh triangles = triangles_of(mesh);
      triangles.name = places[n].name.empty() ? mesh.text("name", "mesh") : places[n].name;
      put(triangles, places[n].map);
      result.push_back(std::move(triangles));
    }
    if (left_out_ > 0 && options_.notes != nullptr) {
      options_.notes->push_back("points and lines are left out: " + std::to_string(left_out_) +
                                (left_out_ == 1 ? " primitive" : " primitives"));
    }
    for (const auto& [what, count] : passed_over_) {
      if (options_.notes != nullptr)
        options_.notes->push_back(what + " (" + std::to_string(count) +
                                  (count == 1 ? " node)" : " nodes)"));
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

  [[nodiscard]] JsonPlace root() const { return {json_, ""}; }

  /// A document says without which extensions it is another one. What is packed is told apart where
  /// a mesh is.
  void refuse_required_extensions() const {
    if (!root().has("extensionsRequired")) return;
    const JsonPlace names = root().at("extensionsRequired");
    for (size_t i = 0; i < names.size(); ++i) {
      const std::string name = names.at(i).text();
      const bool is_look =
          name.starts_with("KHR_materials_") || name.find("_texture_") != std::string::npos;
      if (!is_look &&
          std::find(std::begin(kExtensions), std::end(kExtensions), name) == std::end(kExtensions))
        throw Malformed{"it needs the extension \"" + name.substr(0, 60) + "\", which is not read"};
    }
  }

  /// What would change the shape, and is told.
  void note_what_is_passed_over(const JsonPlace& node, const JsonPlace& mesh) {
    if (node.has("extensions") && node.at("extensions").has(kInstancing))
      ++passed_over_[std::string("instances are left out, their mesh stands once: ") + kInstancing];
    if (node.has("skin")) ++passed_over_["skins are passed over, their meshes are not bent"];
    const JsonPlace& weighted = node.has("weights") ? node : mesh;
    bool is_bent = false;
    for (size_t i = 0; weighted.has("weights") && i < weighted.at("weights").size(); ++i)
      is_bent = is_bent || weighted.at("weights").at(i).number() != 0;
    if (is_bent) ++passed_over_["weights of morph targets are passed over"];
  }

  /// How many corners the triangles of a mesh have, of its accessors' word.
  uint64_t weight_of(const JsonPlace& mesh) const {
    uint64_t sum = 0;
    const JsonPlace primitives = mesh.at("primitives");
    for (size_t p = 0; p < primitives.size(); ++p) {
      const JsonPlace primitive = primitives.at(p);
      if (!primitive.has("indices") &&
          !(primitive.has("attributes") && primitive.at("attributes").has("POSITION")))
        continue;
      const JsonPlace number = primitive.has("indices") ? primitive.at("indices")
                                                        : primitive.at("attributes").at("POSITION");
      const uint64_t count = GltfData::count_of(root().at("accessors").at(number.whole()));
      sum = std::min(sum + std::min(count, kEndless), kEndless);
    }
    return sum;
  }

  /// Nodes multiply meshes: what they come to is counted before any is made.
  void refuse_many_copies(const JsonPlace& nodes, const std::vector<Place>& places) const {
    std::map<size_t, uint64_t> weights;
    uint64_t own = nodes.size(), all = 0;
    for (size_t n = 0; n < nodes.size(); ++n) {
      if (!places[n].is_reached || !nodes.at(n).has("mesh")) continue;
      const size_t mesh = nodes.at(n).at("mesh").whole();
      const auto [known, is_new] = weights.emplace(mesh, 0);
      if (is_new) {
        known->second = weight_of(root().at("meshes").at(mesh));
        own += known->second;
      }
      all = std::min(all + known->second, kEndless);
    }
    if (all > kManyCorners && all / kMostCopies > own) refuse_copies();
  }

  [[noreturn]] static void refuse_copies() {
    throw Malformed{"its nodes and primitives multiply to more than a model would"};
  }

  /// sRGB of a linear component, in the bytes that it was very likely made of.
  static float srgb_from_linear(double c) {
    c = std::clamp(c, 0.0, 1.0);
    const double s = c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
    const double byte = std::round(s * 255);
    if (std::abs(s * 255 - byte) < 0.01) return static_cast<float>(byte) / 255.0F;
    return static_cast<float>(std::round(s * 1e6) / 1e6);
  }

  void read_materials() {
    if (!root().has("materials")) return;
    const JsonPlace materials = root().at("materials");
    for (size_t m = 0; m < materials.size(); ++m) {
      Appearance look;
      look.is_default = false;
      look.metallic = look.roughness = 1;  // glTF's own defaults
      std::vector<double> color{1, 1, 1, 1}, metallic{1}, roughness{1};
      if (materials.at(m).has("pbrMetallicRoughness")) {
        const JsonPlace pbr = materials.at(m).at("pbrMetallicRoughness");
        color = pbr.numbers("baseColorFactor", color);
        if (pbr.has("metallicFactor")) metallic[0] = pbr.at("metallicFactor").number();
        if (pbr.has("roughnessFactor")) roughness[0] = pbr.at("roughnessFactor").number();
      }
      look.red = srgb_from_linear(color[0]);
      look.green = srgb_from_linear(color[1]);
      look.blue = srgb_from_linear(color[2]);
      // What is opaque has an alpha that says nothing (Khronos glTF 2.0, section 3.9.4).
      const bool is_opaque = materials.at(m).text("alphaMode", "OPAQUE") == "OPAQUE";
      look.alpha = is_opaque ? 1.0F : static_cast<float>(std::clamp(color[3], 0.0, 1.0));
      look.metallic = static_cast<float>(std::clamp(metallic[0], 0.0, 1.0));
      look.roughness = static_cast<float>(std::clamp(roughness[0], 0.0, 1.0));
      const std::string name = materials.at(m).text("name", "");
      if (!name.starts_with('#')) look.name = name;
      if (is_named_default(look)) look = Appearance{};
      materials_.push_back(std::move(look));
    }
  }

  /// What takes glTF's metres, Y up, to millimetres, Z up.
  static glm::dmat4 to_millimetres() {
    return {glm::dvec4(1000, 0, 0, 0), glm::dvec4(0, 0, 1000, 0), glm::dvec4(0, -1000, 0, 0),
            glm::dvec4(0, 0, 0, 1)};
  }

  /// The map of a root with the change of axes and units: exactly nothing, where the root says just
  /// these in the digits that a file has.
  static glm::dmat4 without_noise(const glm::dmat4& map) {
    for (int c = 0; c < 4; ++c) {
      for (int r = 0; r < 4; ++r) {
        if (std::abs(map[c][r] - (c == r ? 1.0 : 0.0)) > 1e-9) return map;
      }
    }
    return glm::dmat4(1);
  }

  /// The triangles of all primitives. Vertices are one where the manifold that goes with them says
  /// so, or else where their coordinates are equal.
  TriangleMesh triangles_of(const JsonPlace& mesh) {
    TriangleMesh drawn;
    LookNumbers look_numbers;
    const JsonPlace primitives = mesh.at("primitives");
    for (size_t p = 0; p < primitives.size(); ++p)
      add_primitive(primitives.at(p), drawn, look_numbers);
    if (!mesh.has("extensions") || !mesh.at("extensions").has(kManifold)) {
      weld(drawn);
      return drawn;
    }
    TriangleMesh manifold;
    const JsonPlace primitive = mesh.at("extensions").at(kManifold).at("manifoldPrimitive");
    look_numbers.clear();
    add_primitive(primitive, manifold, look_numbers);
    if (!same_triangles(drawn, manifold))
      throw Malformed{primitive.name() + " has other triangles than the mesh"};
    drop_unused_points(manifold);
    manifold.appearance_of = std::move(drawn.appearance_of);
    manifold.appearances = std::move(drawn.appearances);
    return manifold;
  }

  /// From the roots down. The only root, if it is no part itself, is the file's frame around its
  /// parts, which turns and scales to glTF's axes and units: lengths stay those of the meshes.
  std::vector<Place> places_of(const JsonPlace& nodes) const {
    std::vector<Place> places(nodes.size());
    std::vector<size_t> stack = roots_of(nodes);
    for (const size_t top : stack) {
      const JsonPlace node = nodes.at(top);
      Place& place = places[top];
      place.is_reached = true;
      const bool is_frame = stack.size() == 1 && !node.has("mesh");
      if (options_.frame == GltfFrame::kMillimetres) {
        place.map = without_noise(to_millimetres() * map_of(node));
      } else if (!is_frame) {
        place.map = map_of(node);
      }
      if (!is_frame) place.name = node.text("name", "");
    }
    while (!stack.empty()) {
      const size_t parent = stack.back();
      stack.pop_back();
      for (const size_t child : nodes.at(parent).indices("children")) {
        const JsonPlace node = nodes.at(child);
        Place& place = places[child];
        if (place.is_reached) throw Malformed{node.name() + " has two parents"};
        place.is_reached = true;
        place.map = places[parent].map * map_of(node);
        place.name = places[parent].name;
        const std::string own = node.text("name", "");
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

  std::vector<size_t> roots_of(const JsonPlace& nodes) const {
    if (root().has("scenes"))
      return root().at("scenes").at(root().whole("scene", 0)).indices("nodes");
    std::vector<bool> is_child(nodes.size(), false);
    for (size_t n = 0; n < nodes.size(); ++n) {
      for (const size_t c : nodes.at(n).indices("children")) {
        if (c < is_child.size()) is_child[c] = true;  // else told when it is walked to
      }
    }
    std::vector<size_t> roots;
    for (size_t n = 0; n < nodes.size(); ++n) {
      if (!is_child[n]) roots.push_back(n);
    }
    return roots;
  }

  static glm::dmat4 map_of(const JsonPlace& node) {
    if (node.has("matrix"))
      return glm::make_mat4(node.numbers("matrix", std::vector<double>(16, 0)).data());
    const std::vector<double> t = node.numbers("translation", {0, 0, 0});
    const std::vector<double> s = node.numbers("scale", {1, 1, 1});
    const glm::dmat4 moved = glm::translate(glm::dmat4(1), {t[0], t[1], t[2]});
    return glm::scale(moved * rotation_of(node), {s[0], s[1], s[2]});
  }

  /// Files have unit quaternions in single precision. Divided by their length nothing is scaled or
  /// sheared, and what two nodes have flush stays so: [0, 0, q, q] is a right angle for any q.
  static glm::dmat4 rotation_of(const JsonPlace& node) {
    const std::vector<double> r = node.numbers("rotation", {0, 0, 0, 1});
    const double x = r[0], y = r[1], z = r[2], w = r[3], square = x * x + y * y + z * z + w * w;
    if (!std::isnormal(square))
      throw Malformed{node.name() + ": its rotation is no unit quaternion"};
    const auto part = [square](double of_square) { return of_square / square; };
    return {glm::dvec4(part(x * x + w * w - y * y - z * z), part(2 * (x * y + w * z)),
                       part(2 * (x * z - w * y)), 0),
            glm::dvec4(part(2 * (x * y - w * z)), part(y * y + w * w - x * x - z * z),
                       part(2 * (y * z + w * x)), 0),
            glm::dvec4(part(2 * (x * z + w * y)), part(2 * (y * z - w * x)),
                       part(z * z + w * w - x * x - y * y), 0),
            glm::dvec4(0, 0, 0, 1)};
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

  void add_primitive(const JsonPlace& primitive, TriangleMesh& mesh, LookNumbers& look_numbers) {
    const size_t mode = primitive.whole("mode", kTriangles);
    if (mode < kTriangles) {
      ++left_out_;
      return;
    }
    if (mode > kFan) throw Malformed{primitive.name() + ".mode must be from 0 to 6"};
    refuse_compression(primitive);
    const JsonPlace accessors = root().at("accessors");
    const JsonPlace positions = accessors.at(primitive.at("attributes").at("POSITION").whole());
    const size_t count = GltfData::count_of(positions);
    std::vector<uint32_t> indices;
    std::vector<glm::dvec3> points;
    if (primitive.has("indices")) {
      if (!positions.has("sparse")) data_.positions(positions, {});  // is it there at all?
      indices = data_.indices(accessors.at(primitive.at("indices").whole()));
      const bool fits = std::all_of(indices.begin(), indices.end(),
                                    [&](uint32_t index) { return index < count; });
      if (!fits) {
        data_.positions(positions);  // says so if the points themselves are what is wrong
        throw Malformed{"an index is out of range"};
      }
      points = used_points(positions, count, indices);
    } else {
      points = data_.positions(positions);
      for (uint32_t i = 0; i < points.size(); ++i) indices.push_back(i);
    }
    // Accessors may look at the same bytes.
    corners_ += indices.size();
    if (corners_ > kManyCorners && corners_ / kMostCopies > data_.size()) refuse_copies();
    if (mode == kTriangles && indices.size() % 3 != 0)
      throw Malformed{"the number of indices is no multiple of three"};
    const auto first = static_cast<uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), points.begin(), points.end());
    const size_t before = mesh.triangles.size();
    const auto add = [&](size_t a, size_t b, size_t c) {
      mesh.triangles.push_back({first + indices[a], first + indices[b], first + indices[c]});
    };
    if (mode == kTriangles) {
      for (size_t i = 0; i < indices.size(); i += 3) add(i, i + 1, i + 2);
    } else {
      for (size_t i = 0; i + 2 < indices.size(); ++i) {
        const uint32_t a = mode == kFan ? indices[0] : indices[i];
        // A strip goes on elsewhere by way of triangles that repeat a corner: these are none.
        if (a == indices[i + 1] || a == indices[i + 2] || indices[i + 1] == indices[i + 2])
          continue;
        if (mode == kFan) {
          add(i + 1, i + 2, 0);
        } else {
          add(i, i + 1 + i % 2, i + 2 - i % 2);
        }
      }
    }
    add_look(primitive, mesh.triangles.size() - before, mesh, look_numbers);
  }

  /// The points of an accessor: where primitives use few of many, only those that the indices have,
  /// which are numbered anew.
  std::vector<glm::dvec3> used_points(const JsonPlace& accessor, size_t count,
                                      std::vector<uint32_t>& indices) const {
    constexpr size_t kFew = 4;
    if (count / kFew <= indices.size()) return data_.positions(accessor);
    std::vector<uint32_t> used = indices;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (uint32_t& index : indices) {
      const auto found = std::lower_bound(used.begin(), used.end(), index);
      index = static_cast<uint32_t>(found - used.begin());
    }
    return data_.positions(accessor, used);
  }

  static void refuse_compression(const JsonPlace& primitive) {
    if (primitive.has("extensions") &&
        primitive.at("extensions").has("KHR_draco_mesh_compression")) {
      throw Malformed{
          "its meshes are compressed (KHR_draco_mesh_compression), which is not read: "
          "write it without"};
    }
  }

  /// The appearance of the last `count` triangles, which are the primitive's.
  void add_look(const JsonPlace& primitive, size_t count, TriangleMesh& mesh,
                LookNumbers& look_numbers) const {
    Appearance look;
    if (primitive.has("material")) {
      const size_t number = primitive.at("material").whole();
      if (number >= materials_.size())
        throw Malformed{primitive.name() + " has a material that is not there"};
      look = materials_[number];
    }
    const auto [known, is_new] =
        look_numbers.emplace(look, static_cast<uint32_t>(mesh.appearances.size()));
    if (is_new) mesh.appearances.push_back(look);
    mesh.appearance_of.insert(mesh.appearance_of.end(), count, known->second);
  }

  Json json_;
  const GltfOptions& options_;
  GltfBuffers buffers_;
  GltfData data_;
  uint64_t corners_ = 0;                       ///< of the primitives that were read
  std::map<std::string, size_t> passed_over_;  ///< what, and of how many nodes
  size_t left_out_ = 0;                        ///< primitives of points and lines
  std::vector<Appearance> materials_;
};

/// A document of glTF is some ten deep, and what an exporter adds to it hardly deeper. The parser
/// would make a million objects in each other, 200 MB of them, before it says what is wrong with
/// the last.
constexpr size_t kDeepest = 512;

/// Counts the brackets outside of strings. The parser's own callback is told the depth, too, but
/// takes a time that grows with the square of a list's length.
void refuse_deep_nesting(std::string_view text) {
  size_t depth = 0;
  bool in_string = false;
  for (size_t at = 0; at < text.size(); ++at) {
    switch (text[at]) {
      case '"':
        in_string = !in_string;
        break;
      case '\\':
        ++at;  // the character that it escapes
        break;
      case '[':
      case '{':
        if (!in_string && ++depth > kDeepest)
          throw Malformed{"its JSON is nested more than " + std::to_string(kDeepest) + " deep"};
        break;
      case ']':
      case '}':
        if (!in_string && depth > 0) --depth;
        break;
      default:
        break;
    }
  }
}

Json parse_json(std::string_view text) {
  refuse_deep_nesting(text);
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    throw Malformed{"its JSON is malformed at byte " + std::to_string(error.byte)};
  } catch (const Json::out_of_range&) {
    throw Malformed{"its JSON has a number beyond the range of doubles"};
  }
}

std::vector<TriangleMesh> read_document(std::string_view text, std::string_view binary,
                                        const GltfOptions& options) {
  Json json = parse_json(text);
  // Version 1 has objects where version 2 has lists: what it lacks would say nothing to anybody.
  const Json* asset = json.is_object() && json.contains("asset") ? &json["asset"] : nullptr;
  if (asset != nullptr && asset->is_object() && asset->contains("version") &&
      (*asset)["version"].is_string() && (*asset)["version"].get<std::string>().starts_with("1.")) {
    throw Malformed{"only version 2 of glTF is read"};
  }
  return Reader(std::move(json), binary, options).meshes();
}

std::vector<TriangleMesh> read(std::string_view bytes, const GltfOptions& options) {
  const size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start != std::string_view::npos && bytes[start] == '{')
    return read_document(bytes, {}, options);
  constexpr std::string_view kStart = "glTF";
  if (bytes.substr(0, kStart.size()) != kStart.substr(0, bytes.size()))
    throw Malformed{
        "it is neither a GLB, which begins with \"glTF\", nor glTF as JSON, which is an "
        "object and begins with \"{\""};
  if (read_word(bytes, 4) != 2) throw Malformed{"only version 2 of GLB is read"};
  if (const uint64_t said = read_word(bytes, 8); said != bytes.size()) {
    throw Malformed{"the file says that it has " + std::to_string(said) + " bytes, but has " +
                    std::to_string(bytes.size())};
  }
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
  return read_document(text, binary, options);
}

}  // namespace

Result<std::vector<TriangleMesh>> parse_glb(const std::string& name, std::string_view bytes,
                                            const GltfOptions& options) {
  try {
    std::vector<TriangleMesh> meshes = read(bytes, options);
    return meshes;
  } catch (const Malformed& problem) {
    return Error{ErrorCode::kMalformedFile, name + ": " + problem.what, {}};
  }
}

}  // namespace csgrun

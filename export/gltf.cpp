// glTF 2.0, binary or text with its buffer embedded.
//
// glTF means metres and Y up. Mesh data stay in millimetres and Z up, bit for bit what an STL would
// hold; a node above all parts turns and scales them. Vertices are duplicated where normals differ,
// so each mesh carries EXT_mesh_manifold: one more primitive over the whole index buffer, whose
// sparse accessor replaces every duplicate by the first vertex of its kind. What it describes is
// the manifold that rounding checked.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <streambuf>

#include <glm/geometric.hpp>
#include <tiny_gltf.h>

#include "export/encoders.h"
#include "export/palette.h"
#include "export/rounding.h"
#include "export/shading.h"
#include "export/text.h"

namespace csgrun {
namespace {

constexpr const char* kManifoldExtension = "EXT_mesh_manifold";
// tinygltf keeps byte offsets of sparse accessors as int.
constexpr size_t kLargestBuffer = std::numeric_limits<int>::max();

double linear_from_srgb(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

tinygltf::Material material_of(const Appearance& appearance, const std::string& name) {
  tinygltf::Material material;
  material.name = name;
  auto& pbr = material.pbrMetallicRoughness;
  pbr.baseColorFactor.clear();
  for (const float c : {appearance.red, appearance.green, appearance.blue}) {
    pbr.baseColorFactor.push_back(
        rounded_to_millionths(linear_from_srgb(std::clamp(c, 0.0f, 1.0f))));
  }
  const float alpha = std::clamp(appearance.alpha, 0.0f, 1.0f);
  pbr.baseColorFactor.push_back(rounded_to_millionths(alpha));
  if (alpha < 1) material.alphaMode = "BLEND";
  pbr.metallicFactor = rounded_to_millionths(std::clamp(appearance.metallic, 0.0f, 1.0f));
  pbr.roughnessFactor = rounded_to_millionths(std::clamp(appearance.roughness, 0.0f, 1.0f));
  return material;
}

/// Whether glTF may have it as a node's transform: rotation, reflection and scale along the axes
/// before it, no shear. Others are applied to the vertices, which tells of places beyond the
/// numbers of the file.
bool is_node_transform(const Affine& map) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (!(std::fabs(map.m[i][j]) <= std::numeric_limits<float>::max())) return false;
    }
  }
  glm::dvec3 column[3];
  for (int c = 0; c < 3; ++c) column[c] = {map.m[0][c], map.m[1][c], map.m[2][c]};
  for (int c = 0; c < 3; ++c) {
    const glm::dvec3 &a = column[c], &b = column[(c + 1) % 3];
    const double aa = glm::dot(a, a), bb = glm::dot(b, b), ab = glm::dot(a, b);
    if (!(aa > 0) || ab * ab > 1e-20 * aa * bb) return false;
  }
  return true;
}

/// Where a stream writes to: a string with room for what is known to come, which std::ostringstream
/// would copy time and again as it grows.
class StringSink : public std::streambuf {
 public:
  explicit StringSink(size_t room) { text_.reserve(room + kMore); }
  std::string take() { return std::move(text_); }

 protected:
  std::streamsize xsputn(const char* text, std::streamsize count) override {
    text_.append(text, static_cast<size_t>(count));
    return count;
  }
  int_type overflow(int_type c) override {
    if (c != traits_type::eof()) text_ += traits_type::to_char_type(c);
    return traits_type::not_eof(c);
  }

 private:
  static constexpr size_t kMore = 4096;  // for the structure around the buffer
  std::string text_;
};

class GltfWriter {
 public:
  explicit GltfWriter(MeshMaker& maker) : maker_(maker) {}

  Result<std::string> run(const Parts& parts, GltfContainer container) {
    model_.asset.version = "2.0";
    model_.asset.generator = "csgrun " CSGRUN_VERSION;
    const int root = add_node("model");
    model_.nodes[root].rotation = {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
    model_.nodes[root].scale = {0.001, 0.001, 0.001};
    for (const Part& part : parts) {
      if (Status status = add_part(part, root); !status) return status.error();
    }
    maker_.report_rounding();
    for (size_t m = 0; m < palette_.names().size(); ++m) {
      model_.materials.push_back(material_of(palette_.appearances()[m], palette_.names()[m]));
    }
    tinygltf::Scene scene;
    scene.nodes.push_back(root);
    model_.scenes.push_back(std::move(scene));
    model_.defaultScene = 0;
    if (!buffer_.empty()) {
      model_.buffers.emplace_back();
      model_.buffers[0].data = std::move(buffer_);
    }
    const bool binary = container == GltfContainer::kBinary;
    const size_t bytes = model_.buffers.empty() ? 0 : model_.buffers[0].data.size();
    StringSink sink(binary ? bytes : bytes / 3 * 4);
    std::ostream stream(&sink);
    if (!tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, !binary, binary) || !stream) {
      return Error{ErrorCode::kInternal, "tinygltf could not write the model", {}};
    }
    return sink.take();
  }

 private:
  int add_node(const std::string& name) {
    model_.nodes.emplace_back();
    model_.nodes.back().name = valid_utf8(name);
    return static_cast<int>(model_.nodes.size()) - 1;
  }

  /// The node of a group such as "case/inner", made with those above it when it is not there yet.
  int group_node(const std::string& group, int root) {
    if (const auto known = groups_.find(group); known != groups_.end()) return known->second;
    const size_t slash = group.rfind('/');
    const int parent = slash == std::string::npos ? root : group_node(group.substr(0, slash), root);
    const int node = add_node(slash == std::string::npos ? group : group.substr(slash + 1));
    model_.nodes[parent].children.push_back(node);
    groups_[group] = node;
    return node;
  }

  Status add_part(const Part& part, int root) {
    const size_t slash = part.name.rfind('/');
    const int parent =
        slash == std::string::npos ? root : group_node(part.name.substr(0, slash), root);
    const int node = add_node(slash == std::string::npos ? part.name : part.name.substr(slash + 1));
    model_.nodes[parent].children.push_back(node);

    const bool as_node = is_node_transform(part.placement);
    Result<int> mesh = as_node ? shared_mesh(part) : new_mesh(part, part.placement);
    if (!mesh) return mesh.error();
    model_.nodes[node].mesh = *mesh;
    if (!as_node || part.placement == Affine{}) return std::monostate{};
    const auto& m = part.placement.m;
    Affine translation;
    for (int row = 0; row < 3; ++row) translation.m[row][3] = m[row][3];
    if (part.placement == translation) {
      model_.nodes[node].translation = {m[0][3], m[1][3], m[2][3]};
    } else {
      for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 3; ++row) model_.nodes[node].matrix.push_back(m[row][column]);
        model_.nodes[node].matrix.push_back(column == 3);
      }
    }
    return std::monostate{};
  }

  Result<int> shared_mesh(const Part& part) {
    if (const auto known = meshes_.find(part.solid.get()); known != meshes_.end()) {
      return known->second;
    }
    Result<int> mesh = new_mesh(part, Affine{});
    if (mesh) meshes_[part.solid.get()] = *mesh;
    return mesh;
  }

  /// Adds the mesh of a part; -1 when nothing is left of it: glTF knows no empty mesh.
  Result<int> new_mesh(const Part& part, const Affine& placement) {
    const Solid& solid = *part.solid;
    Result<RoundedMesh> rounded = maker_.make(part, placement, Precision::kFloat, false);
    if (!rounded) return rounded.error();
    if (rounded->triangles.empty()) return -1;
    const ShadedMesh shaded = shade(solid, *rounded);
    const size_t most =
        buffer_.size() + 24 * shaded.vertex_of.size() + 36 * shaded.triangles.size();
    if (most > kLargestBuffer) {
      return Error{ErrorCode::kOutOfRange, "the model is too large for a glTF file (2 GiB)", {}};
    }
    if (most > buffer_.capacity()) buffer_.reserve(std::max(most, 2 * buffer_.capacity()));

    tinygltf::Mesh mesh;
    mesh.name = valid_utf8(part.name);
    const int positions = add_positions(*rounded, shaded);
    const int normals = add_view(TINYGLTF_TARGET_ARRAY_BUFFER, std::span(shaded.normals));
    const int normal_accessor = add_accessor(normals, 0, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                             TINYGLTF_TYPE_VEC3, shaded.normals.size());

    // The index buffer: triangles in runs of one material, their order kept inside a run.
    const std::vector<uint32_t> materials = palette_.add(solid);
    const auto material_at = [&](uint32_t t) {
      return materials[solid.faces[rounded->triangle_face[t]].appearance];
    };
    std::vector<uint32_t> order(shaded.triangles.size());
    for (uint32_t t = 0; t < order.size(); ++t) order[t] = t;
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return material_at(a) < material_at(b); });
    std::vector<uint32_t> indices;
    indices.reserve(3 * order.size());
    for (const uint32_t t : order) {
      indices.insert(indices.end(), shaded.triangles[t].begin(), shaded.triangles[t].end());
    }
    const int index_view = add_view(TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER, std::span(indices));
    for (size_t begin = 0; begin < order.size();) {
      size_t end = begin + 1;
      while (end < order.size() && material_at(order[end]) == material_at(order[begin])) ++end;
      tinygltf::Primitive primitive;
      primitive.attributes["POSITION"] = positions;
      primitive.attributes["NORMAL"] = normal_accessor;
      primitive.indices = add_accessor(index_view, 12 * begin, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                       TINYGLTF_TYPE_SCALAR, 3 * (end - begin));
      primitive.material = static_cast<int>(material_at(order[begin]));
      primitive.mode = TINYGLTF_MODE_TRIANGLES;
      mesh.primitives.push_back(std::move(primitive));
      begin = end;
    }
    add_manifold(mesh, shaded, indices, positions, index_view);
    model_.meshes.push_back(std::move(mesh));
    return static_cast<int>(model_.meshes.size()) - 1;
  }

  int add_positions(const RoundedMesh& rounded, const ShadedMesh& shaded) {
    std::vector<std::array<float, 3>> positions;
    positions.reserve(shaded.vertex_of.size());
    for (const uint32_t v : shaded.vertex_of) {
      const glm::dvec3& p = rounded.positions[v];
      positions.push_back(
          {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
    }
    std::array<float, 3> low = positions[0], high = positions[0];
    for (const auto& p : positions) {
      for (size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
    const int view = add_view(TINYGLTF_TARGET_ARRAY_BUFFER, std::span(positions));
    const int accessor =
        add_accessor(view, 0, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, positions.size());
    model_.accessors[accessor].minValues.assign(low.begin(), low.end());
    model_.accessors[accessor].maxValues.assign(high.begin(), high.end());
    return accessor;
  }

  void add_manifold(tinygltf::Mesh& mesh, const ShadedMesh& shaded,
                    std::span<const uint32_t> indices, int positions, int index_view) {
    std::vector<uint32_t> first_of(shaded.vertex_of.size());  // duplicates stand side by side
    for (uint32_t s = 0; s < first_of.size(); ++s) {
      first_of[s] = s > 0 && shaded.vertex_of[s] == shaded.vertex_of[s - 1] ? first_of[s - 1] : s;
    }
    std::vector<uint32_t> merge_at, merge_to;
    for (uint32_t i = 0; i < indices.size(); ++i) {
      if (first_of[indices[i]] == indices[i]) continue;
      merge_at.push_back(i);
      merge_to.push_back(first_of[indices[i]]);
    }
    const int manifold = add_accessor(index_view, 0, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                      TINYGLTF_TYPE_SCALAR, indices.size());
    tinygltf::Value::Object primitive, attributes, extension;
    attributes["POSITION"] = tinygltf::Value(positions);
    primitive["attributes"] = tinygltf::Value(attributes);
    primitive["indices"] = tinygltf::Value(manifold);
    primitive["mode"] = tinygltf::Value(TINYGLTF_MODE_TRIANGLES);
    extension["manifoldPrimitive"] = tinygltf::Value(primitive);
    if (!merge_at.empty()) {
      const int at_view = add_view(0, std::span(merge_at)),
                to_view = add_view(0, std::span(merge_to));
      auto& sparse = model_.accessors[manifold].sparse;
      sparse.isSparse = true;
      sparse.count = static_cast<int>(merge_at.size());
      sparse.indices.bufferView = at_view;
      sparse.indices.byteOffset = 0;
      sparse.indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
      sparse.values.bufferView = to_view;
      sparse.values.byteOffset = 0;
      extension["mergeIndices"] = tinygltf::Value(add_accessor(
          at_view, 0, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, merge_at.size()));
      extension["mergeValues"] = tinygltf::Value(add_accessor(
          to_view, 0, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, merge_to.size()));
    }
    mesh.extensions[kManifoldExtension] = tinygltf::Value(extension);
    if (model_.extensionsUsed.empty()) model_.extensionsUsed.emplace_back(kManifoldExtension);
  }

  template <class T>
  int add_view(int target, std::span<T> values) {
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer_.size();
    view.byteLength = values.size_bytes();
    view.target = target;
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    buffer_.insert(buffer_.end(), bytes, bytes + values.size_bytes());
    model_.bufferViews.push_back(std::move(view));
    return static_cast<int>(model_.bufferViews.size()) - 1;
  }

  int add_accessor(int view, size_t offset, int component_type, int type, size_t count) {
    tinygltf::Accessor accessor;
    accessor.bufferView = view;
    accessor.byteOffset = offset;
    accessor.componentType = component_type;
    accessor.type = type;
    accessor.count = count;
    model_.accessors.push_back(std::move(accessor));
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  MeshMaker& maker_;
  tinygltf::Model model_;
  std::vector<unsigned char> buffer_;
  Palette palette_;
  std::map<std::string, int> groups_;
  std::map<const Solid*, int> meshes_;  // looked up, never walked
};

}  // namespace

Result<std::string> encode_gltf(const Parts& parts, GltfContainer container, MeshMaker& maker) {
  return GltfWriter(maker).run(parts, container);
}

}  // namespace csgrun

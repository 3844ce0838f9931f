// Numbers of a glTF file: accessors, the views that they look through, and the buffers behind.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "lua_bindings/measure/json_place.h"

namespace csgrun {

/// Reads accessors (Khronos glTF 2.0, section 3.6), also sparse ones, and those of
/// KHR_mesh_quantization. All functions throw Malformed.
class GltfData {
 public:
  /// Of a document and its buffers, in their order; both must outlive this.
  GltfData(const JsonPlace& root, std::vector<std::string_view> buffers)
      : root_(root), buffers_(std::move(buffers)) {}

  /// How many elements there are.
  [[nodiscard]] static size_t count_of(const JsonPlace& accessor) {
    return accessor.at("count").whole();
  }
  /// Three numbers an element. Of an accessor that is not sparse only those elements are read whose
  /// numbers are given; all must be of it.
  std::vector<glm::dvec3> positions(const JsonPlace& accessor) const;
  std::vector<glm::dvec3> positions(const JsonPlace& accessor,
                                    const std::vector<uint32_t>& wanted) const;
  /// How many bytes there are in all.
  [[nodiscard]] size_t size() const;
  /// One unsigned integer an element.
  [[nodiscard]] std::vector<uint32_t> indices(const JsonPlace& accessor) const;

 private:
  /// The bytes of an accessor's elements, `stride` apart.
  struct Elements {
    const char* data;
    size_t count, stride;
  };

  Elements elements(const JsonPlace& owner, size_t count, size_t size) const;
  void read_positions(const JsonPlace& owner, const JsonPlace& typed, size_t count,
                      const std::vector<uint32_t>* wanted, std::vector<glm::dvec3>& points) const;
  std::vector<uint32_t> read_integers(const JsonPlace& owner, const JsonPlace& typed,
                                      size_t count) const;
  void refuse_endless_zeros(const JsonPlace& accessor, size_t count) const;

  JsonPlace root_;
  std::vector<std::string_view> buffers_;
};

}  // namespace csgrun

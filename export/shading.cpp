#include "export/shading.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "export/none.h"

namespace csgrun {
namespace {

constexpr double kCreaseCosine = 0.7660444431189780;  // of 40 degrees
class Shader {
 public:
  Shader(const Solid& solid, const RoundedMesh& mesh) : solid_(solid), mesh_(mesh) {}

  ShadedMesh run() {
    const size_t corners = 3 * mesh_.triangles.size();
    std::vector<uint32_t> corner_at(mesh_.positions.size(), kNone);
    for (size_t h = corners; h-- > 0;) {
      corner_at[mesh_.triangles[h / 3][h % 3]] = static_cast<uint32_t>(h);
    }
    shaded_.triangles.resize(mesh_.triangles.size());
    for (uint32_t v = 0; v < mesh_.positions.size(); ++v) {
      if (corner_at[v] != kNone) shade_vertex(v, corner_at[v]);
    }
    return std::move(shaded_);
  }

 private:
  [[nodiscard]] uint32_t face_at(uint32_t h) const { return mesh_.triangle_face[h / 3]; }

  [[nodiscard]] bool smooth(uint32_t f, uint32_t g) const {
    if (f == g) return true;
    const Solid::Face &a = solid_.faces[f], &b = solid_.faces[g];
    return a.surface != 0 && a.surface == b.surface && a.source == b.source &&
           glm::dot(mesh_.face_normals[f], mesh_.face_normals[g]) > kCreaseCosine;
  }

  void shade_vertex(uint32_t v, uint32_t first) {
    fan_.clear();
    uint32_t h = first;
    do {
      fan_.push_back(h);
      h = mesh_.twins[previous_in_triangle(h)];
    } while (h != first);

    // Begin behind a crease, if there is one, so that no group is cut where the fan closes.
    for (size_t i = 0; i < fan_.size(); ++i) {
      if (!smooth(face_at(fan_[(i + fan_.size() - 1) % fan_.size()]), face_at(fan_[i]))) {
        std::rotate(fan_.begin(), fan_.begin() + static_cast<std::ptrdiff_t>(i), fan_.end());
        break;
      }
    }
    const size_t first_shaded = shaded_.vertex_of.size();
    for (size_t begin = 0; begin < fan_.size();) {
      size_t end = begin + 1;
      while (end < fan_.size() && smooth(face_at(fan_[end - 1]), face_at(fan_[end]))) ++end;
      const uint32_t vertex = shading_vertex(v, first_shaded, group_normal(begin, end));
      for (size_t i = begin; i < end; ++i) shaded_.triangles[fan_[i] / 3][fan_[i] % 3] = vertex;
      begin = end;
    }
  }

  std::array<float, 3> group_normal(size_t begin, size_t end) {
    faces_.clear();
    for (size_t i = begin; i < end; ++i) faces_.push_back(face_at(fan_[i]));
    std::sort(faces_.begin(), faces_.end());
    faces_.erase(std::unique(faces_.begin(), faces_.end()), faces_.end());
    glm::dvec3 sum(0);
    for (const uint32_t face : faces_) sum += mesh_.face_normals[face];
    const double length = std::sqrt(glm::dot(sum, sum));
    // Around a needle's tip the normals may cancel; then one of them is as good as any.
    const glm::dvec3 n = length > 1e-6 ? sum / length : mesh_.face_normals[faces_[0]];
    return {static_cast<float>(n.x) + 0.0f, static_cast<float>(n.y) + 0.0f,
            static_cast<float>(n.z) + 0.0f};
  }

  /// The shading vertex of `v` with this normal; those of `v` begin at `first`.
  uint32_t shading_vertex(uint32_t v, size_t first, const std::array<float, 3>& normal) {
    for (size_t i = first; i < shaded_.normals.size(); ++i) {
      if (shaded_.normals[i] == normal) return static_cast<uint32_t>(i);
    }
    shaded_.vertex_of.push_back(v);
    shaded_.normals.push_back(normal);
    return static_cast<uint32_t>(shaded_.normals.size() - 1);
  }

  const Solid& solid_;
  const RoundedMesh& mesh_;
  ShadedMesh shaded_;
  std::vector<uint32_t> fan_, faces_;
};

}  // namespace

ShadedMesh shade(const Solid& solid, const RoundedMesh& mesh) { return Shader(solid, mesh).run(); }

}  // namespace csgrun

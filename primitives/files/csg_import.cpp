#include "primitives/files/csg_import.h"

#include <limits>
#include <utility>

#include <glm/common.hpp>

#include <csgrun/primitives/mesh_file.h>

#include "primitives/files/formats.h"

namespace csgrun {
namespace {

/// The middle of the box of all parts goes to the origin.
void move_to_the_middle(std::vector<ModelPart>& parts) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const ModelPart& part : parts) {
    for (const uint32_t corner : part.mesh.corners) {
      low = glm::min(low, part.mesh.points[corner]);
      high = glm::max(high, part.mesh.points[corner]);
    }
  }
  if (!(low.x <= high.x)) return;
  for (ModelPart& part : parts) {
    for (glm::dvec3& point : part.mesh.points) point -= (low + high) / 2.0;
  }
}

Result<std::vector<ModelPart>> mesh_as_parts(const std::string& path, const std::string& bytes,
                                             std::vector<std::string>& notes) {
  Result<PolygonMesh> mesh = parse_mesh(path, bytes, nullptr, nullptr, &notes);
  if (!mesh) return mesh.error();
  std::vector<ModelPart> part;  // one, which a list of initial values would copy
  part.push_back({"", *std::move(mesh)});
  return part;
}

}  // namespace

Result<std::vector<ModelPart>> csg_import_parts(const std::string& path, const std::string& bytes,
                                                bool center, std::vector<std::string>& notes) {
  auto parts = is_3mf_path(path)   ? parse_3mf(path, bytes, &notes, FileUnit::kMillimetre)
               : is_amf_path(path) ? parse_amf(path, bytes, &notes, FileUnit::kMillimetre)
                                   : mesh_as_parts(path, bytes, notes);
  if (parts && center) move_to_the_middle(*parts);
  return parts;
}

}  // namespace csgrun

// Binary STL: an 80 byte header, a count, and for each triangle a normal and three corners.
#include <bit>
#include <cmath>

#include <glm/geometric.hpp>

#include "export/encoders.h"
#include "export/rounding.h"

namespace csgrun {
namespace {

constexpr size_t kHeaderBytes = 80;
constexpr size_t kTriangleBytes = 50;
static_assert(std::endian::native == std::endian::little,
              "STL and GLB are written as memory has them");

void append_vector(std::string& bytes, const glm::dvec3& v) {
  const float floats[3] = {static_cast<float>(v.x), static_cast<float>(v.y),
                           static_cast<float>(v.z)};
  bytes.append(reinterpret_cast<const char*>(floats), sizeof floats);
}

/// The normal of the triangle as it is written, as readers compute it; zero where it has no area.
glm::dvec3 written_normal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const glm::dvec3 n = glm::cross(b - a, c - a);
  const double length = std::sqrt(glm::dot(n, n));
  return length > 1e-12 ? n / length + 0.0 : glm::dvec3(0);
}

}  // namespace

Result<std::string> encode_stl(const Part& part, WriteReport& report) {
  Result<RoundedMesh> mesh = round_part(*part.solid, part.placement, Precision::kFloat, false);
  if (!mesh) return mesh.error();
  report_rounding(*mesh, part, report);

  // Readers tell text from binary by the word "solid" at the start.
  std::string bytes = "csgrun " CSGRUN_VERSION " binary STL, millimetres";
  bytes.resize(kHeaderBytes, ' ');
  if (mesh->triangles.size() > UINT32_MAX) {
    return Error{ErrorCode::kOutOfRange, "too many triangles for an STL file", {}};
  }
  const auto count = static_cast<uint32_t>(mesh->triangles.size());
  bytes.reserve(kHeaderBytes + sizeof count + kTriangleBytes * count);
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  for (const auto& [a, b, c] : mesh->triangles) {
    const glm::dvec3 &p = mesh->positions[a], &q = mesh->positions[b], &r = mesh->positions[c];
    append_vector(bytes, written_normal(p, q, r));
    append_vector(bytes, p);
    append_vector(bytes, q);
    append_vector(bytes, r);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace csgrun

// Binary STL: an 80 byte header, a count, and for each triangle a normal and three corners.
#include <array>
#include <bit>
#include <cmath>

#include <glm/vec3.hpp>

#include "export/encoders.h"
#include "export/rounding.h"

namespace csgrun {
namespace {

constexpr size_t kHeaderBytes = 80;
constexpr size_t kTriangleBytes = 50;
static_assert(std::endian::native == std::endian::little,
              "STL and GLB are written as memory has them");

using Floats = std::array<float, 3>;

Floats to_floats(const glm::dvec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

void append_vector(std::string& bytes, const Floats& v) {
  bytes.append(reinterpret_cast<const char*>(v.data()), sizeof v);
}

/// The normal of the triangle as admesh and the slicers that took its code compute it, step by
/// step: a better one would count as a fault to repair where cancellation spoils theirs, on
/// triangles so thin that no normal means anything. Zero where there is no area.
Floats written_normal(const Floats& a, const Floats& b, const Floats& c) {
  const Floats u{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const Floats v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  Floats n;
  double square = 0;
  for (size_t k = 0; k < 3; ++k) {
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const auto first = static_cast<float>(static_cast<double>(u[i]) * v[j]);
    n[k] = static_cast<float>(first - static_cast<double>(u[j]) * v[i]);
    square += static_cast<double>(n[k]) * n[k];
  }
  const double length = std::sqrt(square);
  if (length < 1e-12) return {0, 0, 0};
  for (float& x : n) x = static_cast<float>(x * (1.0 / length)) + 0.0F;
  return n;
}

}  // namespace

Result<std::string> encode_stl(const Part& part, MeshMaker& maker) {
  Result<RoundedMesh> mesh = maker.make(part, part.placement, Precision::kFloat, false);
  if (!mesh) return mesh.error();
  maker.report_rounding();

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
    const Floats p = to_floats(mesh->positions[a]), q = to_floats(mesh->positions[b]),
                 r = to_floats(mesh->positions[c]);
    append_vector(bytes, written_normal(p, q, r));
    append_vector(bytes, p);
    append_vector(bytes, q);
    append_vector(bytes, r);
    bytes.append(2, '\0');
  }
  return bytes;
}

}  // namespace csgrun

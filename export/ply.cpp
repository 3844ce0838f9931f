// Binary PLY: doubles, polygons kept, and where a colour was asked for, colours of faces.
#include <bit>
#include <cstring>

#include "export/encoders.h"
#include "export/palette.h"
#include "export/polygons.h"
#include "export/text.h"

namespace csgrun {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written as it lies in memory");

template <class V>
void append_bytes(std::string& text, V value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  text.append(bytes, sizeof value);
}

}  // namespace

Result<std::string> encode_ply(const Part& part, MeshMaker& maker) {
  Result<RoundedMesh> mesh = maker.make(part, part.placement, Precision::kDouble, true);
  if (!mesh) return mesh.error();
  maker.report_rounding();
  const Solid& solid = *part.solid;
  const std::vector<Polygon> polygons = polygons_of(*mesh);
  const auto look = [&](const Polygon& polygon) -> const Appearance& {
    return solid.appearances[solid.faces[polygon.face].appearance];
  };
  bool has_colours = false;
  for (const Polygon& polygon : polygons) has_colours |= !look(polygon).is_default;

  std::string text = "ply\nformat binary_little_endian 1.0\ncomment csgrun " CSGRUN_VERSION
                     ", millimetres, Z up\nelement vertex ";
  append_number(text, uint64_t{mesh->positions.size()});
  text += "\nproperty double x\nproperty double y\nproperty double z\nelement face ";
  append_number(text, uint64_t{polygons.size()});
  text += "\nproperty list uint uint vertex_indices\n";
  if (has_colours) {
    for (const char* channel : {"red", "green", "blue", "alpha"})
      text += std::string("property uchar ") + channel + '\n';
  }
  text += "end_header\n";
  for (const glm::dvec3& p : mesh->positions) {
    append_bytes(text, p.x);
    append_bytes(text, p.y);
    append_bytes(text, p.z);
  }
  for (const Polygon& polygon : polygons) {
    append_bytes(text, static_cast<uint32_t>(polygon.loop.size()));
    for (const uint32_t v : polygon.loop) append_bytes(text, v);
    if (!has_colours) continue;
    const Appearance& a = look(polygon);
    for (const float c : {a.red, a.green, a.blue, a.alpha}) append_bytes(text, colour_byte(c));
  }
  return text;
}

}  // namespace csgrun

// OFF: vertices, then polygons as lists of 0-based indices, each with a colour if it wants one.
#include "export/encoders.h"
#include "export/palette.h"
#include "export/polygons.h"
#include "export/text.h"

namespace csgrun {
namespace {

void append_colour(std::string& text, const Appearance& appearance) {
  if (appearance.is_default) return;
  const auto append = [&text](float component) {
    text += ' ';
    append_number(text, uint64_t{colour_byte(component)});
  };
  append(appearance.red);
  append(appearance.green);
  append(appearance.blue);
  if (appearance.alpha < 1) append(appearance.alpha);
}

}  // namespace

Result<std::string> encode_off(const Part& part, MeshMaker& maker) {
  Result<RoundedMesh> mesh = maker.make(part, part.placement, Precision::kDouble, true);
  if (!mesh) return mesh.error();
  maker.report_rounding();
  const std::vector<Polygon> polygons = polygons_of(*mesh);

  std::string text = "OFF\n";
  append_number(text, uint64_t{mesh->positions.size()});
  text += ' ';
  append_number(text, uint64_t{polygons.size()});
  text += " 0\n";
  for (const glm::dvec3& p : mesh->positions) {
    append_number(text, p.x);
    text += ' ';
    append_number(text, p.y);
    text += ' ';
    append_number(text, p.z);
    text += '\n';
  }
  for (const Polygon& polygon : polygons) {
    append_number(text, uint64_t{polygon.loop.size()});
    for (const uint32_t v : polygon.loop) {
      text += ' ';
      append_number(text, uint64_t{v});
    }
    append_colour(text, part.solid->appearances[part.solid->faces[polygon.face].appearance]);
    text += '\n';
  }
  return text;
}

}  // namespace csgrun

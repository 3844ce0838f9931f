// OBJ with its material file: vertices are numbered from 1 through the whole file.
#include <algorithm>
#include <array>
#include <set>
#include <string>

#include "export/encoders.h"
#include "export/palette.h"
#include "export/polygons.h"
#include "export/text.h"

namespace csgrun {
namespace {

/// "case/lid" is the object "case/lid" in the groups "case" and "lid". Names that differ only in
/// what a word cannot have get numbers.
void append_names(std::string& text, const std::string& name, std::set<std::string>& taken) {
  const std::string word = distinct(one_word(name), taken);
  text += "o " + word + '\n';
  const size_t slash = word.find('/');
  if (slash == std::string::npos) return;
  std::string groups = word;
  std::replace(groups.begin(), groups.end(), '/', ' ');
  text += "g " + groups + '\n';
}

void append_vertices(std::string& text, const RoundedMesh& mesh) {
  for (const glm::dvec3& p : mesh.positions) {
    text += "v ";
    append_number(text, p.x);
    text += ' ';
    append_number(text, p.y);
    text += ' ';
    append_number(text, p.z);
    text += '\n';
  }
}

/// Faces in runs of one material and one source, each run under a comment that names the source.
void append_faces(std::string& text, const Solid& solid, const RoundedMesh& mesh,
                  std::span<const uint32_t> materials, const Palette* palette,
                  uint64_t first_vertex) {
  std::vector<Polygon> polygons = polygons_of(mesh);
  const auto run = [&](const Polygon& p) {
    const Solid::Face& face = solid.faces[p.face];
    return std::pair(materials[face.appearance], face.source);
  };
  std::stable_sort(polygons.begin(), polygons.end(),
                   [&](const Polygon& a, const Polygon& b) { return run(a) < run(b); });
  for (size_t i = 0; i < polygons.size(); ++i) {
    const auto [material, source] = run(polygons[i]);
    const bool new_material = i == 0 || run(polygons[i - 1]).first != material;
    if (palette && new_material) text += "usemtl " + palette->names()[material] + '\n';
    if (i == 0 || run(polygons[i - 1]) != run(polygons[i])) {
      const std::string made_by = source_text(solid, source);
      if (!made_by.empty()) text += "# faces of " + made_by + '\n';
    }
    text += 'f';
    for (const uint32_t v : polygons[i].loop) {
      text += ' ';
      append_number(text, first_vertex + v);
    }
    text += '\n';
  }
}

std::string material_file(const Palette& palette) {
  std::string text = "# csgrun " CSGRUN_VERSION "\n";
  for (size_t m = 0; m < palette.appearances().size(); ++m) {
    const Appearance& a = palette.appearances()[m];
    const auto line = [&](const char* key, std::initializer_list<float> values) {
      text += key;
      for (const float value : values) {
        text += ' ';
        append_number(text, rounded_to_millionths(value));
      }
      text += '\n';
    };
    text += "newmtl " + palette.names()[m] + '\n';
    line("Kd", {a.red, a.green, a.blue});
    line("d", {a.alpha});
    line("Pm", {a.metallic});
    line("Pr", {a.roughness});
  }
  return text;
}

}  // namespace

Result<ObjFiles> encode_obj(const Parts& parts, const std::string& mtl_name, MeshMaker& maker) {
  Palette palette;
  ObjFiles files;
  files.obj = "# csgrun " CSGRUN_VERSION ", millimetres, Z up\n";
  if (!mtl_name.empty()) files.obj += "mtllib " + one_line(mtl_name) + '\n';
  uint64_t first_vertex = 1;
  std::set<std::string> taken;
  for (const Part& part : parts) {
    const Solid& solid = *part.solid;
    Result<RoundedMesh> mesh = maker.make(part, part.placement, Precision::kDouble, true);
    if (!mesh) return mesh.error();
    append_names(files.obj, part.name, taken);
    append_vertices(files.obj, *mesh);
    append_faces(files.obj, solid, *mesh, palette.add(solid), mtl_name.empty() ? nullptr : &palette,
                 first_vertex);
    first_vertex += mesh->positions.size();
  }
  maker.report_rounding();
  files.mtl = material_file(palette);
  return files;
}

}  // namespace csgrun

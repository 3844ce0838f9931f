// 3MF: one object a part, in millimetres, with the colours of its faces.
//
// Colours are base materials, which every program reads; metallic and roughness go with them as the
// materials extension has it, where they are others than the default's. Triangles of the object's
// own material (that of most of them) say nothing; others name theirs.
//
// 3MF Core Specification 1.3, sections 3 to 5; Materials and Properties Extension 1.2, section 7.
#include <algorithm>

#include "export/encoders.h"
#include "export/palette.h"
#include "export/text.h"
#include "export/zip_file.h"

namespace csgrun {
namespace {

constexpr char kContentTypes[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">"
    "<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>"
    "<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/></Types>\n";
constexpr char kRelationships[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    "<Relationship Target=\"/3D/3dmodel.model\" Id=\"model\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>\n";
constexpr char kModelStart[] =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<model unit=\"millimeter\" xml:lang=\"en-US\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\" "
    "xmlns:m=\"http://schemas.microsoft.com/3dmanufacturing/material/2015/02\">\n"
    "<metadata name=\"Application\">csgrun " CSGRUN_VERSION "</metadata>\n<resources>\n";
constexpr uint64_t kDisplayId = 1, kMaterialsId = 2, kFirstObjectId = 3;

void append_colour(std::string& text, const Appearance& appearance) {
  text += '#';
  for (const float c : {appearance.red, appearance.green, appearance.blue, appearance.alpha}) {
    const uint8_t byte = colour_byte(c);
    text += "0123456789ABCDEF"[byte / 16];
    text += "0123456789ABCDEF"[byte % 16];
  }
}

void append_attribute(std::string& text, const char* name, auto value) {
  text += ' ';
  text += name;
  text += "=\"";
  append_number(text, value);
  text += '"';
}

void append_materials(std::string& text, const Palette& palette) {
  const auto& looks = palette.appearances();
  const bool is_plain = std::all_of(looks.begin(), looks.end(), [](const Appearance& a) {
    return a.metallic == Appearance{}.metallic && a.roughness == Appearance{}.roughness;
  });
  if (!is_plain) {
    text += "<m:pbmetallicdisplayproperties";
    append_attribute(text, "id", kDisplayId);
    text += ">\n";
    for (size_t m = 0; m < looks.size(); ++m) {
      text += "<m:pbmetallic name=\"";
      text += xml_text(palette.names()[m]);
      text += '"';
      append_attribute(text, "metallicness",
                       rounded_to_millionths(std::clamp(looks[m].metallic, 0.0f, 1.0f)));
      append_attribute(text, "roughness",
                       rounded_to_millionths(std::clamp(looks[m].roughness, 0.0f, 1.0f)));
      text += "/>\n";
    }
    text += "</m:pbmetallicdisplayproperties>\n";
  }
  text += "<basematerials";
  append_attribute(text, "id", kMaterialsId);
  if (!is_plain) append_attribute(text, "displaypropertiesid", kDisplayId);
  text += ">\n";
  for (size_t m = 0; m < looks.size(); ++m) {
    text += "<base name=\"";
    text += xml_text(palette.names()[m]);
    text += "\" displaycolor=\"";
    append_colour(text, looks[m]);
    text += "\"/>\n";
  }
  text += "</basematerials>\n";
}

/// The material of most triangles, the first of these.
uint32_t commonest(const RoundedMesh& mesh, const Solid& solid,
                   const std::vector<uint32_t>& materials) {
  std::vector<size_t> count(1, 0);
  for (const uint32_t face : mesh.triangle_face) {
    const uint32_t material = materials[solid.faces[face].appearance];
    if (material >= count.size()) count.resize(material + 1, 0);
    ++count[material];
  }
  return static_cast<uint32_t>(std::max_element(count.begin(), count.end()) - count.begin());
}

void append_object(std::string& text, const Part& part, const RoundedMesh& mesh,
                   const std::vector<uint32_t>& materials, uint64_t id) {
  const Solid& solid = *part.solid;
  const uint32_t own = commonest(mesh, solid, materials);
  text += "<object";
  append_attribute(text, "id", id);
  text += " type=\"model\" name=\"";
  text += xml_text(part.name);
  text += '"';
  append_attribute(text, "pid", kMaterialsId);
  append_attribute(text, "pindex", uint64_t{own});
  text += "><mesh>\n<vertices>\n";
  for (const glm::dvec3& p : mesh.positions) {
    text += "<vertex";
    append_attribute(text, "x", p.x);
    append_attribute(text, "y", p.y);
    append_attribute(text, "z", p.z);
    text += "/>\n";
  }
  text += "</vertices>\n<triangles>\n";
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    text += "<triangle";
    append_attribute(text, "v1", uint64_t{mesh.triangles[t][0]});
    append_attribute(text, "v2", uint64_t{mesh.triangles[t][1]});
    append_attribute(text, "v3", uint64_t{mesh.triangles[t][2]});
    const uint32_t material = materials[solid.faces[mesh.triangle_face[t]].appearance];
    if (material != own) {
      append_attribute(text, "pid", kMaterialsId);
      append_attribute(text, "p1", uint64_t{material});
    }
    text += "/>\n";
  }
  text += "</triangles>\n</mesh></object>\n";
}

}  // namespace

Result<std::string> encode_3mf(const Parts& parts, MeshMaker& maker) {
  Palette palette;
  std::string objects, items;
  uint64_t id = kFirstObjectId;
  for (const Part& part : parts) {
    Result<RoundedMesh> mesh = maker.make(part, part.placement, Precision::kDouble, false);
    if (!mesh) return mesh.error();
    if (mesh->triangles.empty()) continue;  // a mesh must have some; it is warned of
    append_object(objects, part, *mesh, palette.add(*part.solid), id);
    items += "<item";
    append_attribute(items, "objectid", id++);
    items += "/>\n";
  }
  maker.report_rounding();
  std::string model = kModelStart;
  if (!palette.appearances().empty()) append_materials(model, palette);
  model += objects + "</resources>\n<build>\n" + items + "</build>\n</model>\n";
  return zip_file({{"[Content_Types].xml", kContentTypes},
                   {"_rels/.rels", kRelationships},
                   {"3D/3dmodel.model", std::move(model)}});
}

}  // namespace csgrun

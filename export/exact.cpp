// JSON with exact coordinates: fractions in millimetres, faces as polygons, one line for each point
// and face, so that two files can be compared line by line.
#include <nlohmann/json.hpp>

#include "export/encoders.h"
#include "export/text.h"

namespace csgrun {
namespace {

std::string quoted(const std::string& text) { return nlohmann::json(valid_utf8(text)).dump(); }

void append_list(std::string& text, const char* name, const std::vector<std::string>& items) {
  text += std::string("\"") + name + "\":[";
  for (size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "\n" : ",\n") + items[i];
  text += "]";
}

std::string face_text(const Solid& solid, const Solid::Face& face) {
  std::string text = "{\"loops\":[";
  for (uint32_t loop = face.first_loop; loop < face.first_loop + face.loop_count; ++loop) {
    text += loop == face.first_loop ? "[" : ",[";
    for (uint32_t i = solid.loop_starts[loop]; i < solid.loop_starts[loop + 1]; ++i) {
      if (i > solid.loop_starts[loop]) text += ',';
      append_number(text, uint64_t{solid.loop_vertices[i]});
    }
    text += ']';
  }
  text += "],\"appearance\":";
  append_number(text, uint64_t{face.appearance});
  text += ",\"surface\":";
  append_number(text, uint64_t{face.surface});
  text += ",\"source\":";
  append_number(text, uint64_t{face.source});
  return text + '}';
}

std::string appearance_text(const Appearance& a) {
  std::string text = "{\"name\":" + quoted(a.name) + ",\"color\":[";
  for (const float component : {a.red, a.green, a.blue, a.alpha}) {
    if (text.back() != '[') text += ',';
    append_number(text, double{component});
  }
  text += "],\"metallic\":";
  append_number(text, double{a.metallic});
  text += ",\"roughness\":";
  append_number(text, double{a.roughness});
  text += a.is_default ? ",\"default\":true}" : ",\"default\":false}";
  return text;
}

std::string part_text(const Part& part) {
  const Solid& solid = *part.solid;
  std::vector<std::string> points, faces, appearances, sources;
  for (const uint32_t point : solid.point_of) {
    const auto& [x, y, z] = solid.exact_points[point];
    points.push_back("[\"" + x + "\",\"" + y + "\",\"" + z + "\"]");
  }
  for (const Solid::Face& face : solid.faces) faces.push_back(face_text(solid, face));
  for (const Appearance& a : solid.appearances) appearances.push_back(appearance_text(a));
  for (const Solid::Source& s : solid.sources)
    sources.push_back("{\"kind\":" + quoted(s.kind) + ",\"where\":" + quoted(s.where) + '}');
  std::string text = "{\"name\":" + quoted(part.name) + ",\n";
  append_list(text, "points", points);
  text += ",\n";
  append_list(text, "faces", faces);
  text += ",\n";
  append_list(text, "appearances", appearances);
  text += ",\n";
  append_list(text, "sources", sources);
  return text + '}';
}

}  // namespace

Result<std::string> encode_exact(const Parts& parts) {
  std::string text = "{\"format\":\"csgrun exact mesh\",\"version\":1,\"unit\":\"mm\",\n";
  std::vector<std::string> list;
  for (const Part& part : parts) {
    const auto refused = [&](const std::string& why) {
      return Error{ErrorCode::kInvalidArgument, "part '" + part.name + "' " + why, {}};
    };
    if (!(part.placement == Affine{})) {
      return refused("has a placement, which a file of exact coordinates has no room for");
    }
    for (const uint32_t point : part.solid->point_of) {
      if (point >= part.solid->exact_points.size() || part.solid->exact_points[point][0].empty()) {
        return refused("was evaluated without EvaluateOptions::exact_points");
      }
    }
    list.push_back(part_text(part));
  }
  append_list(text, "parts", list);
  return text + "}\n";
}

}  // namespace csgrun

// The material files of OBJ: colour, opacity, metallic and roughness; all else is passed over.
#include <algorithm>

#include <csgrun/primitives/model_file.h>

#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

/// `count` numbers from 0 to 1.
bool read_fractions(TextScanner& scanner, std::initializer_list<float*> places) {
  for (float* place : places) {
    const auto value = parse_finite(scanner.word());
    if (!value) return false;
    *place = static_cast<float>(std::clamp(*value, 0.0, 1.0));
  }
  return true;
}

}  // namespace

Status apply_materials(PolygonMesh& mesh, const std::string& name, std::string_view mtl,
                       std::set<std::string, std::less<>>* known) {
  TextScanner scanner(mtl, '#');
  Appearance* look = nullptr;  // of the material that is described; null: nobody uses it
  Appearance unused;
  do {
    const std::string_view word = scanner.word();
    bool good = true;
    if (word == "newmtl") {
      const std::string_view material = scanner.rest_of_line();
      if (known != nullptr) known->emplace(material);
      const auto used = std::find_if(mesh.appearances.begin(), mesh.appearances.end(),
                                     [&](const Appearance& a) { return a.name == material; });
      look = used == mesh.appearances.end() ? &unused : &*used;
      continue;
    }
    if (look == nullptr) continue;
    if (word == "Kd") {
      good = read_fractions(scanner, {&look->red, &look->green, &look->blue});
      look->is_default = false;
    } else if (word == "d") {
      good = read_fractions(scanner, {&look->alpha});
    } else if (word == "Tr") {
      good = read_fractions(scanner, {&look->alpha});
      look->alpha = 1 - look->alpha;
    } else if (word == "Pm") {
      good = read_fractions(scanner, {&look->metallic});
    } else if (word == "Pr") {
      good = read_fractions(scanner, {&look->roughness});
    }
    if (!good) return malformed(name, scanner.place(), quoted(word) + " needs finite numbers");
  } while (scanner.next_line());
  for (Appearance& each : mesh.appearances) {
    // Names that only say the colour, as our own files have them, say nothing.
    if (is_named_default(each)) each = Appearance{};
    if (each.name.starts_with('#')) each.name.clear();
  }
  return std::monostate{};
}

}  // namespace csgrun

#include "export/palette.h"

#include <algorithm>
#include <cmath>

#include "export/text.h"

namespace csgrun {
namespace {

std::string name_of(const Appearance& appearance) {
  if (!appearance.name.empty()) return one_word(valid_utf8(appearance.name));
  if (appearance.is_default) return "default";
  std::string name = "#";
  for (const float c : {appearance.red, appearance.green, appearance.blue}) {
    const uint8_t byte = colour_byte(c);
    name += "0123456789abcdef"[byte / 16];
    name += "0123456789abcdef"[byte % 16];
  }
  return name;
}

}  // namespace

double rounded_to_millionths(double value) { return std::round(value * 1e6) / 1e6; }

uint8_t colour_byte(float component) {
  return static_cast<uint8_t>(std::clamp(std::lround(255.0 * component), 0L, 255L));
}

std::vector<uint32_t> Palette::add(const Solid& solid) {
  constexpr uint32_t kUnseen = UINT32_MAX;
  std::vector<uint32_t> materials(solid.appearances.size(), kUnseen);
  for (const Solid::Face& face : solid.faces) {
    uint32_t& material = materials[face.appearance];
    if (material == kUnseen) material = material_of(solid.appearances[face.appearance]);
  }
  std::replace(materials.begin(), materials.end(), kUnseen, 0u);
  return materials;
}

uint32_t Palette::material_of(const Appearance& appearance) {
  const auto known = std::find(appearances_.begin(), appearances_.end(), appearance);
  if (known != appearances_.end()) return static_cast<uint32_t>(known - appearances_.begin());
  const std::string wanted = name_of(appearance);
  std::string name = wanted;
  for (int copy = 2; std::find(names_.begin(), names_.end(), name) != names_.end(); ++copy) {
    name = wanted + "_" + std::to_string(copy);
  }
  appearances_.push_back(appearance);
  names_.push_back(name);
  return static_cast<uint32_t>(appearances_.size() - 1);
}

}  // namespace csgrun

#include "engine/csg/appearance_table.h"

namespace csgrun {

bool is_in_range(const Appearance& appearance) {
  const Appearance& a = appearance;
  for (const float x : {a.red, a.green, a.blue, a.alpha, a.metallic, a.roughness}) {
    if (!(x >= 0 && x <= 1)) return false;  // nan, too
  }
  return true;
}

uint32_t AppearanceTable::intern(const Appearance& a) {
  KeyBuilder builder("appearance");
  // Adding 0 makes negative zero the same as zero, as operator== has it.
  for (float part : {a.red, a.green, a.blue, a.alpha, a.metallic, a.roughness}) {
    builder.number(part + 0.0f);
  }
  builder.number(a.is_default).text(a.name);
  const Key key = builder.key();
  const auto [found, is_new] = ids_.try_emplace(key, static_cast<uint32_t>(values_.size()));
  if (is_new) {
    values_.push_back(a);
    keys_.push_back(key);
  }
  return found->second;
}

}  // namespace csgrun

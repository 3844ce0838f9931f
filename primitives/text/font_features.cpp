// Features of OpenType in a font's description: "Liberation
// Sans:style=Bold:fontfeatures=-kern;+liga".
#include <csgrun/primitives/text.h>

#include "primitives/files/formats.h"
#include "primitives/text/harfbuzz.h"

namespace csgrun {
namespace {

bool is_feature(const std::string& text) {
  hb_feature_t feature;
  return hb().feature_from_string(text.data(), static_cast<int>(text.size()), &feature) != 0;
}

}  // namespace

FontFeatures split_font_features(const std::string& description) {
  constexpr const char* kField = ":fontfeatures=";
  FontFeatures result;
  size_t begin = 0;
  for (;;) {
    const size_t field = description.find(kField, begin);
    result.font += description.substr(begin, field - begin);
    if (field == std::string::npos) return result;
    const size_t end = std::min(description.find(':', field + 1), description.size());
    for (size_t at = field + std::string_view(kField).size(); at < end;) {
      const size_t stop = std::min(description.find_first_of(";,", at), end);
      const std::string feature = description.substr(at, stop - at);
      at = stop + 1;
      if (is_feature(feature)) {
        result.features.push_back(feature);
      } else if (!feature.empty() && result.note.empty()) {
        result.note = "there is no font feature " + csgrun::quoted(feature) +
                      ": one is written as \"+liga\", \"-kern\" or \"ss01=2\"";
      }
    }
    begin = end;
  }
}

}  // namespace csgrun

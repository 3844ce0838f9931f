#include "lua_bindings/nearest.h"

#include <algorithm>

namespace csgrun {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Twice the edit distance (so that a difference in case can cost a half).
int distance(std::string_view a, std::string_view b) {
  const size_t width = b.size() + 1;
  std::vector<int> before(width), above(width), row(width);
  for (size_t j = 0; j < width; ++j) above[j] = static_cast<int>(2 * j);
  for (size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<int>(2 * i);
    for (size_t j = 1; j < width; ++j) {
      const char x = a[i - 1], y = b[j - 1];
      const int change = x == y ? 0 : lower(x) == lower(y) ? 1 : 2;
      row[j] = std::min({above[j] + 2, row[j - 1] + 2, above[j - 1] + change});
      if (i > 1 && j > 1 && x == b[j - 2] && a[i - 2] == y)
        row[j] = std::min(row[j], before[j - 2] + 2);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

/// What other programs call things: of the language's names that one counts which is there.
struct Synonym {
  std::string_view word, name;
};
constexpr Synonym kSynonyms[] = {
    {"add", "union"},
    {"angle", "a"},
    {"bevel", "chamfer"},
    {"bounding_box", "bbox"},
    {"boundingbox", "bbox"},
    {"bounds", "bbox"},
    {"caption", "doc"},
    {"center", "centered"},
    {"centerofmass", "centroid"},
    {"centre", "center"},
    {"colorize", "color"},
    {"cut", "difference"},
    {"description", "doc"},
    {"diameter", "d"},
    {"dimensions", "size"},
    {"distance", "d"},
    {"expand", "offset"},
    {"extrude", "linear_extrude"},
    {"extrude_linear", "linear_extrude"},
    {"extrude_rotate", "rotate_extrude"},
    {"extrudefromslices", "loft"},
    {"extrudelinear", "linear_extrude"},
    {"extruderotate", "rotate_extrude"},
    {"facets", "fn"},
    {"fuse", "union"},
    {"getbounds", "bbox"},
    {"getmesh", "mesh"},
    {"getvolume", "volume"},
    {"initial", "default"},
    {"isempty", "is_empty"},
    {"length", "h"},
    {"mingap", "gap"},
    {"minus", "difference"},
    {"numcomponents", "components"},
    {"numtri", "mesh"},
    {"numvert", "mesh"},
    {"plus", "union"},
    {"radius", "r"},
    {"raycast", "ray"},
    {"revolve", "rotate_extrude"},
    {"rotate_x", "rx"},
    {"rotate_y", "ry"},
    {"rotate_z", "rz"},
    {"rotatex", "rx"},
    {"rotatey", "ry"},
    {"rotatez", "rz"},
    {"round", "fillet"},
    {"round", "offset"},  // of shapes, which have no fillet
    {"roundededges", "fillet"},
    {"scission", "decompose"},
    {"separate", "decompose"},
    {"splitbyplane", "split"},
    {"subtract", "difference"},
    {"surface_area", "area"},
    {"surfacearea", "area"},
    {"topolygons", "outlines"},
    {"transform", "multmatrix"},
    {"translate_x", "tx"},
    {"translate_y", "ty"},
    {"translate_z", "tz"},
    {"translatex", "tx"},
    {"translatey", "ty"},
    {"translatez", "tz"},
    {"trimbyplane", "trim"},
    {"values", "choices"},
};

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& names) {
  constexpr size_t kLongestWord = 64;  // nobody means a name that is longer than this
  if (word.empty() || word.size() > kLongestWord) return {};
  std::string folded(word);
  std::transform(folded.begin(), folded.end(), folded.begin(), lower);
  for (const Synonym& synonym : kSynonyms) {
    if (folded != synonym.word) continue;
    const auto known = std::find(names.begin(), names.end(), synonym.name);
    if (known != names.end()) return *known;
  }
  // One edit in three letters, at least one: "cub" is cube, "box" is not "rx". Of a single letter
  // nothing is left by an edit: "n" is not "d", but "R" is "r".
  const int limit =
      word.size() == 1 ? 1 : 2 * std::max<int>(1, static_cast<int>(word.size() + 1) / 3);
  std::string best;
  int best_distance = limit + 1;
  for (const std::string& name : names) {
    const int d = distance(word, name);
    if (d < best_distance || (d == best_distance && !best.empty() && name < best)) {
      best = name;
      best_distance = d;
    }
  }
  // Half of a name of several words: "extrude" is linear_extrude.
  constexpr size_t kShortestHalf = 4;
  const bool is_far = best.empty() && word.size() >= kShortestHalf;
  for (const std::string& name : names) {
    const bool is_half = name.size() > word.size() && name.ends_with(word) &&
                         name[name.size() - word.size() - 1] == '_';
    if (is_far && is_half && (best.empty() || name < best)) best = name;
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::string name = nearest_name(word, names);
  return name.empty() ? std::string() : " (did you mean '" + name + "'?)";
}

}  // namespace csgrun

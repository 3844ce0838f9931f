#include "tests/unit/primitives/dxf_text.h"

namespace csgrun::testing {

std::string pairs(const std::vector<std::pair<int, std::string>>& groups) {
  std::string text;
  for (const auto& [code, value] : groups)
    text += "  " + std::to_string(code) + "\r\n" + value + "\r\n";
  return text;
}

std::string entities(const std::string& content, const std::string& blocks) {
  return pairs({{0, "SECTION"}, {2, "BLOCKS"}}) + blocks +
         pairs({{0, "ENDSEC"}, {0, "SECTION"}, {2, "ENTITIES"}}) + content +
         pairs({{0, "ENDSEC"}, {0, "EOF"}});
}

std::string dxf_old_triangle(const std::string& flags) {
  return pairs({{0, "POLYLINE"},
                {70, flags},
                {0, "VERTEX"},
                {10, "0"},
                {20, "0"},
                {0, "VERTEX"},
                {10, "4"},
                {20, "0"},
                {0, "VERTEX"},
                {10, "4"},
                {20, "4"},
                {0, "SEQEND"}});
}

std::string dxf_line(double x0, double y0, double x1, double y1, const std::string& layer) {
  return pairs({{0, "LINE"},
                {8, layer},
                {10, std::to_string(x0)},
                {20, std::to_string(y0)},
                {11, std::to_string(x1)},
                {21, std::to_string(y1)}});
}

}  // namespace csgrun::testing

// SVG and DXF. Both are text; numbers are the shortest that read back as the same double.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include <csgrun/export/write_flat.h>

#include "export/text.h"

namespace csgrun {
namespace {

struct Bounds {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
};

Bounds bounds_of(const std::vector<FlatPart>& parts) {
  Bounds b;
  for (const FlatPart& part : parts) {
    for (const auto& loop : part.loops) {
      for (const glm::dvec2& p : loop) {
        b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y)};
        b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y)};
      }
    }
  }
  if (b.low.x > b.high.x) b.low = b.high = glm::dvec2(0);
  return b;
}

void append_point(std::string& text, const glm::dvec2& p) {
  append_number(text, p.x);
  text += ',';
  append_number(text, 0.0 - p.y);  // no negative zero
}

std::string hex_color(const std::array<float, 4>& color) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string text = "#";
  for (size_t i = 0; i < 3; ++i) {
    const auto byte = static_cast<unsigned>(
        std::lround(std::clamp(static_cast<double>(color[i]), 0.0, 1.0) * 255));
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string encode_svg(const std::vector<FlatPart>& parts) {
  const Bounds b = bounds_of(parts);
  const glm::dvec2 size = b.high - b.low;
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
      "version=\"1.1\" width=\"";
  append_number(text, size.x);
  text += "mm\" height=\"";
  append_number(text, size.y);
  text += "mm\" viewBox=\"";
  append_number(text, b.low.x);
  text += ' ';
  append_number(text, 0.0 - b.high.y);
  text += ' ';
  append_number(text, size.x);
  text += ' ';
  append_number(text, size.y);
  text += "\">\n<title>csgrun</title>\n";
  for (const FlatPart& part : parts) {
    // An id is one word; what the name really is, stands in the title.
    text += "<path id=\"" + xml_text(one_word(part.name)) + "\" fill-rule=\"evenodd\" fill=\"" +
            (part.color ? hex_color(*part.color) : "lightgray") + "\"";
    if (part.color && (*part.color)[3] < 1) {
      text += " fill-opacity=\"";
      append_number(text, static_cast<double>((*part.color)[3]));
      text += '"';
    }
    text += " stroke=\"black\" stroke-width=\"0.1\" d=\"";
    for (const auto& loop : part.loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        text += i == 0 ? "M" : i == 1 ? " L" : " ";
        append_point(text, loop[i]);
      }
      text += " Z\n";
    }
    text += "\"><title>" + xml_text(part.name) + "</title></path>\n";
  }
  return text + "</svg>\n";
}

/// DXF as AutoCAD 2000 has it: the oldest that knows LWPOLYLINE, and what everybody reads; with
/// colours as AutoCAD 2004 has it, the oldest that knows any colour but the numbered ones.
class DxfWriter {
 public:
  std::string text;

  void group(int code, const std::string& value) {
    text += std::to_string(code) + "\n" + value + "\n";
  }
  void group(int code, double value) {
    std::string number;
    append_number(number, value + 0.0);
    group(code, number);
  }
  void group(int code, int value) { group(code, std::to_string(value)); }
  /// Each object has a number of its own.
  void handle(int code = 5) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string digits;
    for (unsigned n = ++last_handle_; n != 0; n >>= 4)
      digits.insert(digits.begin(), kDigits[n & 15]);
    group(code, digits);
  }
  void section(const std::string& name) {
    group(0, std::string("SECTION"));
    group(2, name);
  }
  void end_section() { group(0, std::string("ENDSEC")); }

 private:
  unsigned last_handle_ = 0x10;
};

/// Layers are named by words without the characters that AutoCAD refuses; each name once.
std::vector<std::string> layer_names(const std::vector<FlatPart>& parts) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const FlatPart& part : parts) {
    std::string name = one_word(valid_utf8(part.name));
    for (char& c : name) {
      if (std::string("<>/\\\":;?*|=,`").find(c) != std::string::npos) c = '_';
    }
    if (name.empty()) name = "part";
    names.push_back(distinct(name, taken));
  }
  return names;
}

int byte_of(float channel) {
  return static_cast<int>(std::lround(std::clamp(static_cast<double>(channel), 0.0, 1.0) * 255));
}

/// The nearest of the seven colours that every program knows by number: 1 red, 2 yellow, 3 green,
/// 4 cyan, 5 blue, 6 magenta, 7 black or white.
int colour_number(const std::array<float, 4>& colour) {
  constexpr std::array<int, 8> kByBits{7, 1, 3, 2, 5, 6, 4, 7};  // red 1, green 2, blue 4
  size_t bits = 0;
  for (size_t i = 0; i < 3; ++i) bits |= static_cast<size_t>(colour[i] >= 0.5F) << i;
  return kByBits[bits];
}

/// The colour of a layer, as a number and as it is.
void append_colour(DxfWriter& w, const std::optional<std::array<float, 4>>& colour) {
  w.group(62, colour ? colour_number(*colour) : 7);
  w.group(6, std::string("CONTINUOUS"));
  if (!colour) return;
  w.group(420,
          byte_of((*colour)[0]) * 0x10000 + byte_of((*colour)[1]) * 0x100 + byte_of((*colour)[2]));
}

std::string encode_dxf(const std::vector<FlatPart>& parts) {
  const std::vector<std::string> layers = layer_names(parts);
  const bool has_colours = std::any_of(parts.begin(), parts.end(),
                                       [](const FlatPart& part) { return part.color.has_value(); });
  const Bounds b = bounds_of(parts);
  DxfWriter w;
  const std::string empty;
  w.section("HEADER");
  w.group(9, std::string("$ACADVER"));
  w.group(1, std::string(has_colours ? "AC1018" : "AC1015"));
  w.group(9, std::string("$INSUNITS"));
  w.group(70, 4);  // millimetres
  w.group(9, std::string("$HANDSEED"));
  w.group(5, std::string("FFFFFF"));
  for (const auto& [name, p] : {std::pair{"$EXTMIN", b.low}, std::pair{"$EXTMAX", b.high}}) {
    w.group(9, std::string(name));
    w.group(10, p.x);
    w.group(20, p.y);
    w.group(30, 0.0);
  }
  w.end_section();
  w.section("TABLES");
  w.group(0, std::string("TABLE"));
  w.group(2, std::string("LAYER"));
  w.handle();
  w.group(100, std::string("AcDbSymbolTable"));
  w.group(70, static_cast<int>(layers.size()));
  for (size_t i = 0; i < parts.size(); ++i) {
    w.group(0, std::string("LAYER"));
    w.handle();
    w.group(100, std::string("AcDbSymbolTableRecord"));
    w.group(100, std::string("AcDbLayerTableRecord"));
    w.group(2, layers[i]);
    w.group(70, 0);
    append_colour(w, parts[i].color);
  }
  w.group(0, std::string("ENDTAB"));
  w.end_section();
  w.section("ENTITIES");
  for (size_t i = 0; i < parts.size(); ++i) {
    for (const auto& loop : parts[i].loops) {
      w.group(0, std::string("LWPOLYLINE"));
      w.handle();
      w.group(100, std::string("AcDbEntity"));
      w.group(8, layers[i]);
      constexpr int kOpacity = 0x02000000;
      if (parts[i].color && (*parts[i].color)[3] < 1)
        w.group(440, kOpacity + byte_of((*parts[i].color)[3]));
      w.group(100, std::string("AcDbPolyline"));
      w.group(90, static_cast<int>(loop.size()));
      w.group(70, 1);  // closed
      for (const glm::dvec2& p : loop) {
        w.group(10, p.x);
        w.group(20, p.y);
      }
    }
  }
  w.end_section();
  w.group(0, std::string("EOF"));
  return w.text;
}

}  // namespace

std::string flat_format_of(const std::string& path) {
  if (path.size() < 4 || path[path.size() - 4] != '.') return {};
  std::string ending = path.substr(path.size() - 3);
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending == "svg" || ending == "dxf" ? ending : std::string();
}

Result<std::string> encode_flat(const std::string& format, const std::vector<FlatPart>& parts) {
  if (format == "svg") return encode_svg(parts);
  if (format == "dxf") return encode_dxf(parts);
  return Error{ErrorCode::kInvalidArgument, "no format of drawings: " + format, {}};
}

}  // namespace csgrun

// Text to outlines: HarfBuzz chooses and places the glyphs in the font's own whole units; the
// conversion to mm, the alignment and the curves are ours.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "primitives/base/text.h"
#include "primitives/files/formats.h"
#include "primitives/shape2d/shape_factory.h"
#include "primitives/text/font.h"

namespace csgrun {
namespace {

/// OpenSCAD sets type at 100 dpi for a point of 1/72 inch: an em is size * 100 / 72.
constexpr double kEmPerSize = 100.0 / 72;

/// The outline of one glyph, in units.
class GlyphPen {
 public:
  explicit GlyphPen(int steps) : steps_(steps) {}

  std::vector<Shape2D::Loop> loops;
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  void draw(hb_font_t* font, hb_codepoint_t glyph) {
    static hb_draw_funcs_t* const functions = make_functions();
#if HB_VERSION_ATLEAST(7, 0, 0)
    hb_font_draw_glyph(font, glyph, functions, this);
#else
    hb_font_get_glyph_shape(font, glyph, functions, this);
#endif
  }

 private:
  static hb_draw_funcs_t* make_functions() {
    hb_draw_funcs_t* f = hb_draw_funcs_create();
    hb_draw_funcs_set_move_to_func(
        f,
        [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float x, float y, void*) {
          static_cast<GlyphPen*>(pen)->move_to({x, y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_line_to_func(
        f,
        [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float x, float y, void*) {
          static_cast<GlyphPen*>(pen)->line_to({x, y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_quadratic_to_func(
        f,
        [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float cx, float cy, float x, float y,
           void*) {
          static_cast<GlyphPen*>(pen)->quadratic_to({cx, cy}, {x, y});
        },
        nullptr, nullptr);
    hb_draw_funcs_set_cubic_to_func(
        f,
        [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float ax, float ay, float bx, float by,
           float x, float y, void*) {
          static_cast<GlyphPen*>(pen)->cubic_to({ax, ay}, {bx, by}, {x, y});
        },
        nullptr, nullptr);
    hb_draw_funcs_make_immutable(f);
    return f;
  }

  void meet(const glm::dvec2& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }

  void move_to(const glm::dvec2& p) {
    loops.emplace_back();
    line_to(p);
  }

  void line_to(const glm::dvec2& p) {
    if (loops.empty()) loops.emplace_back();
    meet(p);
    loops.back().push_back(p);
  }

  void quadratic_to(const glm::dvec2& c, const glm::dvec2& p) {
    if (loops.empty() || loops.back().empty()) return;
    const glm::dvec2 a = loops.back().back();
    meet(c);
    for (int i = 1; i < steps_; ++i) {
      const double t = double(i) / steps_, s = 1 - t;
      line_to(s * s * a + 2 * s * t * c + t * t * p);
    }
    line_to(p);
  }

  void cubic_to(const glm::dvec2& c, const glm::dvec2& d, const glm::dvec2& p) {
    if (loops.empty() || loops.back().empty()) return;
    const glm::dvec2 a = loops.back().back();
    meet(c);
    meet(d);
    for (int i = 1; i < steps_; ++i) {
      const double t = double(i) / steps_, s = 1 - t;
      line_to(s * s * s * a + 3 * s * s * t * c + 3 * s * t * t * d + t * t * t * p);
    }
    line_to(p);
  }

  int steps_;
};

/// A line of text as outlines, in units, from the first glyph's origin.
struct Line {
  std::vector<Shape2D::Loop> loops;
  glm::dvec2 advance{};
  glm::dvec2 low{}, high{};       ///< of the ink
  double scale = 1;               ///< mm per unit
  glm::dvec2 offset{};            ///< of the alignment, in units
  std::vector<uint32_t> missing;  ///< characters without a glyph
};

std::optional<Error> check(const TextOptions& o) {
  if (!std::isfinite(o.size)) return not_finite("text", "size", o.size);
  if (!(o.size > 0)) return not_positive("text", "size", o.size);
  if (!std::isfinite(o.spacing)) return not_finite("text", "spacing", o.spacing);
  const auto one_of = [](const char* name, const std::string& value,
                         std::initializer_list<const char*> choices) -> std::optional<Error> {
    std::string list;
    for (const char* choice : choices) {
      if (value == choice) return std::nullopt;
      list += (list.empty() ? "" : ", ") + quoted(choice);
    }
    return invalid_argument("text: " + std::string(name) + " must be one of " + list + ", got " +
                            quoted(value));
  };
  if (!o.direction.empty()) {
    if (auto error = one_of("direction", o.direction, {"ltr", "rtl", "ttb", "btt"})) return error;
  }
  if (auto error = one_of("halign", o.halign, {"default", "left", "center", "right"})) return error;
  return one_of("valign", o.valign, {"default", "baseline", "bottom", "center", "top"});
}

/// "en" where nothing, or nothing that is a language, is given: never the locale's.
hb_language_t language_of(const std::string& name) {
  const hb_language_t given = hb_language_from_string(name.c_str(), static_cast<int>(name.size()));
  return given != HB_LANGUAGE_INVALID ? given : hb_language_from_string("en", -1);
}

HarfbuzzPtr<hb_buffer_t> shape(const TextOptions& o, const Font& font) {
  HarfbuzzPtr<hb_buffer_t> buffer(hb_buffer_create());
  hb_buffer_add_utf8(buffer.get(), o.text.data(), static_cast<int>(o.text.size()), 0,
                     static_cast<int>(o.text.size()));
  if (!o.direction.empty()) {
    hb_buffer_set_direction(buffer.get(), hb_direction_from_string(o.direction.c_str(), -1));
  }
  if (!o.script.empty()) {
    hb_buffer_set_script(buffer.get(), hb_script_from_string(o.script.c_str(), -1));
  }
  hb_buffer_set_language(buffer.get(), language_of(o.language));
  hb_buffer_guess_segment_properties(buffer.get());
  hb_shape(font.data().font.get(), buffer.get(), nullptr, 0);
  return buffer;
}

/// The code point at byte `at` of a text, for messages only.
uint32_t code_point_at(const std::string& text, size_t at) {
  const auto byte = [&](size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(at);
  const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  uint32_t code = more == 0 ? first : first & (0x3fu >> more);
  for (int i = 1; i <= more; ++i) code = code << 6 | (byte(at + static_cast<size_t>(i)) & 0x3f);
  return code;
}

void align(const TextOptions& o, bool horizontal, Line& line) {
  const glm::dvec2 &low = line.low, &high = line.high, &advance = line.advance;
  glm::dvec2& offset = line.offset;
  if (horizontal) {
    if (o.halign == "center") offset.x = -advance.x / 2;
    if (o.halign == "right") offset.x = -advance.x;
    if (o.valign == "top") offset.y = -high.y;
    if (o.valign == "center") offset.y = -(high.y + low.y) / 2;
    if (o.valign == "bottom") offset.y = -low.y;
    return;
  }
  // Glyphs of a column stand with their middle on it, below the origin.
  if (o.halign == "left") offset.x = -low.x;
  if (o.halign == "right") offset.x = -high.x;
  if (o.valign == "center") offset.y = -advance.y / 2;
  if (o.valign == "bottom") offset.y = -advance.y;
}

Result<Line> lay_out(const TextOptions& o, const Font& font) {
  if (auto error = check(o)) return *error;
  constexpr size_t kLongest = 1 << 16;
  if (o.text.size() > kLongest) {
    return invalid_argument("text: longer than " + std::to_string(kLongest) + " bytes");
  }
  const HarfbuzzPtr<hb_buffer_t> buffer = shape(o, font);
  const unsigned count = hb_buffer_get_length(buffer.get());
  const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), nullptr);
  const hb_glyph_position_t* places = hb_buffer_get_glyph_positions(buffer.get(), nullptr);
  const int steps = std::max(o.facets.fragments(o.size) / 8 + 1, 2);
  constexpr int kMostSteps = 1 << 14;
  if (steps > kMostSteps) {
    return invalid_argument("text: a curve of " + std::to_string(steps) + " steps, the limit is " +
                            std::to_string(kMostSteps));
  }
  Line line;
  line.scale = o.size * kEmPerSize / font.data().units_per_em;
  line.low = glm::dvec2(std::numeric_limits<double>::infinity());
  line.high = -line.low;
  for (unsigned i = 0; i < count; ++i) {
    if (infos[i].codepoint == 0) line.missing.push_back(code_point_at(o.text, infos[i].cluster));
    GlyphPen pen(steps);
    pen.draw(font.data().font.get(), infos[i].codepoint);
    const glm::dvec2 at = line.advance + glm::dvec2(places[i].x_offset, places[i].y_offset);
    for (Shape2D::Loop& loop : pen.loops) {
      for (glm::dvec2& p : loop) p += at;
      line.loops.push_back(std::move(loop));
    }
    if (pen.low.x <= pen.high.x) {
      line.low = {std::min(line.low.x, pen.low.x + at.x), std::min(line.low.y, pen.low.y + at.y)};
      line.high = {std::max(line.high.x, pen.high.x + at.x),
                   std::max(line.high.y, pen.high.y + at.y)};
    }
    line.advance += o.spacing * glm::dvec2(places[i].x_advance, places[i].y_advance);
  }
  if (line.loops.empty()) line.low = line.high = glm::dvec2(0);
  align(o, HB_DIRECTION_IS_HORIZONTAL(hb_buffer_get_direction(buffer.get())), line);
  return line;
}

}  // namespace

Result<Shape2D> make_text(const TextOptions& options, const Font& font, std::string* note) {
  Result<Line> line = lay_out(options, font);
  if (!line) return line.error();
  if (note != nullptr && !line->missing.empty()) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string code;
    for (uint32_t c = line->missing[0], i = 0; i < 4 || c != 0; c >>= 4, ++i)
      code.insert(code.begin(), kDigits[c & 15]);
    *note = "text: the font " + font.family() + " has no glyph for U+" + code;
    if (line->missing.size() > 1)
      *note += " and " + std::to_string(line->missing.size() - 1) + " more characters";
  }
  for (Shape2D::Loop& loop : line->loops) {
    for (glm::dvec2& p : loop) p = (p + line->offset) * line->scale;
  }
  return Shape2D::from_outlines(line->loops, FillRule::kNonZero);
}

Result<TextMetrics> measure_text(const TextOptions& options, const Font& font) {
  const Result<Line> line = lay_out(options, font);
  if (!line) return line.error();
  TextMetrics metrics;
  metrics.position = (line->low + line->offset) * line->scale;
  metrics.size = (line->high - line->low) * line->scale;
  metrics.ascent = line->high.y * line->scale;
  metrics.descent = line->low.y * line->scale;
  metrics.offset = line->offset * line->scale;
  metrics.advance = line->advance * line->scale;
  return metrics;
}

}  // namespace csgrun

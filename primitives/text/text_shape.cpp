// Text to outlines: HarfBuzz chooses and places the glyphs in the font's own whole units; the
// conversion to mm, the lines, the alignment and the curves are ours.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include <glm/common.hpp>

#include "primitives/base/text.h"
#include "primitives/files/formats.h"
#include "primitives/shape2d/shape_factory.h"
#include "primitives/text/font.h"

namespace csgrun {
namespace {

/// OpenSCAD sets type at 100 dpi for a point of 1/72 inch: an em is size * 100 / 72.
constexpr double kEmPerSize = 100.0 / 72;

/// OpenSCAD's font library scales the points of a font to whole type units before anything else.
class TypeUnits {
 public:
  /// `outline_em` type units for the font's units of an em.
  TypeUnits(int outline_em, double units_per_em)
      : factor_(std::llround(outline_em * kOne / units_per_em)) {}

  [[nodiscard]] glm::dvec2 of(const glm::dvec2& p) const { return {of(p.x), of(p.y)}; }

  /// Where a font leaves out the point between two control points.
  static glm::dvec2 between(const glm::dvec2& a, const glm::dvec2& b) {
    return {std::trunc((a.x + b.x) / 2), std::trunc((a.y + b.y) / 2)};
  }

 private:
  static constexpr double kOne = 65536;
  [[nodiscard]] double of(double units) const {
    return static_cast<double>(std::llround(units * static_cast<double>(factor_) / kOne));
  }
  int64_t factor_;  ///< type units per unit, in 65536ths
};

/// The outline of one glyph, in units, or in type units.
class GlyphPen {
 public:
  GlyphPen(int steps, std::optional<TypeUnits> type_units)
      : steps_(steps), type_units_(type_units) {}

  std::vector<Shape2D::Loop> loops;
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};

  void draw(hb_font_t* font, hb_codepoint_t glyph) {
    static hb_draw_funcs_t* const functions = make_functions();
#if HB_VERSION_ATLEAST(7, 0, 0)
    hb().font_draw_glyph(font, glyph, functions, this);
#else
    hb().font_get_glyph_shape(font, glyph, functions, this);
#endif
    end_contour();
  }

 private:
  /// From the end of the one before, with as many control points as `count` says.
  struct Stroke {
    int count = 0;
    glm::dvec2 control[2]{};
    glm::dvec2 end{};
  };

  static hb_draw_funcs_t* make_functions() {
    hb_draw_funcs_t* f = hb().draw_funcs_create();
    hb().draw_funcs_set_move_to_func(
        f,
        [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float x, float y, void*) {
          static_cast<GlyphPen*>(pen)->move_to({x, y});
        },
        nullptr, nullptr);
    hb().draw_funcs_set_line_to_func(
        f,
        [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float x, float y, void*) {
          static_cast<GlyphPen*>(pen)->strokes_.push_back({0, {}, {x, y}});
        },
        nullptr, nullptr);
    hb().draw_funcs_set_quadratic_to_func(
        f,
        [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float cx, float cy, float x, float y,
           void*) {
          static_cast<GlyphPen*>(pen)->strokes_.push_back({1, {{cx, cy}, {}}, {x, y}});
        },
        nullptr, nullptr);
    hb().draw_funcs_set_cubic_to_func(
        f,
        [](hb_draw_funcs_t*, void* pen, hb_draw_state_t*, float ax, float ay, float bx, float by,
           float x, float y, void*) {
          static_cast<GlyphPen*>(pen)->strokes_.push_back({2, {{ax, ay}, {bx, by}}, {x, y}});
        },
        nullptr, nullptr);
    hb().draw_funcs_make_immutable(f);
    return f;
  }

  void move_to(const glm::dvec2& p) {
    end_contour();
    start_ = p;
  }

  void end_contour() {
    if (strokes_.empty()) return;
    if (type_units_) round_strokes();
    loops.emplace_back();
    add(start_);
    for (const Stroke& stroke : strokes_) append(stroke);
    strokes_.clear();
  }

  void round_strokes() {
    const size_t n = strokes_.size();
    std::vector<Stroke> rounded = strokes_;
    for (Stroke& stroke : rounded) {
      for (int k = 0; k < stroke.count; ++k) stroke.control[k] = type_units_->of(stroke.control[k]);
      stroke.end = type_units_->of(stroke.end);
    }
    const bool closed = start_ == strokes_.back().end;
    start_ = type_units_->of(start_);
    for (size_t i = 0; i < n; ++i) {
      const size_t next = (i + 1) % n;
      if ((next == 0 && !closed) || strokes_[i].count != 1 || strokes_[next].count != 1) continue;
      const bool left_out =
          2.0 * strokes_[i].end == strokes_[i].control[0] + strokes_[next].control[0];
      if (!left_out) continue;
      rounded[i].end = TypeUnits::between(rounded[i].control[0], rounded[next].control[0]);
      if (next == 0) start_ = rounded[i].end;
    }
    strokes_ = std::move(rounded);
  }

  void meet(const glm::dvec2& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }

  void add(const glm::dvec2& p) {
    meet(p);
    loops.back().push_back(p);
  }

  void append(const Stroke& stroke) {
    const glm::dvec2 a = loops.back().back(), &c = stroke.control[0], &d = stroke.control[1],
                     &p = stroke.end;
    for (int k = 0; k < stroke.count; ++k) meet(stroke.control[k]);
    for (int i = 1; i < steps_ && stroke.count > 0; ++i) {
      const double t = double(i) / steps_, s = 1 - t;
      add(stroke.count == 1
              ? s * s * a + 2 * s * t * c + t * t * p
              : s * s * s * a + 3 * s * s * t * c + 3 * s * t * t * d + t * t * t * p);
    }
    add(p);
  }

  int steps_;
  std::optional<TypeUnits> type_units_;
  glm::dvec2 start_{};
  std::vector<Stroke> strokes_;  ///< of the contour that is being drawn
};

/// Lines of text as outlines, in units, from the origin of the first glyph of the first line.
struct Block {
  std::vector<Shape2D::Loop> loops;
  glm::dvec2 advance{};           ///< of the first line; across it that of the longest
  glm::dvec2 low{}, high{};       ///< of the ink
  double scale = 1;               ///< mm per unit
  glm::dvec2 offset{};            ///< of the alignment of the first line, in units
  std::vector<uint32_t> missing;  ///< characters without a glyph
};

std::optional<Error> check(const TextOptions& o) {
  if (!std::isfinite(o.size)) return not_finite("text", "size", o.size);
  if (!(o.size > 0)) return not_positive("text", "size", o.size);
  if (!std::isfinite(o.spacing)) return not_finite("text", "spacing", o.spacing);
  if (!std::isfinite(o.line_spacing)) return not_finite("text", "line_spacing", o.line_spacing);
  const auto one_of = [](const char* name, const std::string& value,
                         std::initializer_list<const char*> choices) -> std::optional<Error> {
    std::string list;
    for (const char* choice : choices) {
      if (value == choice) return std::nullopt;
      list += (list.empty() ? "" : ", ") + csgrun::quoted(choice);
    }
    return invalid_argument("text: " + std::string(name) + " must be one of " + list + ", got " +
                            csgrun::quoted(value));
  };
  if (!o.direction.empty()) {
    if (auto error = one_of("direction", o.direction, {"ltr", "rtl", "ttb", "btt"})) return error;
  }
  // "default" is what stands there where nothing was given.
  if (o.halign != "default") {
    if (auto error = one_of("halign", o.halign, {"left", "center", "right"})) return error;
  }
  if (o.valign == "default") return std::nullopt;
  return one_of("valign", o.valign, {"baseline", "bottom", "center", "top"});
}

/// "en" where nothing, or nothing that is a language, is given: never the locale's.
hb_language_t language_of(const std::string& name) {
  const hb_language_t given =
      hb().language_from_string(name.c_str(), static_cast<int>(name.size()));
  return given != HB_LANGUAGE_INVALID ? given : hb().language_from_string("en", -1);
}

/// The code of a script: that of ISO 15924, or its name in English; nothing for what is neither.
std::optional<hb_script_t> script_of(const std::string& name) {
  struct Named {
    const char* name;
    hb_script_t script;
  };
  static constexpr Named kNamed[] = {
      {"latin", HB_SCRIPT_LATIN},       {"arabic", HB_SCRIPT_ARABIC},
      {"armenian", HB_SCRIPT_ARMENIAN}, {"bengali", HB_SCRIPT_BENGALI},
      {"common", HB_SCRIPT_COMMON},     {"cyrillic", HB_SCRIPT_CYRILLIC},
      {"georgian", HB_SCRIPT_GEORGIAN}, {"devanagari", HB_SCRIPT_DEVANAGARI},
      {"greek", HB_SCRIPT_GREEK},       {"han", HB_SCRIPT_HAN},
      {"hangul", HB_SCRIPT_HANGUL},     {"hebrew", HB_SCRIPT_HEBREW},
      {"hiragana", HB_SCRIPT_HIRAGANA}, {"katakana", HB_SCRIPT_KATAKANA},
      {"tamil", HB_SCRIPT_TAMIL},       {"thai", HB_SCRIPT_THAI},
  };
  std::string lower = name;
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  for (const Named& named : kNamed) {
    if (lower == named.name) return named.script;
  }
  const bool is_code = lower.size() == 4 &&
                       lower.find_first_not_of("abcdefghijklmnopqrstuvwxyz") == std::string::npos;
  if (!is_code) return std::nullopt;
  return hb().script_from_string(lower.data(), static_cast<int>(lower.size()));
}

/// With units as the places of glyphs have.
hb_font_t* shaping_font(const TextOptions& o, const Font& font) {
  return (o.as_openscad_rounds ? font.data().in_type_units : font.data().font).get();
}

/// The glyphs of one line and their places.
Result<HarfbuzzPtr<hb_buffer_t>> shape(const TextOptions& o, std::string_view line,
                                       const Font& font) {
  constexpr hb_codepoint_t kBroken = ~hb_codepoint_t(0);  // where there is no character
  HarfbuzzPtr<hb_buffer_t> buffer(hb().buffer_create());
  hb().buffer_set_replacement_codepoint(buffer.get(), kBroken);
  hb().buffer_add_utf8(buffer.get(), line.data(), static_cast<int>(line.size()), 0,
                       static_cast<int>(line.size()));
  const hb_glyph_info_t* characters = hb().buffer_get_glyph_infos(buffer.get(), nullptr);
  for (unsigned i = 0; i < hb().buffer_get_length(buffer.get()); ++i) {
    if (characters[i].codepoint != kBroken) continue;
    return invalid_argument("text: it is not in UTF-8: byte " +
                            std::to_string(characters[i].cluster + 1) + " of " +
                            csgrun::quoted(line));
  }
  if (!o.direction.empty()) {
    hb().buffer_set_direction(buffer.get(), hb().direction_from_string(o.direction.c_str(), -1));
  }
  if (!o.script.empty()) {
    const auto script = script_of(o.script);
    if (!script) {
      return invalid_argument(
          "text: script must be a code of four letters, as \"Latn\", or a name, as \"latin\", "
          "got " +
          csgrun::quoted(o.script));
    }
    hb().buffer_set_script(buffer.get(), *script);
  }
  hb().buffer_set_language(buffer.get(), language_of(o.language));
  hb().buffer_guess_segment_properties(buffer.get());
  std::vector<hb_feature_t> features;
  for (const std::string& text : o.features) {
    hb_feature_t feature;
    const int length = static_cast<int>(text.size());
    if (hb().feature_from_string(text.data(), length, &feature) != 0) features.push_back(feature);
  }
  hb().shape(shaping_font(o, font), buffer.get(), features.data(),
             static_cast<unsigned>(features.size()));
  return buffer;
}

/// The code point at byte `at` of a text, for messages only.
uint32_t code_point_at(std::string_view text, size_t at) {
  const auto byte = [&](size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const unsigned first = byte(at);
  const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
  uint32_t code = more == 0 ? first : first & (0x3fu >> more);
  for (int i = 1; i <= more; ++i) code = code << 6 | (byte(at + static_cast<size_t>(i)) & 0x3f);
  return code;
}

/// Where a line begins, by its own advance; the other direction is aligned for all lines at once.
double start_of_line(const std::string& alignment, double advance) {
  if (alignment == "center") return -advance / 2;
  return alignment == "right" || alignment == "bottom" ? -advance : 0;
}

/// The alignment of all lines across them, by their ink. Glyphs of a column stand with their middle
/// on it.
double offset_across(const TextOptions& o, bool horizontal, const Block& block) {
  const glm::dvec2 &low = block.low, &high = block.high;
  if (horizontal) {
    if (o.valign == "top") return -high.y;
    if (o.valign == "center") return -(high.y + low.y) / 2;
    return o.valign == "bottom" ? -low.y : 0;
  }
  if (o.halign == "left") return -low.x;
  return o.halign == "right" ? -high.x : 0;
}

/// From one line to the next, in units: what the font says of its lines.
double line_distance(hb_font_t* font) {
  hb_font_extents_t extents{};
  hb().font_get_h_extents(font, &extents);
  return double(extents.ascender) - extents.descender + extents.line_gap;
}

/// The lines of a text, without their ends; all of it where newlines are characters like others.
std::vector<std::string_view> lines_of(const TextOptions& o) {
  std::vector<std::string_view> lines;
  std::string_view rest = o.text;
  for (size_t end = 0; o.lines && (end = rest.find('\n')) != std::string_view::npos;) {
    const bool with_return = end > 0 && rest[end - 1] == '\r';
    lines.push_back(rest.substr(0, with_return ? end - 1 : end));
    rest.remove_prefix(end + 1);
  }
  lines.push_back(rest);
  return lines;
}

/// Adds the glyphs of one line, `down` across the lines.
std::optional<Error> add_line(const TextOptions& o, std::string_view text, const Font& font,
                              int steps, double down, bool& horizontal, Block& block) {
  const auto shaped = shape(o, text, font);
  if (!shaped) return shaped.error();
  hb_buffer_t* const buffer = shaped->get();
  const unsigned count = hb().buffer_get_length(buffer);
  const hb_glyph_info_t* infos = hb().buffer_get_glyph_infos(buffer, nullptr);
  const hb_glyph_position_t* places = hb().buffer_get_glyph_positions(buffer, nullptr);
  horizontal = HB_DIRECTION_IS_HORIZONTAL(hb().buffer_get_direction(buffer));
  std::optional<TypeUnits> type_units;
  if (o.as_openscad_rounds) type_units.emplace(font.data().outline_em, font.data().units_per_em);
  glm::dvec2 advance(0);
  for (unsigned i = 0; i < count; ++i)
    advance += o.spacing * glm::dvec2(places[i].x_advance, places[i].y_advance);
  const glm::dvec2 start = horizontal ? glm::dvec2(start_of_line(o.halign, advance.x), -down)
                                      : glm::dvec2(-down, start_of_line(o.valign, advance.y));
  if (down == 0) block.offset = start;
  for (const int i : {0, 1}) {
    if (std::abs(advance[i]) > std::abs(block.advance[i])) block.advance[i] = advance[i];
  }
  glm::dvec2 pen_at = start;
  for (unsigned i = 0; i < count; ++i) {
    if (infos[i].codepoint == 0) block.missing.push_back(code_point_at(text, infos[i].cluster));
    GlyphPen pen(steps, type_units);
    pen.draw(font.data().font.get(), infos[i].codepoint);
    const glm::dvec2 at = pen_at + glm::dvec2(places[i].x_offset, places[i].y_offset);
    for (Shape2D::Loop& loop : pen.loops) {
      for (glm::dvec2& p : loop) p += at;
      block.loops.push_back(std::move(loop));
    }
    if (pen.low.x <= pen.high.x) {
      glm::dvec2 low = pen.low, high = pen.high, ink_at = at;
      if (o.as_openscad_rounds) {
        // Whole pixels, and marks where they are in their glyphs.
        constexpr double kPixel = kTypeUnitsOfPixel;
        low = glm::floor(low / kPixel) * kPixel;
        high = glm::ceil(high / kPixel) * kPixel;
        if (horizontal) ink_at.y = pen_at.y;
      }
      block.low = glm::min(block.low, low + ink_at);
      block.high = glm::max(block.high, high + ink_at);
    }
    pen_at += o.spacing * glm::dvec2(places[i].x_advance, places[i].y_advance);
  }
  return std::nullopt;
}

Result<Block> lay_out(const TextOptions& o, const Font& font) {
  if (auto error = check(o)) return *error;
  constexpr size_t kLongest = 1 << 16;
  if (o.text.size() > kLongest) {
    static_assert(kLongest == 65536);
    return invalid_argument("text: longer than 65536 bytes");
  }
  const int steps = std::max(o.facets.fragments(o.size) / 8 + 1, 2);
  constexpr int kMostSteps = 1 << 14;
  if (steps > kMostSteps) {
    return invalid_argument("text: a curve of " + std::to_string(steps) + " steps, the limit is " +
                            std::to_string(kMostSteps));
  }
  Block block;
  block.scale = o.as_openscad_rounds ? o.size / kTypeUnitsOfSize
                                     : o.size * kEmPerSize / font.data().units_per_em;
  block.low = glm::dvec2(std::numeric_limits<double>::infinity());
  block.high = -block.low;
  const double distance = o.line_spacing * line_distance(shaping_font(o, font));
  const std::vector<std::string_view> lines = lines_of(o);
  bool horizontal = true;  // as the last line that has a direction of its own
  for (size_t i = 0; i < lines.size(); ++i) {
    if (auto error = add_line(o, lines[i], font, steps, double(i) * distance, horizontal, block))
      return *error;
  }
  if (block.loops.empty()) block.low = block.high = glm::dvec2(0);
  const double across = offset_across(o, horizontal, block);
  const glm::dvec2 move = horizontal ? glm::dvec2(0, across) : glm::dvec2(across, 0);
  for (Shape2D::Loop& loop : block.loops) {
    for (glm::dvec2& p : loop) p += move;
  }
  block.offset += move;
  block.low += move;
  block.high += move;
  return block;
}

}  // namespace

Result<Shape2D> make_text(const TextOptions& options, const Font& font, std::string* note) {
  Result<Block> block = lay_out(options, font);
  if (!block) return block.error();
  if (note != nullptr && !block->missing.empty()) {
    constexpr const char* kDigits = "0123456789ABCDEF";
    std::string code;
    for (uint32_t c = block->missing[0], i = 0; i < 4 || c != 0; c >>= 4, ++i)
      code.insert(code.begin(), kDigits[c & 15]);
    *note = "text: the font " + font.family() + " has no glyph for U+" + code;
    if (block->missing.size() > 1)
      *note += " and " + std::to_string(block->missing.size() - 1) + " more characters";
  }
  for (Shape2D::Loop& loop : block->loops) {
    for (glm::dvec2& p : loop) p *= block->scale;
  }
  return Shape2D::from_outlines(block->loops, FillRule::kNonZero);
}

Result<TextMetrics> measure_text(const TextOptions& options, const Font& font) {
  const Result<Block> block = lay_out(options, font);
  if (!block) return block.error();
  TextMetrics metrics;
  metrics.position = block->low * block->scale;
  metrics.size = (block->high - block->low) * block->scale;
  metrics.ascent = (block->high.y - block->offset.y) * block->scale;
  metrics.descent = (block->low.y - block->offset.y) * block->scale;
  metrics.offset = block->offset * block->scale;
  metrics.advance = block->advance * block->scale;
  return metrics;
}

Result<FontMetrics> measure_font(double size, const Font& font) {
  if (!std::isfinite(size)) return not_finite("font_metrics", "size", size);
  if (!(size > 0)) return not_positive("font_metrics", "size", size);
  const double scale = size * kEmPerSize / font.data().units_per_em;
  hb_font_extents_t extents{};
  hb().font_get_h_extents(font.data().font.get(), &extents);
  FontMetrics metrics;
  metrics.ascent = extents.ascender * scale;
  metrics.descent = extents.descender * scale;
  metrics.interline = line_distance(font.data().font.get()) * scale;
  // The box of all glyphs: yMin and yMax of the table "head", signed words of 16 bits.
  const HarfbuzzPtr<hb_blob_t> head(
      hb().face_reference_table(font.data().face.get(), HB_TAG('h', 'e', 'a', 'd')));
  unsigned length = 0;
  const char* bytes = hb().blob_get_data(head.get(), &length);
  const auto word = [&](unsigned at) {
    if (at + 2 > length) return 0.0;
    const auto byte = [&](unsigned i) { return static_cast<unsigned char>(bytes[i]); };
    return double(static_cast<int16_t>(byte(at) << 8 | byte(at + 1)));
  };
  constexpr unsigned kLowest = 38, kHighest = 42;
  metrics.max_descent = word(kLowest) * scale;
  metrics.max_ascent = word(kHighest) * scale;
  return metrics;
}

}  // namespace csgrun

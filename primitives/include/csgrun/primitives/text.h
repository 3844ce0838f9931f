// Text as a 2D shape, with OpenSCAD's sizes and alignments, from fonts that are the same
// everywhere.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>

#include <csgrun/engine/error.h>
#include <csgrun/primitives/shape2d.h>
#include <csgrun/primitives/solids.h>

namespace csgrun {

/// One face of a font: TrueType or OpenType outlines. Copies share it.
class Font {
 public:
  /// The first face of a .ttf, .otf or .ttc. `name` is used in messages. Errors: kMalformedFile.
  static Result<Font> parse(const std::string& name, std::string_view bytes);
  /// Liberation Sans, which is part of the program.
  static Font shipped(bool bold, bool italic);

  [[nodiscard]] const std::string& family() const;
  [[nodiscard]] const std::string& style() const;  ///< "Regular", "Bold Italic" ...

  struct Data;
  [[nodiscard]] const Data& data() const { return *data_; }

 private:
  explicit Font(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

struct FontOptions {
  bool system_fonts = false;  ///< look in `folder`, too
  bool strict = false;        ///< a font that is not there is an error, not a note
  std::string folder = "/usr/share/fonts";
};

struct FontChoice {
  Font font;
  std::string note;  ///< "there is no font 'Arial'; the shipped Liberation Sans is used instead"
};

/// Why there can be no text: nothing, but where the library HarfBuzz, which is loaded when somebody
/// asks first, cannot be (kCannotRead). What returns no Result here throws std::runtime_error then.
std::optional<Error> text_failure();

/// A font's description without its features, as in "Amiri:style=Bold:fontfeatures=+smcp;-liga",
/// and they; what is none is left out with a note.
struct FontFeatures {
  std::string font;
  std::vector<std::string> features;
  std::string note;
};
FontFeatures split_font_features(const std::string& description);

/// Fonts by OpenSCAD's descriptions: "Liberation Sans", "Liberation Sans:style=Bold Italic".
class FontBook {
 public:
  explicit FontBook(FontOptions options = {}) : options_(std::move(options)) {}

  /// The shipped face for "" and "Liberation Sans" (any case); else, with system_fonts, the file
  /// whose family and style match, the first by path; else the shipped face in that style, with a
  /// note. Errors: kInvalidArgument instead of the note when strict. Answers are remembered.
  Result<FontChoice> find(const std::string& description);

 private:
  FontOptions options_;
  std::map<std::string, FontChoice> found_;
};

/// Whether a font is named by its file: it ends in .ttf, .otf or .ttc.
bool is_font_path(const std::string& description);

struct TextOptions {
  std::string text;                ///< UTF-8
  bool lines = false;              ///< newlines begin lines; else they are characters like others
  double line_spacing = 1;         ///< factor of the font's distance of lines
  double size = 10;                ///< mm; the em is size / 0.72, as in OpenSCAD
  std::string direction;           ///< "ltr", "rtl", "ttb", "btt"; empty: that of the script
  std::string language = "en";     ///< as in "en", "tr", "zh-hans"
  std::string script;              ///< "Latn" (ISO 15924), "latin"; empty: that of the characters
  std::string halign = "default";  ///< "left", "center", "right", by advance widths
  std::string valign = "default";  ///< "baseline", "bottom", "center", "top", by ink
  double spacing = 1;              ///< factor of all advances
  std::vector<std::string> features;  ///< of the font, as split_font_features gives them
  Facets facets;                      ///< a curve has max(fragments(size) / 8 + 1, 2) steps
  /// All places are rounded as OpenSCAD's font library rounds them, to 10^-5 of the size and ink
  /// that is aligned to 64 times that: for OpenSCAD's trees.
  bool as_openscad_rounds = false;
};

/// In mm, with the alignments applied to `position` and `offset`; OpenSCAD's textmetrics. Of
/// several lines: of all their ink, from the first baseline, the longest advance, and where the
/// first begins.
struct TextMetrics {
  glm::dvec2 position{};           ///< the lower left corner of the ink
  glm::dvec2 size{};               ///< of the ink
  double ascent = 0, descent = 0;  ///< of the ink above and (negative) below the baseline
  glm::dvec2 offset{};             ///< where the first glyph's origin is
  glm::dvec2 advance{};            ///< from there to where the next text would begin
};

/// The union of all glyphs; empty for a text without ink. `note` gets "the font has no glyph for
/// ...", of which empty boxes are drawn. Errors: kInvalidArgument.
Result<Shape2D> make_text(const TextOptions& options, const Font& font, std::string* note);
Result<TextMetrics> measure_text(const TextOptions& options, const Font& font);

/// In mm; OpenSCAD's fontmetrics. Descents are negative.
struct FontMetrics {
  double ascent = 0, descent = 0;          ///< what the font keeps for a line
  double max_ascent = 0, max_descent = 0;  ///< of the tallest and the deepest glyph
  double interline = 0;                    ///< from a baseline to the next
};
/// Errors: kInvalidArgument for a size that is not positive.
Result<FontMetrics> measure_font(double size, const Font& font);

}  // namespace csgrun

// Text against the numbers of the font: Liberation Sans has 2048 units to the em.
#include <cmath>

#include <gtest/gtest.h>

#include <csgrun/primitives/text.h>

#include "primitives/text/shipped_fonts.h"

namespace csgrun::text_test {
namespace {

/// mm per unit at size 10: an em of 13.889.
constexpr double kUnit = 1000.0 / 72 / 2048;

Shape2D drawn(const TextOptions& options, std::string* note = nullptr) {
  auto r = make_text(options, Font::shipped(false, false), note);
  EXPECT_TRUE(r) << (r ? "" : r.error().message);
  return r ? *r : Shape2D();
}

TextOptions line(const std::string& text) {
  TextOptions options;
  options.text = text;
  return options;
}

TextMetrics metrics(const TextOptions& options) {
  auto r = measure_text(options, Font::shipped(false, false));
  EXPECT_TRUE(r) << (r ? "" : r.error().message);
  return r ? *r : TextMetrics();
}

std::string error(const TextOptions& options) {
  const auto r = make_text(options, Font::shipped(false, false), nullptr);
  return r ? "no error" : r.error().message;
}

TEST(Text, CapitalsHaveTheSizeOfTheFont) {
  // I is a bar from 189 to 380, 1409 high; its advance is 569, that of A 1366.
  const Shape2D bar = drawn(line("I"));
  EXPECT_NEAR(bar.area(), 191 * 1409 * kUnit * kUnit, 1e-6);
  EXPECT_NEAR(bar.bounds()[0].x, 189 * kUnit, 1e-7);
  EXPECT_NEAR(bar.bounds()[1].y, 1409 * kUnit, 1e-7);
  EXPECT_EQ(bar.bounds()[0].y, 0);
  EXPECT_NEAR(metrics(line("A")).advance.x, 1366 * kUnit, 1e-9);
  EXPECT_NEAR(metrics(line("II")).advance.x, 2 * 569 * kUnit, 1e-9);
  EXPECT_NEAR(drawn(line("II")).area(), 2 * bar.area(), 1e-6);
  TextOptions large = line("I");
  large.size = 20;
  EXPECT_NEAR(drawn(large).area(), 4 * bar.area(), 1e-6);
}

TextOptions lines(const std::string& text) {
  TextOptions options = line(text);
  options.lines = true;
  return options;
}

/// The font keeps 1854 units above the baseline, 434 below, and 67 between lines.
constexpr double kLine = (1854 + 434 + 67) * kUnit;

TEST(Text, NewlinesBeginLinesAtTheFontsDistance) {
  const Shape2D two = drawn(lines("I\nI"));
  EXPECT_NEAR(two.area(), 2 * 191 * 1409 * kUnit * kUnit, 1e-6);
  EXPECT_NEAR(two.bounds()[0].y, -kLine, 1e-7);
  EXPECT_NEAR(two.bounds()[1].y, 1409 * kUnit, 1e-7);
  EXPECT_EQ(drawn(lines("I\r\nI")).loops(), two.loops());
  EXPECT_NEAR(drawn(lines("I\n\nI")).bounds()[0].y, -2 * kLine, 1e-7);
  TextOptions wide = lines("I\nI\n");
  wide.line_spacing = 1.5;
  EXPECT_NEAR(drawn(wide).bounds()[0].y, -1.5 * kLine, 1e-7);
  EXPECT_EQ(drawn(lines("I")).loops(), drawn(line("I")).loops());
  // Where newlines are characters like others, the font has none for them.
  std::string note;
  drawn(line("I\nI"), &note);
  EXPECT_EQ(note, "text: the font Liberation Sans has no glyph for U+000A");
}

TEST(Text, LinesAreAlignedEachByItsWidthAndTogetherByTheirInk) {
  TextOptions options = lines("I\nII");
  options.halign = "right";
  const Shape2D right = drawn(options);
  EXPECT_NEAR(right.bounds()[1].x, -(569 - 380) * kUnit, 1e-7);
  EXPECT_NEAR(right.bounds()[0].x, (-2 * 569 + 189) * kUnit, 1e-7);
  options.halign = "center";
  const Shape2D middle = drawn(options);
  EXPECT_NEAR(middle.bounds()[0].x + middle.bounds()[1].x, 0, 1e-7);
  options.valign = "center";
  const Shape2D centred = drawn(options);
  EXPECT_NEAR(centred.bounds()[0].y + centred.bounds()[1].y, 0, 1e-7);
  options.valign = "top";
  EXPECT_NEAR(drawn(options).bounds()[1].y, 0, 1e-7);
  options.valign = "bottom";
  EXPECT_NEAR(drawn(options).bounds()[0].y, 0, 1e-7);
}

TEST(Text, MetricsOfLinesAreThoseOfTheirOutlines) {
  TextOptions options = lines("I\nIII\nI");
  options.valign = "bottom";
  const TextMetrics m = metrics(options);
  EXPECT_NEAR(m.advance.x, 3 * 569 * kUnit, 1e-9);
  EXPECT_NEAR(m.size.y, 2 * kLine + 1409 * kUnit, 1e-9);
  EXPECT_NEAR(m.ascent, 1409 * kUnit, 1e-9);
  EXPECT_NEAR(m.descent, -2 * kLine, 1e-9);
  EXPECT_NEAR(m.position.y, 0, 1e-9);
  EXPECT_NEAR(m.offset.y, 2 * kLine, 1e-9);
}

TEST(Text, ColumnsGoToTheLeft) {
  TextOptions options = lines("I\nI");
  options.direction = "ttb";
  const Shape2D two = drawn(options);
  options.text = "I";
  const Shape2D one = drawn(options);
  EXPECT_NEAR(two.bounds()[0].x, one.bounds()[0].x - kLine, 1e-7);
  EXPECT_EQ(two.bounds()[1].x, one.bounds()[1].x);
}

TEST(Text, WhatIsNoTextOrNoScriptIsAnError) {
  EXPECT_EQ(error(line("a\xff")), "text: it is not in UTF-8: byte 2 of \"a\\xff\"");
  EXPECT_EQ(error(line("\xc3")), "text: it is not in UTF-8: byte 1 of \"\\xc3\"");
  TextOptions options = line("I");
  for (const char* good : {"Latn", "latin", "Arabic", "Zyyy"}) {
    options.script = good;
    EXPECT_EQ(error(options), "no error") << good;
  }
  options.script = "latinn";
  EXPECT_EQ(
      error(options),
      "text: script must be a code of four letters, as \"Latn\", or a name, as \"latin\", got "
      "\"latinn\"");
}

TEST(Fonts, MetricsAreThoseOfItsTables) {
  const auto m = measure_font(10, Font::shipped(false, false));
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->ascent, 1854 * kUnit, 1e-12);
  EXPECT_NEAR(m->descent, -434 * kUnit, 1e-12);
  EXPECT_NEAR(m->interline, kLine, 1e-12);
  // Some glyph is taller than a line, and none goes beyond the box.
  EXPECT_GT(m->max_ascent, m->ascent);
  EXPECT_LT(m->max_descent, m->descent);
  EXPECT_LE(metrics(line("|_gjQ@")).ascent, m->max_ascent);
  EXPECT_GE(metrics(line("|_gjQ@")).descent, m->max_descent);
  EXPECT_FALSE(measure_font(0, Font::shipped(false, false)));
}

TEST(Text, HolesAreHoles) {
  EXPECT_EQ(drawn(line("O")).loops().size(), 2u);
  EXPECT_EQ(drawn(line("B8%")).regions().size(), 5u);
  EXPECT_TRUE(drawn(line("  ")).empty());
  EXPECT_TRUE(drawn(line("")).empty());
}

TEST(Text, CurvesHaveOpenScadsSteps) {
  const auto corners = [](double fn) {
    TextOptions options = line("O");
    options.facets.fn = fn;
    size_t count = 0;
    const Shape2D shape = drawn(options);
    for (const auto& loop : shape.loops()) count += loop.size();
    return count;
  };
  // An O is made of curves only: max(fn / 8 + 1, 2) steps each, that is 2, 3 and 5.
  EXPECT_NEAR(double(corners(16)) / double(corners(8)), 1.5, 0.1);
  EXPECT_NEAR(double(corners(32)) / double(corners(8)), 2.5, 0.15);
  EXPECT_EQ(corners(3), corners(15));
}

TEST(Text, AlignsByAdvanceAndInk) {
  TextOptions options = line("Iy");
  const TextMetrics plain = metrics(options);
  EXPECT_LT(plain.descent, 0);
  EXPECT_NEAR(plain.size.y, plain.ascent - plain.descent, 1e-12);
  options.halign = "center";
  options.valign = "center";
  EXPECT_NEAR(metrics(options).offset.x, -plain.advance.x / 2, 1e-12);
  EXPECT_NEAR(metrics(options).position.y, -plain.size.y / 2, 1e-12);
  options.halign = "right";
  options.valign = "top";
  EXPECT_NEAR(metrics(options).offset.x, -plain.advance.x, 1e-12);
  EXPECT_NEAR(drawn(options).bounds()[1].y, 0, 1e-7);
  options.valign = "bottom";
  EXPECT_NEAR(drawn(options).bounds()[0].y, 0, 1e-7);
  options.halign = "left";
  options.valign = "baseline";
  EXPECT_EQ(metrics(options).offset, glm::dvec2(0));
  // What is drawn lies where it was measured.
  EXPECT_NEAR(drawn(options).bounds()[0].x, plain.position.x, 1e-7);
  EXPECT_NEAR(drawn(options).bounds()[1].x, plain.position.x + plain.size.x, 1e-7);
}

TEST(Text, SpacingAndDirection) {
  TextOptions options = line("III");
  const double advance = metrics(options).advance.x;
  options.spacing = 2;
  EXPECT_NEAR(metrics(options).advance.x, 2 * advance, 1e-9);
  EXPECT_NEAR(metrics(options).size.x - metrics(line("III")).size.x, 2 * 569 * kUnit, 1e-9);
  // From right to left the last character stands first.
  options = line("Ii.");
  options.direction = "rtl";
  EXPECT_NEAR(drawn(options).area(), drawn(line("Ii.")).area(), 1e-5);
  EXPECT_NEAR(metrics(options).position.x, metrics(line(".")).position.x, 1e-9);
  options.direction = "ttb";
  const TextMetrics column = metrics(options);
  EXPECT_LT(column.advance.y, 0);
  EXPECT_EQ(column.advance.x, 0);
}

TEST(Text, CellsOfColumnsAreAscentAndDescent) {
  // The font has no table of columns: a cell is 1491 + 431 high, and ink stands in its middle.
  TextOptions options = line("II");
  options.direction = "ttb";
  const TextMetrics column = metrics(options);
  EXPECT_NEAR(column.advance.y, -2 * 1922 * kUnit, 1e-9);
  EXPECT_NEAR(column.size.y, (1409 + 1922) * kUnit, 1e-9);
  EXPECT_NEAR(column.position.y + column.size.y, -(1922 - 1409) / 2 * kUnit, 1e-9);
  EXPECT_NEAR(column.position.x, (189 - 569 / 2) * kUnit, 1e-9);
}

TEST(Text, OfTreesIsRoundedAsByOpenScad) {
  // What OpenSCAD 2025.07 writes for these, to a hundredth: all its places are hundredths here.
  struct Case {
    const char *text, *align;
    glm::dvec2 low, high;
  };
  for (const Case& c : {Case{"H", "default", {113.93, 0}, {889.7, 955.48}},
                        Case{"%", "default", {49.5, -8.14}, {1185.36, 963.62}},
                        Case{"AAVo", "center", {-1683.22, -484.28}, {1627.57, 484.76}}}) {
    TextOptions options = line(c.text);
    options.size = 1000;
    options.as_openscad_rounds = true;
    options.halign = options.valign = c.align;
    const auto [low, high] = drawn(options).bounds();
    for (const int i : {0, 1}) {
      EXPECT_NEAR(low[i], c.low[i], 1e-6) << c.text;
      EXPECT_NEAR(high[i], c.high[i], 1e-6) << c.text;
    }
    // Of the em's 138889 units letters get 138880, whole pixels.
    const double area = drawn(options).area();
    options.as_openscad_rounds = false;
    EXPECT_NEAR(area / drawn(options).area(), std::pow(138880 * 72 / 1e7, 2), 2e-5) << c.text;
  }
}

TEST(Text, FeaturesOfTheFont) {
  // A and V are 1366 wide each, and kerned.
  TextOptions pair = line("AV");
  EXPECT_LT(metrics(pair).advance.x, 2 * 1366 * kUnit - 1);
  const double kerned = metrics(pair).advance.x;
  for (const char* off : {"-kern", "kern=0", "kern off"}) {
    pair.features = {off};
    EXPECT_NEAR(metrics(pair).advance.x, 2 * 1366 * kUnit, 1e-9) << off;
  }
  for (const char* on : {"+kern", "kern", "-liga"}) {
    pair.features = {on};
    EXPECT_EQ(metrics(pair).advance.x, kerned) << on;
  }
  // The last one counts.
  pair.features = {"-kern", "+kern"};
  EXPECT_EQ(metrics(pair).advance.x, kerned);
}

TEST(Fonts, FeaturesStandBehindTheName) {
  const auto all = [](const FontFeatures& font) {
    std::string text = font.font;
    for (const std::string& feature : font.features) text += " [" + feature + "]";
    return text + (font.note.empty() ? "" : " " + font.note);
  };
  EXPECT_EQ(all(split_font_features("A:style=Bold")), "A:style=Bold");
  EXPECT_EQ(all(split_font_features("A:fontfeatures=+smcp;-liga:style=Bold")),
            "A:style=Bold [+smcp] [-liga]");
  EXPECT_EQ(all(split_font_features("a.ttf:fontfeatures=ss01=2,-kern;")), "a.ttf [ss01=2] [-kern]");
  EXPECT_EQ(all(split_font_features("A:fontfeatures=-no-feature;kern")),
            "A [kern] there is no font feature \"-no-feature\": one is written as \"+liga\", "
            "\"-kern\" or \"ss01=2\"");
}

TEST(Text, WhatIsMissingIsSaid) {
  std::string note;
  drawn(line("a\xf0\x9f\x98\x80"), &note);
  EXPECT_EQ(note, "text: the font Liberation Sans has no glyph for U+1F600");
  note.clear();
  drawn(line("\xc3\x84\xce\xa9\xd0\x96"), &note);  // Latin, Greek and Cyrillic are there
  EXPECT_EQ(note, "");
}

TEST(Text, BadOptionsAreErrors) {
  TextOptions options = line("x");
  options.size = -1;
  EXPECT_EQ(error(options), "text: size must be positive, got -1");
  options.size = 10;
  options.halign = "middle";
  EXPECT_EQ(error(options),
            "text: halign must be one of \"left\", \"center\", \"right\", got \"middle\"");
  options.halign = "left";
  options.direction = "up";
  EXPECT_EQ(error(options),
            "text: direction must be one of \"ltr\", \"rtl\", \"ttb\", \"btt\", got \"up\"");
  options.direction = "";
  options.spacing = std::nan("");
  EXPECT_EQ(error(options), "text: spacing must be finite, got nan");
  options = line("x");
  options.facets.fn = 1e9;
  EXPECT_EQ(error(options), "text: a curve of 125000001 steps, the limit is 16384");
  EXPECT_EQ(error(line(std::string(100000, 'x'))), "text: longer than 65536 bytes");
}

TEST(Fonts, AreFoundByDescription) {
  FontBook book;
  const auto name = [&](const std::string& description) {
    const auto choice = book.find(description);
    return choice ? choice->font.family() + "|" + choice->font.style() + "|" + choice->note
                  : choice.error().message;
  };
  EXPECT_EQ(name(""), "Liberation Sans|Regular|");
  EXPECT_EQ(name("liberation sans"), "Liberation Sans|Regular|");
  EXPECT_EQ(name("Liberation Sans:style=Bold Italic"), "Liberation Sans|Bold Italic|");
  EXPECT_EQ(name("Liberation Sans:bold"), "Liberation Sans|Bold|");
  EXPECT_EQ(
      name("Arial:style=Italic"),
      "Liberation Sans|Italic|there is no font \"Arial:style=Italic\"; Liberation Sans Italic "
      "is used instead");
  EXPECT_NE(name("Liberation Sans:style=Narrow").find("is used instead"), std::string::npos);
  FontOptions strict;
  strict.strict = true;
  const auto refused = FontBook(strict).find("Arial");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "there is no font \"Arial\"; name a font file, or allow --system-fonts");
  FontOptions nowhere;
  nowhere.system_fonts = true;
  nowhere.folder = "/nowhere";
  EXPECT_NE(FontBook(nowhere).find("Arial")->note, "");
}

TEST(Fonts, TheShippedOneIsOpen) {
  // Version 1 has another licence. The names are in the file as UTF-16.
  const std::string_view bytes = shipped_font(false, false);
  std::string version;
  for (const char c : std::string("Version 2.")) version += std::string(1, '\0') + c;
  EXPECT_NE(bytes.find(version), std::string_view::npos);
  EXPECT_GT(bytes.size(), 100000u);
}

TEST(Fonts, WhatIsNoFontIsRefused) {
  for (const std::string& bytes : {std::string(), std::string("OTTO"), std::string(1000, '\0'),
                                   std::string("\0\1\0\0\xff\xff\xff\xff\xff\xff\xff\xff", 12)}) {
    const auto font = Font::parse("x.ttf", bytes);
    ASSERT_FALSE(font);
    EXPECT_EQ(font.error().message,
              "x.ttf: this is no TrueType or OpenType font, or it is damaged");
  }
  EXPECT_TRUE(is_font_path("a/B.TTF"));
  EXPECT_FALSE(is_font_path("ttf"));
  EXPECT_FALSE(is_font_path("Arial"));
}

}  // namespace
}  // namespace csgrun::text_test

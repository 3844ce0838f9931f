// Font files: the shipped font with the input written over its tables, and the input as a font.
#include <algorithm>
#include <string>

#include <csgrun/primitives/text.h>

#include "primitives/text/shipped_fonts.h"
#include "tests/fuzz/flat_reader.h"

namespace {

void draw(const csgrun::Font& font) {
  csgrun::TextOptions options;
  options.text = "aB\xc3\xa4\n fi";
  options.lines = true;
  csgrun::fuzz::expect_shape(csgrun::make_text(options, font, nullptr));
  options.direction = "ttb";
  const auto metrics = csgrun::measure_text(options, font);
  csgrun::fuzz::expect(metrics.has_value(), "a text without metrics");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  const std::string_view input = fuzz::text_of(data, size);
  if (const auto font = Font::parse("x.ttf", input)) draw(*font);
  if (size < 4) return 0;
  // Two bytes say where, the rest is what.
  std::string bytes(shipped_font(false, false));
  const size_t at = (size_t{data[0]} << 8 | data[1]) % bytes.size();
  const std::string_view over = input.substr(2, bytes.size() - at);
  std::copy(over.begin(), over.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
  if (const auto font = Font::parse("x.ttf", bytes)) draw(*font);
  return 0;
}

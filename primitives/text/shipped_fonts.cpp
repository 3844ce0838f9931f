// The assembler takes the files as they are: neither a generated source nor a file at run time.
#include "primitives/text/shipped_fonts.h"

#define CSGRUN_SHIP(symbol, file)                             \
  __asm__(                                                    \
      ".section .rodata\n"                                    \
      ".balign 16\n"                                          \
      ".global " #symbol                                      \
      "_begin\n"                                              \
      ".global " #symbol "_end\n" #symbol                     \
      "_begin:\n"                                             \
      ".incbin \"" CSGRUN_FONT_FOLDER "/" file "\"\n" #symbol \
      "_end:\n"                                               \
      ".byte 0\n"                                             \
      ".previous\n");                                         \
  extern "C" const char symbol##_begin[];                     \
  extern "C" const char symbol##_end[];

CSGRUN_SHIP(csgrun_font_regular, "LiberationSans-Regular.ttf")
CSGRUN_SHIP(csgrun_font_bold, "LiberationSans-Bold.ttf")
CSGRUN_SHIP(csgrun_font_italic, "LiberationSans-Italic.ttf")
CSGRUN_SHIP(csgrun_font_bold_italic, "LiberationSans-BoldItalic.ttf")

#undef CSGRUN_SHIP

namespace csgrun {

std::string_view shipped_font(bool bold, bool italic) {
  const auto view = [](const char* begin, const char* end) {
    return std::string_view(begin, static_cast<size_t>(end - begin));
  };
  if (bold && italic) return view(csgrun_font_bold_italic_begin, csgrun_font_bold_italic_end);
  if (bold) return view(csgrun_font_bold_begin, csgrun_font_bold_end);
  if (italic) return view(csgrun_font_italic_begin, csgrun_font_italic_end);
  return view(csgrun_font_regular_begin, csgrun_font_regular_end);
}

}  // namespace csgrun

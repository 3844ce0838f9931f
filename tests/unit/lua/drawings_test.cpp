// What text and import of drawings say when they are called wrongly.
#include "lua_support.h"

namespace csgrun::testing::drawings_test {
namespace {

TEST(TextInLua, Mistakes) {
  EXPECT_EQ(message_of("return text()"), "model.lua:1: text: needs a text");
  EXPECT_EQ(message_of("return text(5)"),
            "model.lua:1: text: option 'text' must be a string, got the number 5");
  EXPECT_EQ(message_of("return text('a', {sise = 3})"),
            "model.lua:1: text: unknown option 'sise' (did you mean 'size'?)");
  EXPECT_EQ(message_of("return text('a', 0)"),
            "model.lua:1: text: option 'size' must be positive, got 0");
  EXPECT_EQ(message_of("return text('a', {size = 1, em = 2})"),
            "model.lua:1: text: give either 'size' or 'em', not both");
  EXPECT_EQ(message_of("return text('a', {halign = 'middle'})"),
            "model.lua:1: text: halign must be one of \"left\", \"center\", "
            "\"right\", got \"middle\"");
  EXPECT_NE(message_of("return text('a', {font = 'nowhere.ttf'})").find("text: cannot read"),
            std::string::npos);
  EXPECT_NE(message_of("return text('a', {font = '/etc/x.ttf'})").find("outside"),
            std::string::npos);
  EXPECT_EQ(message_of("return text_metrics{size = 3}"), "model.lua:1: text_metrics: needs a text");
}

TEST(ImportInLua, OptionsOfOtherFormats) {
  EXPECT_EQ(message_of("return import('x.step')"),
            "model.lua:1: import: 'x.step' has none of the endings .stl, .off, .obj, .ply, .glb, "
            ".gltf, .3mf, .amf, .svg, "
            ".dxf");
  EXPECT_EQ(message_of("return import('x.svg', {fill = 'nonzero'})"),
            "model.lua:1: import: option 'fill' is for meshes, not for drawings");
  EXPECT_EQ(message_of("return import('x.stl', {layer = 'a'})"),
            "model.lua:1: import: option 'layer' is for drawings, not for meshes");
  EXPECT_EQ(message_of("return import('x.dxf', {dpi = 90})"),
            "model.lua:1: import: option 'dpi' is for .svg files");
  EXPECT_EQ(message_of("return import('x.svg', {scale = 2})"),
            "model.lua:1: import: option 'scale' is for .dxf files");
  EXPECT_EQ(message_of("return import('x.svg', {layer = 'a', id = 'b'})"),
            "model.lua:1: import: give either 'layer' or 'id', not both");
  EXPECT_EQ(
      message_of("return import('x.svg', {parts = true, id = 'b'})"),
      "model.lua:1: import: option 'parts' gives all parts of a drawing: it goes with neither "
      "'layer' nor 'id'");
  EXPECT_EQ(message_of("return import('x.svg', {parts = true, as_openscad = true})"),
            "model.lua:1: import: option 'parts' does not go with 'as_openscad'");
  EXPECT_EQ(message_of("return import('x.stl', {as_openscad = true})"),
            "model.lua:1: import: option 'as_openscad' is for drawings, not for meshes");
  EXPECT_EQ(message_of("return import('x.svg', {dpi = 0})"),
            "model.lua:1: import: option 'dpi' must be positive, got 0");
}

}  // namespace
}  // namespace csgrun::testing::drawings_test

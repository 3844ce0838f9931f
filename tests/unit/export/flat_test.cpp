// Drawings as text: what stands in them, to the digit.
#include <gtest/gtest.h>

#include <csgrun/export/write_flat.h>

namespace csgrun::flat_test {
namespace {

using Loop = std::vector<glm::dvec2>;

std::string encoded(const std::string& format, const std::vector<FlatPart>& parts) {
  const auto bytes = encode_flat(format, parts);
  EXPECT_TRUE(bytes);
  return bytes ? *bytes : "";
}

const Loop kTriangle{{0.1, 0}, {1000.004, 0}, {0.1, 2}};

TEST(Svg, PathsInMillimetres) {
  const std::string text =
      encoded("svg", {{"a <b>", {kTriangle}, {}}, {"red", {kTriangle}, {{1, 0, 0, 0.5}}}});
  EXPECT_NE(text.find("width=\"999.904mm\" height=\"2mm\" viewBox=\"0.1 -2 999.904 2\""),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("id=\"a_&lt;b&gt;\""), std::string::npos) << text;
  EXPECT_NE(text.find("d=\"M0.1,0 L1000.004,0 0.1,-2 Z\n\""), std::string::npos) << text;
  EXPECT_NE(text.find("fill=\"#ff0000\" fill-opacity=\"0.5\""), std::string::npos) << text;
  EXPECT_NE(text.find("<title>a &lt;b&gt;</title>"), std::string::npos) << text;
}

TEST(Dxf, ClosedPolylinesOnLayers) {
  const std::string text = encoded("dxf", {{"a/b", {kTriangle}, {}}, {"a_b", {kTriangle}, {}}});
  EXPECT_NE(text.find("0\nLWPOLYLINE\n5\n14\n100\nAcDbEntity\n8\na_"
                      "b\n100\nAcDbPolyline\n90\n3\n70\n1\n10\n0.1\n20\n0\n10\n1000.004\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("8\na_b_2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("9\n$INSUNITS\n70\n4\n"), std::string::npos);
  EXPECT_TRUE(text.ends_with("0\nENDSEC\n0\nEOF\n"));
}

TEST(Dxf, ColoursOfLayers) {
  const std::string plain = encoded("dxf", {{"a", {kTriangle}, {}}});
  EXPECT_NE(plain.find("\n2\na\n70\n0\n62\n7\n6\nCONTINUOUS\n0\n"), std::string::npos) << plain;
  EXPECT_NE(plain.find("$ACADVER\n1\nAC1015\n"), std::string::npos);
  // 0xff8000 is 16744448; of the numbered colours yellow is the nearest by channels.
  const std::string text = encoded(
      "dxf", {{"a", {kTriangle}, {{1, 0.502F, 0, 1}}}, {"b", {kTriangle}, {{0, 0, 1, 0.5F}}}});
  EXPECT_NE(text.find("$ACADVER\n1\nAC1018\n"), std::string::npos);
  EXPECT_NE(text.find("\n2\na\n70\n0\n62\n2\n6\nCONTINUOUS\n420\n16744448\n0\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("\n2\nb\n70\n0\n62\n5\n6\nCONTINUOUS\n420\n255\n0\n"), std::string::npos);
  EXPECT_NE(text.find("\n8\na\n100\n"), std::string::npos);
  EXPECT_NE(text.find("\n8\nb\n440\n33554560\n100\n"), std::string::npos);
}

TEST(FlatFormat, ByEnding) {
  EXPECT_EQ(flat_format_of("a/B.SVG"), "svg");
  EXPECT_EQ(flat_format_of("x.dxf"), "dxf");
  EXPECT_EQ(flat_format_of("x.stl"), "");
  EXPECT_EQ(flat_format_of("svg"), "");
  EXPECT_FALSE(encode_flat("stl", {}));
}

}  // namespace
}  // namespace csgrun::flat_test

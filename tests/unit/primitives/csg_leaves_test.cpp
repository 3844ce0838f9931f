// What the leaves of .csg trees are: extrusions, outlines, text, files, polyhedra.
#include <array>
#include <cmath>
#include <string>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <csgrun/primitives/csg_file.h>

#include "tests/unit/primitives/csg_trees.h"
#include "tests/unit/primitives/mesh_measures.h"

namespace csgrun::csg_leaves_test {
namespace {

using testing::error;
using testing::kCube;
using testing::kNothing;
using testing::kSquare;
using testing::parse;
using testing::sketch;

TEST(CsgLeaves, ExtrusionsAndPolygons) {
  const CsgModel wedge = parse(
      "linear_extrude(height = 3, v = [ 0, 0.6, 0.8 ], center = true, scale = [1, -2], slices = 1, "
      "segments = 0) {" +
      kSquare + "}");
  ASSERT_EQ(sketch(wedge.solid), "linear_extrude");
  EXPECT_NEAR(testing::volume(*wedge.solid->mesh()), 2 * 2.4 / 2, 1e-12);
  const CsgModel holed = parse(
      "polygon(points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [2, 1], [2, 2]], paths = [[0, 1, "
      "2, 3], "
      "[4, 5, 6], [5, 6, 99]], convexity = 1);");
  EXPECT_TRUE(holed.is_2d);
  EXPECT_EQ(holed.shape.area(), 15.5);
  EXPECT_EQ(holed.warnings.size(), 1u);
}

// What OpenSCAD writes where its experimental discretization-by-error is on.
TEST(CsgLeaves, MayHaveTheirFacetsByError) {
  const std::string by_error = "$fn = 0, $fe = 0.1, $fa = 12, $fs = 2";
  const auto points = [](const std::string& text) {
    return parse(text).solid->mesh()->points.size();
  };
  EXPECT_EQ(points("cylinder(" + by_error + ", h = 1, r1 = 20, r2 = 20, center = false);"), 64u);
  EXPECT_EQ(parse("circle(" + by_error + ", r = 20);").shape.loops()[0].size(), 32u);
  // A corner is sqrt(2) from the axis: 43.5 degrees of its helix are 0.1 mm from the straight line.
  EXPECT_EQ(points("linear_extrude(height = 9, twist = 180, " + by_error + ", convexity = 1) {" +
                   "square(size = [2, 2], center = true); }"),
            6 * 4u);
  // With a scale $fe does not count.
  const std::string cone = "linear_extrude(height = 9, twist = 180, scale = 2, ";
  EXPECT_EQ(points(cone + by_error + ") {" + kSquare + "}"),
            points(cone + "$fn = 0, $fa = 12, $fs = 2) {" + kSquare + "}"));
}

TEST(CsgLeaves, OutlinesOfShapes) {
  const auto area = [](const std::string& text) { return parse(text).shape.area(); };
  const std::string ring =
      "difference() { square(size = [4, 4], center = true); square(size = [2, 2], center = true); "
      "}";
  EXPECT_NEAR(area("offset(r = 1, $fn = 8, $fa = 12, $fs = 2) {" + kSquare + "}"),
              2 + 2 * 3 + 4 * std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(area("offset(delta = 1, chamfer = false, $fn = 0) {" + kSquare + "}"), 12, 1e-9);
  EXPECT_NEAR(area("offset(delta = -0.25, chamfer = true) {" + kSquare + "}"), 1.5 * 0.5, 1e-9);
  EXPECT_NEAR(area("offset() {" + kSquare + kCube + "}"), 2 + 6 + 2.5 * std::sin(2 * M_PI / 5),
              0.7);
  EXPECT_NEAR(area("hull() {" + ring + kSquare + "}"), 16, 1e-9);
  EXPECT_NEAR(area("fill() {" + ring + "}"), 16, 1e-9);
  EXPECT_NEAR(area("minkowski(convexity = 0) {" + ring + kNothing + kSquare + "}"), 6 * 5, 1e-9);
  // As OpenSCAD has it: nothing is left of a sum that begins with an empty shape, or has one
  // besides.
  const std::string unit = "square(size = [1, 1], center = false);\n";
  for (const std::string& operands :
       {kNothing + kSquare, kSquare + kNothing, kNothing + kSquare + kSquare,
        kSquare + kNothing + kNothing}) {
    EXPECT_NEAR(area("minkowski(convexity = 0) {" + operands + "}" + unit), 1, 1e-9) << operands;
  }
  EXPECT_NEAR(area("minkowski(convexity = 0) {" + kSquare + kSquare + kNothing + "}"), 8, 1e-9);
  EXPECT_NEAR(area("minkowski(convexity = 0) {" + kSquare + "}"), 2, 1e-9);
  EXPECT_NEAR(area("resize(newsize = [8, 0, 0], auto = [0, 1, 0], convexity = 0) {" + ring + "}"),
              48, 1e-9);
  EXPECT_NEAR(area("resize(newsize = [8, -1, 5], auto = [0, 0, 0]) {" + ring + "}"), 24, 1e-9);
  EXPECT_EQ(parse("offset(r = 1) {" + kCube + "}").warnings,
            std::vector<std::string>{"m.csg:1: offset: a 3D child was left out"});
  EXPECT_EQ(
      parse("fill() {" + kCube + "}").warnings,
      std::vector<std::string>{"m.csg:1: fill: has no meaning for 3D children, they were united"});
  EXPECT_EQ(error("resize(newsize = 3) {" + kSquare + "}"),
            "m.csg:1: resize: newsize must be a list of 3 numbers");
}

TEST(CsgLeaves, TextOfNegativeSizeIsTurnedByHalfATurn) {
  const Shape2D turned = parse("text(text = \"abc\", size = -5, $fn = 40);").shape;
  EXPECT_NEAR(turned.area(), 16.8992812, 1e-5 * 16.9);  // as OpenSCAD has it, whatever $fn is
  const Shape2D upright = parse("text(text = \"abc\", size = 5, $fn = 3);").shape;
  EXPECT_NEAR(turned.area(), upright.area(), 1e-9);
  EXPECT_EQ(turned.bounds()[0], -upright.bounds()[1]);
  EXPECT_EQ(turned.bounds()[1], -upright.bounds()[0]);
}

TEST(CsgLeaves, TextIsNotEscaped) {
  const auto width = [](const std::string& string) {
    const CsgModel model = parse("text(text = \"" + string +
                                 "\", size = 10, spacing = 1, font = \"\", direction = \"ltr\", "
                                 "language = \"en\", script = \"Latn\", halign = \"left\", "
                                 "valign = \"baseline\", $fn = 0, $fa = 12, $fs = 2);");
    EXPECT_TRUE(model.warnings.empty());
    return model.shape.bounds()[1].x;
  };
  EXPECT_GT(width("\""), 0);
  EXPECT_GT(width("a\"b\\n\", size"), width("a\"b"));
  for (const std::string inches : {"5\", 6\"; 7", "Pipe (1\"); cold", "a\"); text(\"b"}) {
    EXPECT_GT(width(inches), width("Pipe")) << inches;
  }
  // By hand, and more than one in a line.
  const auto box = [](const std::string& text) { return parse(text).shape.bounds(); };
  EXPECT_EQ(box("text(text=\"Hi\",size=5);"), box("text(text = \"Hi\", size = 5);"));
  EXPECT_EQ(box("text(text = \"Hi\");"), box("text(text = \"Hi\", size = 10);"));
  EXPECT_EQ(box("text(text=\"Hi\",size=5); text(text = \"I\", size = 5);"),
            box("text(text = \"Hi\", size = 5);"));
  const CsgModel other = parse("text(text = \"I\", size = 10, font = \"Arial\");");
  EXPECT_GT(other.shape.area(), 10);
  EXPECT_EQ(other.warnings,
            std::vector<std::string>{"m.csg:1: text: there is no font \"Arial\"; Liberation Sans "
                                     "Regular is used instead"});
  EXPECT_EQ(parse("text(text = \"I\", size = 0);").warnings,
            std::vector<std::string>{"m.csg:1: text: size must be positive, got 0"});
  // Alignments that there are not, are none.
  const CsgModel odd = parse(
      "text(text = \"I\", size = 10, halign = \"middle\", valign = \"up\", "
      "direction = \"around\");");
  EXPECT_EQ(odd.shape.bounds(), parse("text(text = \"I\", size = 10);").shape.bounds());
  EXPECT_GT(odd.shape.area(), 10);
  EXPECT_EQ(odd.warnings,
            (std::vector<std::string>{
                "m.csg:1: text: there is no direction \"around\", the default was taken",
                "m.csg:1: text: there is no halign \"middle\", the default was taken",
                "m.csg:1: text: there is no valign \"up\", the default was taken"}));
  FontOptions strict;
  strict.strict = true;
  FontBook fonts(strict);
  const auto refused =
      parse_csg("m.csg", "text(text = \"I\", size = 10, font = \"Arial\");", {&fonts, nullptr});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().where.line, 1);
}

TEST(CsgLeaves, ImportsFilesOfTheirFolder) {
  CsgEnvironment environment;
  environment.read = [](const std::string& path) -> Result<std::string> {
    if (path == "a.svg")
      return std::string("<svg viewBox='0 0 9 9'><rect width='3' height='2'/></svg>");
    if (path == "a.off")
      return std::string(
          "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    if (path == "a.amf") {
      std::string vertices, triangles;
      for (const char* v : {"0 0 0", "1 0 0", "0 1 0", "0 0 1"}) {
        vertices += std::string("<vertex><coordinates><x>") + v[0] + "</x><y>" + v[2] + "</y><z>" +
                    v[4] + "</z></coordinates></vertex>";
      }
      for (const char* t : {"0 2 1", "0 1 3", "0 3 2", "1 2 3"}) {
        triangles += std::string("<triangle><v1>") + t[0] + "</v1><v2>" + t[2] + "</v2><v3>" +
                     t[4] + "</v3></triangle>";
      }
      return "<amf unit='inch'><object id='1'><mesh><vertices>" + vertices + "</vertices><volume>" +
             triangles + "</volume></mesh></object></amf>";
    }
    return Error{ErrorCode::kMalformedFile, "cannot read it", {}};
  };
  const auto import = [&](const std::string& text) {
    return parse_csg("m.csg", "import(" + text + ");", environment);
  };
  const auto drawing = import(
      "file = \"a.svg\", origin = [0, 0], dpi = 25.4, scale = 1, "
      "center = true, convexity = 1, timestamp = -5");
  ASSERT_TRUE(drawing);
  EXPECT_NEAR(drawing->shape.area(), 6, 1e-9);
  EXPECT_EQ(drawing->shape.bounds()[0], glm::dvec2(-1.5, -1));
  const auto mesh = import("file = \"a.off\"");
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->solid->mesh()->face_count(), 4u);
  // The middle of a mesh's box, and AMF's numbers as millimetres whatever unit it names.
  const auto extent = [&](const std::string& text) {
    const auto model = import(text);
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    std::array<glm::dvec3, 2> box{glm::dvec3(1e9), glm::dvec3(-1e9)};
    for (const glm::dvec3& p : model->solid->mesh()->points)
      box = {glm::min(box[0], p), glm::max(box[1], p)};
    return box;
  };
  using Box = std::array<glm::dvec3, 2>;
  EXPECT_EQ(extent("file = \"a.off\", center = false"), (Box{glm::dvec3(0), glm::dvec3(1)}));
  EXPECT_EQ(extent("file = \"a.off\", center = true"), (Box{glm::dvec3(-0.5), glm::dvec3(0.5)}));
  EXPECT_EQ(extent("file = \"a.amf\", center = false"), (Box{glm::dvec3(0), glm::dvec3(1)}));
  EXPECT_EQ(extent("file = \"a.amf\", center = true"), (Box{glm::dvec3(-0.5), glm::dvec3(0.5)}));
  // What import() and surface() without a file are written as.
  for (const char* nothing :
       {"import(file = \"\", origin = [0, 0]);", "surface(file = \"\", center = false);"}) {
    const CsgModel rest = parse(nothing + kCube);
    EXPECT_EQ(sketch(rest.solid), "cube");
    EXPECT_EQ(rest.warnings.size(), 1u);
  }
  const auto missing = import("file = \"b.svg\"");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, "import: cannot read it");
  EXPECT_EQ(
      import("file = \"b.nef3\"").error().message,
      "import: \"b.nef3\" has none of the endings .stl, .off, .obj, .ply, .3mf, .amf, .svg, .dxf");
}

TEST(CsgLeaves, ExtrusionsOfFilesAsOpenScad2021WritesThem) {
  CsgEnvironment environment;
  environment.read = [](const std::string& path) -> Result<std::string> {
    if (path != "a.dxf") return Error{ErrorCode::kMalformedFile, "cannot read it", {}};
    std::string lines = "0\nSECTION\n2\nENTITIES\n";
    const char* corners[] = {"1", "1", "4", "1", "4", "3", "1", "3", "1", "1"};  // of 3 x 2
    for (int i = 0; i < 8; i += 2) {
      lines += std::string("0\nLINE\n8\n0\n10\n") + corners[i] + "\n20\n" + corners[i + 1] +
               "\n11\n" + corners[i + 2] + "\n21\n" + corners[i + 3] + "\n";
    }
    return lines + "0\nENDSEC\n0\nEOF\n";
  };
  const auto top = [&](const std::string& text) {
    const auto model = parse_csg("m.csg", text, environment);
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    if (!model || model->solid->kind() != NodeKind::kLeaf) return glm::dvec3(0);
    EXPECT_TRUE(model->warnings.empty());
    glm::dvec3 most(-1e9);
    for (const glm::dvec3& p : model->solid->mesh()->points) most = glm::max(most, p);
    return most;
  };
  const std::string file = "(file = \"a.dxf\", layer = \"\", ";
  EXPECT_EQ(top("linear_extrude" + file +
                "origin = [0, 0], timestamp = 1, height = 5, center = false, convexity = 1, "
                "scale = [1, 1], $fn = 0, $fa = 12, $fs = 2);"),
            glm::dvec3(4, 3, 5));
  // The scale is that of the drawing, and that of the top.
  EXPECT_EQ(top("linear_extrude" + file +
                "origin = [1, 1], timestamp = 1, height = 5, center = false, convexity = 1, "
                "scale = [2, 2], $fn = 0, $fa = 12, $fs = 2);"),
            glm::dvec3(12, 8, 5));
  EXPECT_EQ(top("rotate_extrude" + file +
                "origin = [0, 0], scale = 2, timestamp = 1, angle = 360, convexity = 2, $fn = 4, "
                "$fa = 12, $fs = 2);"),
            glm::dvec3(8, 8, 6));
  const auto missing = parse_csg("m.csg", "\nlinear_extrude(file = \"b.dxf\");", environment);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().where.text() + ": " + missing.error().message,
            "m.csg:2: import: cannot read it");
}

TEST(CsgLeaves, PolyhedraAreWeldedAndChecked) {
  const std::string tetra =
      "polyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]], ";
  EXPECT_EQ(
      sketch(
          parse(tetra +
                "faces = [[0, 1, 2], [0, 3, 4], [0, 2, 3], [1, 3, 2], [1, 4, 2]], convexity = 1);")
              .solid),
      "polyhedron");
  EXPECT_EQ(error("\n" + tetra + "faces = [[0, 1, 2], [0, 3, 4], [0, 2, 3]]);").substr(0, 45),
            "m.csg:2: polyhedron: not closed: 3 open edges");
  EXPECT_EQ(
      error(tetra + "faces = [[0, 1, 2], [0, 3, 7], [0, 2, 3], [1, 3, 2]]);").substr(0, 119),
      "m.csg:1: polyhedron: index 7 in faces is out of range, there are 5 points; it was left "
      "out, and then polyhedron: not cl");
  EXPECT_EQ(parse("polyhedron(points = [], faces = []);").warnings,
            std::vector<std::string>{"m.csg:1: polyhedron: has no faces"});
  const CsgModel inside_out =
      parse(tetra + "faces = [[2, 1, 0], [1, 3, 0], [3, 2, 0], [2, 3, 1]]);");
  EXPECT_EQ(
      inside_out.warnings,
      std::vector<std::string>{"m.csg:1: polyhedron: inside out, its faces were turned over"});
}

// OpenSCAD draws them, so trees have them; there is no place in a .csg file to ask for a repair.
TEST(CsgLeaves, PolyhedraThatAreBrokenButClosedAreRepaired) {
  const std::string points =
      "polyhedron(points = [[0, 0, 0], [6, 0, 0], [0, 6, 0], [0, 0, 6], [3, 0, 0]], faces = ";
  const CsgModel turned = parse(points + "[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 2, 3]]);");
  EXPECT_EQ(turned.warnings,
            std::vector<std::string>{"m.csg:1: polyhedron: repair: 1 face was turned to agree with "
                                     "its neighbours (at (0, 0, 6))"});
  EXPECT_DOUBLE_EQ(testing::volume(*turned.solid->mesh()), 36);
  // A face on a line closes what would be a gap.
  const CsgModel flat =
      parse(points + "[[0, 1, 2], [0, 3, 4], [4, 3, 1], [0, 4, 1], [0, 2, 3], [1, 3, 2]]);");
  EXPECT_EQ(flat.warnings, std::vector<std::string>{
                               "m.csg:1: polyhedron: repair: 1 face without area was dropped (at "
                               "(6, 0, 0))"});
  EXPECT_DOUBLE_EQ(testing::volume(*flat.solid->mesh()), 36);
}

// Points that arithmetic put beside one another are one; a hole stays an error.
TEST(CsgLeaves, PolyhedraWithPointsTooNearToTellAreWelded) {
  const std::string points =
      "polyhedron(points = [[0, 0, 0], [6, 0, 0], [0, 6, 0], [0, 0, 6], [0, 0, 1e-14]], faces = ";
  const CsgModel near = parse(points + "[[0, 1, 2], [4, 3, 1], [0, 2, 3], [1, 3, 2]]);");
  ASSERT_EQ(near.warnings.size(), 1u);
  EXPECT_EQ(near.warnings[0].rfind("m.csg:1: polyhedron: repair: 1 point ", 0), 0u)
      << near.warnings[0];
  EXPECT_DOUBLE_EQ(testing::volume(*near.solid->mesh()), 36);
  const auto open = parse_csg("m.csg", points + "[[0, 1, 2], [4, 3, 1], [0, 2, 3]]);");
  ASSERT_FALSE(open);
  EXPECT_NE(open.error().message.find("not closed: "), std::string::npos);
}

TEST(CsgLeaves, PointsThatAreNoneMakeNothing) {
  for (const std::string list : {"[[], []]", "[[[]]]", "[[0, 0], [1, 0], [1]]"}) {
    EXPECT_EQ(parse("polygon(points = " + list + ", paths = undef);").warnings,
              std::vector<std::string>{"m.csg:1: polygon: points must be a list of lists of 2 "
                                       "numbers"});
  }
}

}  // namespace
}  // namespace csgrun::csg_leaves_test

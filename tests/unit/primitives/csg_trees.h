// Reading .csg trees in tests.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include <csgrun/primitives/csg_file.h>

namespace csgrun::testing {

inline CsgModel parse(const std::string& text) {
  auto model = parse_csg("m.csg", text);
  EXPECT_TRUE(model) << (model ? "" : model.error().where.text() + model.error().message);
  return model ? *model : CsgModel{Node::empty(), {}, false, {}};
}

inline std::string error(const std::string& text) {
  const auto model = parse_csg("m.csg", text);
  return model ? "no error" : model.error().where.text() + ": " + model.error().message;
}

/// The tree in one line.
inline std::string sketch(const NodePtr& node) {
  auto children = [&] {
    std::string out;
    for (const NodePtr& c : node->children()) {
      if (!out.empty()) out += ' ';
      out += sketch(c);
    }
    return out;
  };
  switch (node->kind()) {
    case NodeKind::kEmpty:
      return "empty";
    case NodeKind::kLeaf:
      return node->mesh()->kind;
    case NodeKind::kTransform:
      return "T(" + children() + ")";
    case NodeKind::kAppearance:
      return "C(" + children() + ")";
    case NodeKind::kOuterHull:
      return "H(" + children() + ")";
    case NodeKind::kConstruction:
      return std::string(1, "HMR"[static_cast<int>(node->construction())]) + "(" + children() + ")";
    case NodeKind::kBoolean:
      break;
  }
  constexpr const char* kOps[] = {"U(", "I(", "D(", "X("};
  return kOps[static_cast<int>(node->op())] + children() + ")";
}

inline const std::string kCube = "cube(size = [1, 2, 3], center = false);\n";
inline const std::string kSphere = "sphere($fn = 8, $fa = 12, $fs = 2, r = 1);\n";
inline const std::string kSquare = "square(size = [2, 1], center = true);\n";
inline const std::string kNothing = "group();\n";
inline const std::string kMove =
    "multmatrix([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, -0], [0, 0, 0, 1]])";

}  // namespace csgrun::testing

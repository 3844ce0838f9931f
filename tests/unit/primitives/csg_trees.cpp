#include "tests/unit/primitives/csg_trees.h"

#include <gtest/gtest.h>

namespace csgrun::testing {

CsgModel parse(const std::string& text) {
  auto model = parse_csg("m.csg", text);
  EXPECT_TRUE(model) << (model ? "" : model.error().where.text() + model.error().message);
  return model ? *model : CsgModel{Node::empty(), {}, false, {}};
}

std::string error(const std::string& text) {
  const auto model = parse_csg("m.csg", text);
  return model ? "no error" : model.error().where.text() + ": " + model.error().message;
}

std::string sketch(const NodePtr& node) {
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

}  // namespace csgrun::testing

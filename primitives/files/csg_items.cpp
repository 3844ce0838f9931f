#include "primitives/files/csg_items.h"

#include <algorithm>
#include <utility>

namespace csgrun {

Item::Kind settle_kind(std::vector<Item>& children, std::vector<std::string>& notes) {
  const auto first = std::find_if(children.begin(), children.end(), [](const Item& child) {
    return child.kind != Item::Kind::kNothing;
  });
  if (first == children.end()) return Item::Kind::kNothing;
  const Item::Kind kind = first->kind;
  for (Item& child : children) {
    if (child.kind == kind) continue;
    if (!child.is_empty())
      notes.emplace_back(kind == Item::Kind::kSolid ? "a 2D child among 3D ones was left out"
                                                    : "a 3D child among 2D ones was left out");
    child = Item();
  }
  return kind;
}

std::optional<Appearance> colour_of_first(const std::string& node,
                                          const std::vector<Item>& children,
                                          std::vector<std::string>& notes) {
  const Item* first = nullptr;
  for (const Item& child : children) {
    if (child.kind != Item::Kind::kFlat || child.is_empty()) continue;
    if (first == nullptr) first = &child;
    if (child.appearance == first->appearance || node == "difference") continue;
    notes.push_back(node + ": of 2D shapes of several colours the first's is kept");
    break;
  }
  return first != nullptr ? first->appearance : std::nullopt;
}

bool is_one_empty(const std::vector<Item>& children) {
  return children.size() == 1 && children[0].is_empty();
}

std::vector<Shape2D> take_shapes(std::vector<Item>& children) {
  std::vector<Shape2D> shapes;
  for (Item& child : children) shapes.push_back(std::move(child.shape));
  return shapes;
}

std::vector<NodePtr> take_solids(std::vector<Item>& children) {
  std::vector<NodePtr> solids;
  for (Item& child : children) {
    if (child.kind == Item::Kind::kSolid && child.solid->kind() != NodeKind::kEmpty)
      solids.push_back(std::move(child.solid));
  }
  return solids;
}

CsgSheet take_sheets(std::vector<Item>& children, std::optional<Appearance>& colour) {
  CsgSheet sheet;
  for (Item& child : children) {
    if (child.sheet.empty()) continue;
    if (sheet.empty()) colour = child.appearance;
    sheet.append(std::move(child.sheet));
  }
  return sheet;
}

void settle_cuts(Item& item) {
  if (item.uncut) item.solid = cut_as_it_lies(item.solid, *std::exchange(item.uncut, nullptr));
}

UncutPtr hand_on_or_settle(BooleanOp op, std::vector<Item>& children) {
  const auto counts = [](const Item& child) { return !child.is_empty(); };
  const auto only = std::find_if(children.begin(), children.end(), counts);
  if (only == children.end()) return nullptr;
  const bool is_only_one = op == BooleanOp::kUnion ? std::none_of(only + 1, children.end(), counts)
                                                   : children.size() == 1;
  if (is_only_one) return std::move(only->uncut);
  for (Item& child : children) settle_cuts(child);
  return nullptr;
}

NodePtr combine_solids(BooleanOp op, std::vector<Item>& children, const SourceRef& where) {
  const auto is_empty = [](const Item& child) {
    return child.kind != Item::Kind::kSolid || child.solid->kind() == NodeKind::kEmpty;
  };
  if (children.size() == 1) return children[0].solid;
  if (op == BooleanOp::kIntersection && std::any_of(children.begin() + 1, children.end(), is_empty))
    return nullptr;
  if (op != BooleanOp::kUnion && is_empty(children[0])) return children[0].solid;
  std::vector<NodePtr> operands = take_solids(children);
  if (operands.empty()) return nullptr;
  if (operands.size() == 1) return operands[0];
  return Node::boolean(op, std::move(operands), where);
}

bool sum_of_shapes_is_empty(const std::vector<Item>& children) {
  const auto is_shape = [](const Item& child) {
    return child.kind == Item::Kind::kFlat && !child.is_empty();
  };
  const auto shapes = std::count_if(children.begin(), children.end(), is_shape);
  return children.size() > 1 && (!is_shape(children.front()) || shapes == 1);
}

}  // namespace csgrun

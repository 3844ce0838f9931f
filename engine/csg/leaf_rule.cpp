#include "engine/csg/leaf_rule.h"

#include "engine/mesh/leaf_check.h"
#include "engine/mesh/mesh_text.h"

namespace csgrun {

InsideRule rule_of(const NormalNode& leaf) {
  if (leaf.hull) {
    if (leaf.hull->keep_voids) {
      return leaf.hull->orientation_sensitive ? InsideRule::kPositive : InsideRule::kNonZero;
    }
    return leaf.hull->orientation_sensitive ? InsideRule::kOrientedHull : InsideRule::kOuterHull;
  }
  switch (leaf.leaf->mesh()->fill) {
    case FillRule::kPositive:
      return InsideRule::kPositive;
    case FillRule::kEvenOdd:
      return InsideRule::kEvenOdd;
    default:
      return InsideRule::kNonZero;
  }
}

std::string rule_text(InsideRule rule) {
  switch (rule) {
    case InsideRule::kNonZero:
      return "the fill rule nonzero";
    case InsideRule::kPositive:
      return "the fill rule positive";
    case InsideRule::kEvenOdd:
      return "the fill rule evenodd";
    case InsideRule::kOuterHull:
      return "its outer hull";
    default:
      return "its orientation-sensitive outer hull";
  }
}

std::string describe_tangle(const QuantisedLeaf& leaf, const LeafRounding& rounding,
                            const GridStep& step) {
  const auto& crossings = leaf.prepared->crossings;
  if (crossings.empty()) {
    return "has shells that are inside out, or that lie in shells facing the same way";
  }
  const auto place = intersection_place(*leaf.prepared->geometry, crossings[0][0], crossings[0][1]);
  const double step_mm = step.millimetres();
  glm::dvec3 shown;
  for (int i = 0; i < 3; ++i) {
    shown[i] = (place[i] + static_cast<double>(leaf.origin[i])) * step_mm;
    if (!rounding.in_world) shown[i] = (shown[i] - rounding.offset[i]) / rounding.scale[i];
  }
  const std::string when = leaf.prepared->by_rounding
                               ? " once rounded to the grid of " + shortest_number(step_mm) + " mm"
                               : "";
  return "crosses itself" + when + ": " + std::to_string(crossings.size()) +
         (crossings.size() == 1 ? " pair" : " pairs") + " of faces, the first near " +
         rough_place_text(shown) + " mm" + (rounding.in_world ? "" : " of its own coordinates");
}

}  // namespace csgrun

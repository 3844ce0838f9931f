#include "primitives/solids/part_components.h"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "primitives/solids/box_gap.h"
#include "primitives/solids/box_leaf.h"

namespace csgrun {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();
const glm::dmat3 kWorld(1);

/// A box with what is that near to it.
BoxSearch::Box widened(const BoxSearch::Box& box, double by) {
  return {box[0] - glm::dvec3(by), box[1] + glm::dvec3(by)};
}

}  // namespace

NodePtr TurnedBox::node(const SourceRef& where) const {
  Affine map;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) map.m[i][k] = axes[k][i];
  }
  const NodePtr leaf = box_leaf(box[0], box[1], where);
  return axes == kWorld ? leaf : Node::transformed(map, leaf, where);
}

Parter::Parter(const Solid& solid, std::span<const std::vector<uint32_t>> triangles,
               const BoxSearch& search)
    : solid_(solid), triangles_(triangles), search_(search) {}

std::optional<Parting> Parter::part(uint32_t component, double noise) const {
  const BoxSearch::Box own = box_along(kWorld, component);
  Parting result;
  for (const uint32_t other : search_.near(component, 2 * noise)) {
    if (!part_from(component, other, noise, result)) return std::nullopt;
  }
  const double size = glm::length(own[1] - own[0]);
  result.around = widened(own, std::min(search_.least_gap(component, 2 * noise) / 2, size));
  return result;
}

/// Whether a box parts it from one whose box meets its own.
bool Parter::part_from(uint32_t component, uint32_t other, double noise, Parting& result) const {
  for (const glm::dmat3& axes : {kWorld, axes_of(component), axes_of(other)}) {
    TurnedBox its{axes, box_along(axes, other)};
    if (const double clear = gap(its, component); clear > 2 * noise) {
      its.box = widened(its.box, clear / 2);
      result.without.push_back(its);
      return true;
    }
    TurnedBox own{axes, box_along(axes, component)};
    if (const double clear = gap(own, other); clear > 2 * noise) {
      own.box = widened(own.box, clear / 2);
      result.within.push_back(own);
      return true;
    }
  }
  return false;
}

/// Along the normal of its largest triangle, and along that of the largest one which looks another
/// way.
glm::dmat3 Parter::axes_of(uint32_t component) const {
  const auto largest = [&](auto&& part_of) {
    glm::dvec3 best(0);
    each_triangle(component, kWorld, [&](const std::array<glm::dvec3, 3>& t) {
      const glm::dvec3 part = part_of(glm::cross(t[1] - t[0], t[2] - t[0]));
      if (glm::length(part) > glm::length(best)) best = part;
    });
    return glm::normalize(best);
  };
  const glm::dvec3 u = largest([](const glm::dvec3& normal) { return normal; });
  const glm::dvec3 v =
      largest([&](const glm::dvec3& normal) { return normal - u * glm::dot(u, normal); });
  return {u, v, glm::cross(u, v)};
}

BoxSearch::Box Parter::box_along(const glm::dmat3& axes, uint32_t component) const {
  BoxSearch::Box box{glm::dvec3(kEndless), glm::dvec3(-kEndless)};
  each_triangle(component, axes, [&](const std::array<glm::dvec3, 3>& corners) {
    for (const glm::dvec3& p : corners) {
      box[0] = glm::min(box[0], p);
      box[1] = glm::max(box[1], p);
    }
  });
  return box;
}

/// The least gap between a box and the surface of a component, see box_gap.
double Parter::gap(const TurnedBox& box, uint32_t component) const {
  double least = kEndless;
  each_triangle(component, box.axes, [&](const std::array<glm::dvec3, 3>& corners) {
    least = std::min(least, box_gap(box.box, corners));
  });
  return least;
}

}  // namespace csgrun

#include "primitives/files/uncut_mesh.h"

#include <limits>
#include <utility>

#include <glm/common.hpp>

#include <csgrun/primitives/shape_operations.h>

#include "primitives/solids/bent_quads.h"
#include "primitives/solids/finish_solid.h"

namespace csgrun {

UncutPtr uncut_of(PolygonMesh mesh) {
  if (mesh.face_count() == 0) return nullptr;
  auto uncut = std::make_shared<UncutMesh>();
  uncut->seen = mesh.points;
  uncut->mesh = std::make_shared<const PolygonMesh>(std::move(mesh));
  return uncut;
}

UncutPtr moved(const UncutPtr& uncut, const Affine& map, bool mirrors) {
  if (!uncut) return nullptr;
  auto result = std::make_shared<UncutMesh>(*uncut);
  for (glm::dvec3& p : result->seen) p = map.apply(p);
  result->is_mirrored ^= mirrors;
  return result;
}

UncutPtr resized(const UncutPtr& uncut, const Resize& resize) {
  if (!uncut) return nullptr;
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (const uint32_t corner : uncut->mesh->corners) {
    low = glm::min(low, uncut->seen[corner]);
    high = glm::max(high, uncut->seen[corner]);
  }
  const glm::dvec3 size = high - low;
  const auto factors = resize_factors<3>({size.x, size.y, size.z}, resize.size, resize.automatic);
  Affine map;
  for (size_t i = 0; i < 3; ++i) map.m[i][i] = factors[i];
  return moved(uncut, map, false);
}

NodePtr cut_as_it_lies(const NodePtr& solid, const UncutMesh& uncut) {
  PolygonMesh mesh = *uncut.mesh;
  cut_bent_quads(mesh, uncut.seen, uncut.is_mirrored);
  turn_outside(mesh);
  std::vector<NodePtr> above;
  NodePtr leaf = solid;
  for (; leaf->kind() != NodeKind::kLeaf; leaf = leaf->children()[0]) above.push_back(leaf);
  NodePtr cut = Node::leaf(std::make_shared<const PolygonMesh>(std::move(mesh)), leaf->where());
  for (; !above.empty(); above.pop_back()) {
    const Node& node = *above.back();
    if (node.kind() == NodeKind::kTransform) {
      cut = Node::transformed(node.transform(), std::move(cut), node.where());
    } else if (node.kind() == NodeKind::kAppearance) {
      cut = Node::painted(node.appearance(), std::move(cut), node.where());
    } else {
      cut = Node::resized(node.resize(), std::move(cut), node.where());
    }
  }
  return cut;
}

}  // namespace csgrun

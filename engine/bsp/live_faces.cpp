#include "engine/bsp/live_faces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/base/scratch.h"
#include "engine/bsp/near_faces.h"

namespace csgrun {
namespace {

/// The faces of a leaf on the grid that are not in dead space.
std::vector<uint32_t> live_faces_of(const Operand& operand, const DeadSpace& dead) {
  const LeafGeometry& leaf = *operand.leaf;
  Scratch scratch;
  const auto points = scratch.array<std::array<double, 3>>(leaf.vertices.size());
  for (size_t v = 0; v < points.size(); ++v) {
    for (size_t k = 0; k < 3; ++k) {
      points[v][k] = static_cast<double>(leaf.vertices[v][k] + operand.translation[k]);
    }
  }
  const auto live = scratch.array<uint32_t>(leaf.face_count());
  size_t live_count = 0;
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t first = leaf.face_starts[f], count = leaf.face_starts[f + 1] - first;
    const auto at = [&](uint32_t i) -> const auto& { return points[leaf.corners[first + i]]; };
    const PolygonBox box = box_of_face(leaf, f, operand.translation);
    live[live_count] = f;
    live_count += static_cast<size_t>(!dead.holds(box, count, at));
  }
  return {live.begin(), live.begin() + live_count};
}

}  // namespace

std::optional<LiveFaces> find_live_faces(const std::vector<Operand>& operands,
                                         const Expression& expression) {
  if (operands.size() <= 2 || expression.nodes.empty()) return std::nullopt;
  size_t faces = 0;
  for (const Operand& operand : operands) faces += operand.leaf ? operand.leaf->face_count() : 0;
  LiveFaces live;
  live.is_looked_at.assign(operands.size(), 0);
  live.is_partial = live.is_looked_at;
  live.faces.resize(operands.size());
  std::vector<PolygonBox> boxes(operands.size(), PolygonBox::everywhere());
  for_each_alone(operands.size(), faces > kFewForThreads, [&](size_t o) {
    const auto& leaf = operands[o].leaf;
    if (!leaf || leaf->face_count() == 0 || !operands[o].frame.is_identity) return;
    const std::optional<PolygonBox> box = box_of_leaf(*leaf, operands[o].translation);
    if (!box) return;
    boxes[o] = *box;
    live.is_looked_at[o] = can_be_partial(operands[o]) ? 1 : 0;
  });
  live.dead = std::make_shared<DeadSpace>(operands, expression, std::move(boxes));
  std::atomic<size_t> hidden = 0;
  for_each_alone(operands.size(), faces > kFewForThreads, [&](size_t o) {
    if (!live.is_looked_at[o]) return;
    const auto operand = static_cast<uint32_t>(o);
    if (!live.dead->may_be_open(operand, operands[o].leaf->face_count())) {
      live.is_looked_at[o] = 0;
      return;
    }
    if (!live.dead->may_hold_part(live.dead->operand_box(o))) return;
    std::vector<uint32_t> own = live_faces_of(operands[o], *live.dead);
    const size_t gone = operands[o].leaf->face_count() - own.size();
    if (gone == 0) return;
    live.is_partial[o] = 1;
    live.faces[o] = std::move(own);
    hidden += gone;
  });
  // If what is left asks for cells, all is done again with all faces.
  constexpr size_t kWorthIt = 8;
  if (hidden * kWorthIt < faces) return std::nullopt;
  return live;
}

}  // namespace csgrun

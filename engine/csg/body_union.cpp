#include "engine/csg/body_union.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/kernel.h"
#include "engine/csg/bodies.h"

namespace csgrun {
namespace {

using BoundaryPtr = std::shared_ptr<const BoundaryMesh>;

/// Whether to cut faces by all that cross them costs more than a Boolean of the bodies. The pieces
/// of a face are up to the square of the number of those: some half microsecond for each, against a
/// few for a face of a Boolean. With less than that at stake nothing need be known of bodies.
bool is_crowded(const LeafGeometry& leaf, std::span<const std::array<uint32_t, 2>> crossings) {
  constexpr uint64_t kEachFace = 8, kAtLeast = 4096;
  const uint64_t most = kAtLeast + kEachFace * leaf.face_count();
  std::vector<uint32_t> partners(leaf.face_count(), 0);
  for (const auto& [f, g] : crossings) {
    ++partners[f];
    ++partners[g];
  }
  uint64_t squares = 0;
  for (const uint64_t count : partners) squares += count * count;
  return squares > most;
}

/// The same surface, seen from behind.
LeafGeometry turned_over(LeafGeometry leaf) {
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    std::reverse(leaf.corners.begin() + leaf.face_starts[f],
                 leaf.corners.begin() + leaf.face_starts[f + 1]);
  }
  leaf.opposite.clear();
  return leaf;
}

/// Resolves a body that crosses itself; nothing if it wraps points a negative number of times.
Result<std::optional<BoundaryPtr>> resolve_body(const Body& body, InsideRule rule,
                                                const KernelOptions& options,
                                                EvaluateStats& stats) {
  const auto resolve = [&](std::shared_ptr<const LeafGeometry> leaf, InsideRule by) {
    Operand surface;
    surface.leaf = std::move(leaf);
    return resolve_surface(surface, body.prepared.crossings, by, options, stats);
  };
  const auto negative = resolve(
      std::make_shared<LeafGeometry>(turned_over(*body.prepared.geometry)), InsideRule::kPositive);
  if (!negative) return negative.error();
  if (!is_empty(**negative)) return std::optional<BoundaryPtr>();
  auto resolved = resolve(body.prepared.geometry, rule);
  if (!resolved) return resolved.error();
  return std::optional(*std::move(resolved));
}

/// A union, or the only operand.
Expression union_of(size_t count) {
  Expression expression;
  for (uint32_t o = 0; o < count; ++o) {
    expression.nodes.emplace_back().operand = o;
    expression.children.push_back(o);
  }
  if (count > 1) {
    Expression::Node& root = expression.nodes.emplace_back();
    root.is_operand = false;
    root.child_count = static_cast<uint32_t>(count);
  }
  return expression;
}

}  // namespace

std::optional<Result<BoundaryPtr>> resolve_bodies(
    const LeafGeometry& leaf, std::span<const std::array<uint32_t, 2>> crossings, InsideRule rule,
    const KernelOptions& options, EvaluateStats& stats) {
  const auto bodies = find_bodies(leaf, crossings);
  if (!bodies) return std::nullopt;
  constexpr size_t kOwnPart = 4;
  size_t own_crossings = 0;
  for (const Body& body : *bodies) own_crossings += body.prepared.crossings.size();
  if (kOwnPart * own_crossings > crossings.size()) return std::nullopt;
  std::vector<Operand> operands;
  for (const Body& body : *bodies) {
    Operand& operand = operands.emplace_back();
    if (body.prepared.status == PreparedLeaf::Status::kGood) {
      operand.leaf = body.prepared.geometry;
      continue;
    }
    auto resolved = resolve_body(body, rule, options, stats);
    if (!resolved) return resolved.error();
    if (!*resolved) return std::nullopt;
    operand.boundary = **std::move(resolved);
  }
  return evaluate_boolean(operands, union_of(operands.size()), box_of_points(leaf.vertices),
                          options, stats);
}

Result<BoundaryPtr> resolve_leaf(const Operand& surface,
                                 std::span<const std::array<uint32_t, 2>> crossings,
                                 InsideRule rule, const KernelOptions& options,
                                 EvaluateStats& stats) {
  const bool counts_up = rule == InsideRule::kNonZero || rule == InsideRule::kPositive;
  if (counts_up && options.whole_faces && !options.literal_cells &&
      is_crowded(*surface.leaf, crossings)) {
    if (auto result = resolve_bodies(*surface.leaf, crossings, rule, options, stats)) {
      return *std::move(result);
    }
  }
  return resolve_surface(surface, crossings, rule, options, stats);
}

}  // namespace csgrun

#include "engine/bsp/near_faces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/coarse_cells.h"
#include "engine/bsp/coarse_grid.h"

namespace csgrun {
namespace {

/// Boxes of polygons are clamped beyond.
constexpr int64_t kFarthest = int64_t{1} << 30;

/// Whether all faces that nothing meets can be named, wherever they are.
bool can_be_named(const Operand& operand) {
  if (!operand.leaf || !operand.frame.is_identity) return false;
  const LeafGeometry& leaf = *operand.leaf;
  return leaf.face_count() > 0 && leaf.has_single_fans && !leaf.may_touch &&
         !leaf.opposite.empty() && leaf.has_triangles_as_facets();
}

/// One leaf and its place.
class Leaf {
 public:
  explicit Leaf(const Operand& operand)
      : leaf_(*operand.leaf),
        translation_(operand.translation),
        cells_(leaf_.face_count()),
        is_near_(leaf_.vertices.size(), 0) {}

  [[nodiscard]] size_t face_count() const { return leaf_.face_count(); }

  /// None if it is too far out.
  [[nodiscard]] std::optional<PolygonBox> box() const {
    const GridBox all = box_of_points(leaf_.vertices).moved(translation_);
    PolygonBox box{};
    for (size_t k = 0; k < 3; ++k) {
      if (all.lo[k] < -kFarthest || all.hi[k] > kFarthest) return std::nullopt;
      box.lo[k] = static_cast<int32_t>(all.lo[k]);
      box.hi[k] = static_cast<int32_t>(all.hi[k]);
    }
    return box;
  }

  /// Marks the cells that faces reach; `own` names the operand. False if they are more than `most`.
  /// After the cells of all others have been marked it also notes the faces that share one.
  bool mark(CoarseGrid& grid, uint32_t own, size_t most, bool is_last) {
    RawVector<CoarseGrid::Place> places(leaf_.vertices.size());
    for_each_range(places.size(), [&](size_t begin, size_t end) {
      for (size_t v = begin; v < end; ++v) {
        const IVec3& p = leaf_.vertices[v];
        places[v] = grid.place_of(
            IVec3{p[0] + translation_[0], p[1] + translation_[1], p[2] + translation_[2]});
      }
    });
    std::atomic<size_t> all = 0;
    std::atomic<bool> failed = false;
    for_each_range(face_count(), [&](size_t begin, size_t end) {
      size_t sum = 0;
      for (size_t f = begin; f < end; ++f) {
        CoarseGrid::Cells& cells = cells_[f];
        const auto [a, b, c] = corners(f);
        const CoarseGrid::Place p = places[a], q = places[b], r = places[c];
        const CoarseGrid::Place pq_lo = p < q ? p : q, pq_hi = p < q ? q : p;
        if (sum + all.load(std::memory_order_relaxed) > most ||
            !grid.find_cells(pq_lo < r ? pq_lo : r, pq_hi > r ? pq_hi : r, cells)) {
          failed = true;
          return;
        }
        sum += cells.count();
        bool is_shared = false;
        grid.each_cell(cells,
                       [&](uint32_t& cell) { is_shared |= CoarseGrid::mark(cell, own, false); });
        if (is_last && is_shared) note_near(f);
      }
      all += sum;
    });
    return !failed;
  }

  /// Notes the faces that reach a cell of several operands.
  void find_shared(CoarseGrid& grid) {
    for_each_range(face_count(), [&](size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f) {
        bool is_shared = false;
        grid.each_cell(cells_[f],
                       [&](uint32_t cell) { is_shared |= cell == CoarseGrid::kSeveral; });
        if (is_shared) note_near(f);
      }
    });
  }

  /// Those of some faces.
  void copy_cells(const std::vector<uint32_t>& faces, CoarseGrid::Cells* to) const {
    for_each_range(faces.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) to[i] = cells_[faces[i]];
    });
  }

  /// The faces around vertices of those that were noted.
  [[nodiscard]] std::vector<uint32_t> near() const {
    return numbers_where(face_count(), [&](uint32_t f) {
      const auto [a, b, c] = corners(f);
      return (is_near_[a] | is_near_[b] | is_near_[c]) != 0;
    });
  }

 private:
  [[nodiscard]] std::array<uint32_t, 3> corners(size_t face) const {
    const uint32_t* const c = leaf_.corners.data() + 3 * face;
    return {c[0], c[1], c[2]};
  }

  void note_near(size_t face) {
    for (const uint32_t v : corners(face)) {
      std::atomic_ref(is_near_[v]).store(1, std::memory_order_relaxed);
    }
  }

  const LeafGeometry& leaf_;
  const IVec3 translation_;
  RawVector<CoarseGrid::Cells> cells_;  ///< per face
  std::vector<uint8_t> is_near_;        ///< per vertex: a face around it was noted
};

}  // namespace

PolygonBox box_of_triangle(const LeafGeometry& leaf, size_t face, const IVec3& translation) {
  const uint32_t* const c = leaf.corners.data() + 3 * face;
  const IVec3 &p = leaf.vertices[c[0]], &q = leaf.vertices[c[1]], &r = leaf.vertices[c[2]];
  PolygonBox box{};
  for (size_t k = 0; k < 3; ++k) {
    box.lo[k] = static_cast<int32_t>(std::min({p[k], q[k], r[k]}) + translation[k]);
    box.hi[k] = static_cast<int32_t>(std::max({p[k], q[k], r[k]}) + translation[k]);
  }
  return box;
}

std::optional<NearFaces> find_near_faces(const std::vector<Operand>& operands, uint32_t limit) {
  limit = std::max<uint32_t>(1, limit);
  if (operands.size() != 2 || !can_be_named(operands[0]) || !can_be_named(operands[1])) {
    return std::nullopt;
  }
  Leaf first(operands[0]), second(operands[1]);
  const size_t count = first.face_count() + second.face_count();
  const std::optional<PolygonBox> box = first.box(), other = second.box();
  if (!box || !other) return std::nullopt;
  PolygonBox common = *box;
  common.clip(*other);
  NearFaces near{{{}, {}}, {*box, *other}, {}};
  if (common.is_empty()) {
    near.cells = std::make_shared<PairCells>(no_shared_cells(count, limit));
    return near;
  }
  CoarseGrid grid(common, CoarseGrid::most_cells(count, limit));
  const size_t most = CoarseGrid::kMostCellsEach * count;
  if (!first.mark(grid, 1, most, false) || !second.mark(grid, 2, most, true)) return std::nullopt;
  first.find_shared(grid);
  near.faces = {first.near(), second.near()};
  const size_t near_count = near.faces[0].size() + near.faces[1].size();
  RawVector<CoarseGrid::Cells> cells(near_count);
  first.copy_cells(near.faces[0], cells.data());
  second.copy_cells(near.faces[1], cells.data() + near.faces[0].size());
  near.cells =
      std::make_shared<PairCells>(list_shared_cells(grid, cells, count - near_count, limit));
  return near;
}

}  // namespace csgrun

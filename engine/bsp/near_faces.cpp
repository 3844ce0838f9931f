#include "engine/bsp/near_faces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/coarse_cells.h"
#include "engine/bsp/coarse_grid.h"
#include "engine/bsp/frame_map.h"
#include "engine/bsp/near_pairs.h"
#include "engine/bsp/piece_tree.h"

namespace csgrun {
namespace {

/// Whether all faces that nothing meets can be named, wherever they are.
bool can_be_named(const Operand& operand) {
  if (!operand.leaf || FrameMap(operand.frame).is_mirrored()) return false;
  const LeafGeometry& leaf = *operand.leaf;
  return leaf.face_count() > 0 && leaf.has_single_fans && !leaf.may_touch &&
         !leaf.opposite.empty() && leaf.has_triangles_as_facets();
}

IVec3 moved(const IVec3& p, const IVec3& by) { return {p[0] + by[0], p[1] + by[1], p[2] + by[2]}; }

/// The vertices of a leaf in a frame; none if they are on the grid.
RoundedPoints round_vertices(const Operand& operand) {
  if (operand.frame.is_identity) return {};
  const FrameMap map(operand.frame);
  const std::vector<IVec3>& vertices = operand.leaf->vertices;
  RoundedPoints points(vertices.size());
  for_each_range(points.size(), [&](size_t begin, size_t end) {
    for (size_t v = begin; v < end; ++v) {
      points[v] = csgrun::rounded(map.point(moved(vertices[v], operand.translation)));
    }
  });
  return points;
}

/// One leaf and its place.
class Leaf {
 public:
  explicit Leaf(const Operand& operand)
      : leaf_(*operand.leaf),
        translation_(operand.translation),
        rounded_(round_vertices(operand)),
        is_on_grid_(operand.frame.is_identity),
        cells_(leaf_.face_count()),
        is_shared_(leaf_.face_count()) {}

  [[nodiscard]] size_t face_count() const { return leaf_.face_count(); }

  /// None if it is too far out.
  [[nodiscard]] std::optional<PolygonBox> box() const {
    return is_on_grid_ ? box_of_leaf(leaf_, translation_) : box_of_rounded(rounded_);
  }
  RoundedPoints take_rounded() { return std::move(rounded_); }

  /// Marks the cells that faces reach; `own` names the operand. False if they are more than `most`.
  /// After the cells of all others have been marked it also tells which faces share one.
  bool mark(CoarseGrid& grid, uint32_t own, size_t most, bool is_last) {
    // The box of a face is from the lowest of its corners to the highest, both rounded outwards.
    RawVector<CoarseGrid::Place> low(leaf_.vertices.size()), high(rounded_.size());
    for_each_range(low.size(), [&](size_t begin, size_t end) {
      for (size_t v = begin; v < end; ++v) {
        if (is_on_grid_) {
          low[v] = grid.place_of(moved(leaf_.vertices[v], translation_));
        } else {
          PieceBox box;
          box.add(rounded_[v]);
          const PolygonBox around = rounded_outwards(box);
          low[v] = grid.place_of(around.lo), high[v] = grid.place_of(around.hi);
        }
      }
    });
    const CoarseGrid::Place* const lows = low.data();
    const CoarseGrid::Place* const highs = is_on_grid_ ? lows : high.data();
    std::atomic<size_t> all = 0;
    std::atomic<bool> failed = false;
    for_each_range(face_count(), [&](size_t begin, size_t end) {
      size_t sum = 0;
      for (size_t f = begin; f < end; ++f) {
        CoarseGrid::Cells& cells = cells_[f];
        const auto [a, b, c] = corners(f);
        if (sum + all.load(std::memory_order_relaxed) > most ||
            !grid.find_cells(least(lows[a], lows[b], lows[c]),
                             greatest(highs[a], highs[b], highs[c]), cells)) {
          failed = true;
          return;
        }
        sum += cells.count();
        bool is_shared = false;
        grid.each_cell(cells,
                       [&](uint32_t& cell) { is_shared |= CoarseGrid::mark(cell, own, false); });
        if (is_last) is_shared_[f] = is_shared ? 1 : 0;
      }
      all += sum;
    });
    return !failed;
  }

  /// Finds the faces that reach a cell of several operands.
  void find_shared(CoarseGrid& grid) {
    for_each_range(face_count(), [&](size_t begin, size_t end) {
      for (size_t f = begin; f < end; ++f) {
        bool is_shared = false;
        grid.each_cell(cells_[f],
                       [&](uint32_t cell) { is_shared |= cell == CoarseGrid::kSeveral; });
        is_shared_[f] = is_shared ? 1 : 0;
      }
    });
  }
  /// In ascending order.
  [[nodiscard]] std::vector<uint32_t> shared() const {
    return numbers_where(face_count(), [&](uint32_t f) { return is_shared_[f] != 0; });
  }

  /// Those of some faces.
  void copy_cells(const std::vector<uint32_t>& faces, CoarseGrid::Cells* to) const {
    for_each_range(faces.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) to[i] = cells_[faces[i]];
    });
  }

  /// The faces around vertices of those that are chosen, which are some of a list.
  template <class Chosen>
  [[nodiscard]] std::vector<uint32_t> around(const std::vector<uint32_t>& faces,
                                             Chosen&& is_chosen) const {
    std::vector<uint8_t> is_near(leaf_.vertices.size(), 0);
    for_each_range(faces.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        if (!is_chosen(i)) continue;
        for (const uint32_t v : corners(faces[i])) {
          std::atomic_ref(is_near[v]).store(1, std::memory_order_relaxed);
        }
      }
    });
    return numbers_where(face_count(), [&](uint32_t f) {
      const auto [a, b, c] = corners(f);
      return (is_near[a] | is_near[b] | is_near[c]) != 0;
    });
  }

  void copy_boxes(const std::vector<uint32_t>& faces, PolygonBox* to) const {
    for_each_range(faces.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) to[i] = box_of(faces[i]);
    });
  }

 private:
  using Place = CoarseGrid::Place;

  static Place least(Place p, Place q, Place r) {
    const Place pq = p < q ? p : q;
    return pq < r ? pq : r;
  }
  static Place greatest(Place p, Place q, Place r) {
    const Place pq = p > q ? p : q;
    return pq > r ? pq : r;
  }

  [[nodiscard]] PolygonBox box_of(uint32_t face) const {
    if (is_on_grid_) return box_of_face(leaf_, face, translation_);
    PieceBox box;
    for (const uint32_t v : corners(face)) box.add(rounded_[v]);
    return rounded_outwards(box);
  }

  [[nodiscard]] std::array<uint32_t, 3> corners(size_t face) const {
    const uint32_t* const c = leaf_.corners.data() + 3 * face;
    return {c[0], c[1], c[2]};
  }

  const LeafGeometry& leaf_;
  const IVec3 translation_;
  RoundedPoints rounded_;  ///< of all vertices, if they are not on the grid
  const bool is_on_grid_;
  RawVector<CoarseGrid::Cells> cells_;  ///< per face
  RawVector<uint8_t> is_shared_;        ///< per face: it reaches a cell of several operands
};

/// The places of some faces in a list, both ascending, counted from `first`; those of faces that it
/// does not have mean nothing.
void number_among(const std::vector<uint32_t>& faces, const std::vector<uint32_t>& list,
                  size_t first, uint32_t* numbers) {
  size_t at = 0;
  for (size_t i = 0; i < faces.size(); ++i) {
    while (at < list.size() && list[at] < faces[i]) ++at;
    numbers[i] = static_cast<uint32_t>(first + at);
  }
}

/// The faces of both leaves that share cells, those of the second after those of the first, their
/// boxes, and the cells.
struct SharedFaces {
  std::array<std::vector<uint32_t>, 2> faces;
  RawVector<PolygonBox> boxes;
  PairCells cells;

  [[nodiscard]] size_t first(size_t o) const { return o == 0 ? 0 : faces[0].size(); }
};

SharedFaces list_shared(const std::array<Leaf, 2>& leaves, CoarseGrid& grid, uint32_t limit) {
  SharedFaces shared{{leaves[0].shared(), leaves[1].shared()}, {}, {}};
  const size_t total = shared.faces[0].size() + shared.faces[1].size();
  RawVector<CoarseGrid::Cells> cells(total);
  shared.boxes.resize(total);
  for (size_t o = 0; o < 2; ++o) {
    leaves[o].copy_cells(shared.faces[o], cells.data() + shared.first(o));
    leaves[o].copy_boxes(shared.faces[o], shared.boxes.data() + shared.first(o));
  }
  const size_t far = leaves[0].face_count() + leaves[1].face_count() - total;
  shared.cells = list_shared_cells(grid, cells, far, limit);
  return shared;
}

/// The near faces, by pairs if boxes tell enough, else all that share cells.
void add_faces(const std::array<Leaf, 2>& leaves, SharedFaces&& shared, NearFaces& near) {
  const size_t total = shared.boxes.size();
  auto pairs = find_near_pairs(shared.cells, shared.boxes, static_cast<uint32_t>(shared.first(1)));
  std::vector<uint8_t> is_chosen(total, pairs ? 0 : 1);
  if (pairs) {
    for (const auto& [f, g] : pairs->pairs) is_chosen[f] = is_chosen[g] = 1;
  }
  for (size_t o = 0; o < 2; ++o) {
    near.faces[o] = leaves[o].around(shared.faces[o],
                                     [&](size_t i) { return is_chosen[shared.first(o) + i] != 0; });
  }
  RawVector<uint32_t> number(total);  // of each shared face among the near ones
  const auto number_those_of = [&](size_t o) {
    number_among(shared.faces[o], near.faces[o], o == 0 ? 0 : near.faces[0].size(),
                 number.data() + shared.first(o));
  };
  run_both(
      total > kFewForThreads, [&] { number_those_of(0); }, [&] { number_those_of(1); });
  if (pairs) {
    for_each_range(pairs->pairs.size(), [&](size_t begin, size_t end) {
      for (size_t p = begin; p < end; ++p) {
        auto& [f, g] = pairs->pairs[p];
        f = number[f], g = number[g];
      }
    });
    near.pairs = std::make_shared<NearPairs>(*std::move(pairs));
  } else {
    for (uint32_t& face : shared.cells.polygons) face = number[face];
    near.cells = std::make_shared<PairCells>(std::move(shared.cells));
  }
}

}  // namespace

std::optional<PolygonBox> box_of_leaf(const LeafGeometry& leaf, const IVec3& translation) {
  const GridBox all = box_of_points(leaf.vertices).moved(translation);
  PolygonBox box{};
  for (size_t k = 0; k < 3; ++k) {
    if (all.lo[k] < -PolygonBox::kLimit || all.hi[k] > PolygonBox::kLimit) return std::nullopt;
    box.lo[k] = static_cast<int32_t>(all.lo[k]);
    box.hi[k] = static_cast<int32_t>(all.hi[k]);
  }
  return box;
}

PolygonBox box_of_face(const LeafGeometry& leaf, size_t face, const IVec3& translation) {
  const uint32_t* const begin = leaf.corners.data() + leaf.face_starts[face];
  const uint32_t* const end = leaf.corners.data() + leaf.face_starts[face + 1];
  IVec3 lo = leaf.vertices[*begin], hi = lo;
  for (const uint32_t* c = begin + 1; c < end; ++c) {
    const IVec3& p = leaf.vertices[*c];
    for (size_t k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
  }
  PolygonBox box{};
  for (size_t k = 0; k < 3; ++k) {
    box.lo[k] = static_cast<int32_t>(lo[k] + translation[k]);
    box.hi[k] = static_cast<int32_t>(hi[k] + translation[k]);
  }
  return box;
}

std::optional<NearFaces> find_near_faces(const std::vector<Operand>& operands, uint32_t limit) {
  limit = std::max<uint32_t>(1, limit);
  if (operands.size() != 2 || !can_be_named(operands[0]) || !can_be_named(operands[1])) {
    return std::nullopt;
  }
  std::array<Leaf, 2> leaves{Leaf(operands[0]), Leaf(operands[1])};
  const size_t count = leaves[0].face_count() + leaves[1].face_count();
  const std::optional<PolygonBox> box = leaves[0].box(), other = leaves[1].box();
  if (!box || !other) return std::nullopt;
  PolygonBox common = *box;
  common.clip(*other);
  NearFaces near{{{}, {}}, {*box, *other}, {}, {}, {}};
  const auto take_rounded = [&] {
    for (Leaf& leaf : leaves) near.rounded.push_back(leaf.take_rounded());
  };
  if (common.is_empty()) {
    near.cells = std::make_shared<PairCells>(no_shared_cells(count, limit));
    take_rounded();
    return near;
  }
  CoarseGrid grid(common, CoarseGrid::most_cells(count, limit));
  const size_t most = CoarseGrid::kMostCellsEach * count;
  if (!leaves[0].mark(grid, 1, most, false) || !leaves[1].mark(grid, 2, most, true)) {
    return std::nullopt;
  }
  leaves[0].find_shared(grid);
  add_faces(leaves, list_shared(leaves, grid, limit), near);
  take_rounded();
  return near;
}

}  // namespace csgrun

#include "engine/bsp/box_lattice.h"

#include <algorithm>

namespace csgrun {
namespace {

/// With more cells for each operand than that, faces cut one by one are less work.
constexpr uint64_t kCellsPerOperand = 2048;

/// Which side of a box a face lies in: twice the axis, and one more for the upper one; -1 for none.
int side_of(const LeafGeometry& leaf, uint32_t face, const GridBox& box) {
  for (size_t k = 0; k < 3; ++k) {
    for (int upper = 0; upper < 2; ++upper) {
      const int64_t at = upper ? box.hi[k] : box.lo[k];
      const auto begin = leaf.corners.begin() + leaf.face_starts[face],
                 end = leaf.corners.begin() + leaf.face_starts[face + 1];
      if (std::all_of(begin, end, [&](uint32_t v) { return leaf.vertices[v][k] == at; })) {
        return static_cast<int>(2 * k) + upper;
      }
    }
  }
  return -1;
}

struct PlainBox {
  GridBox box;
  std::array<FaceLabel, 6> sides;
};

/// A leaf whose faces all lie in the sides of its box is the box: the surface of a solid has no
/// rim.
std::optional<PlainBox> plain_box(const Operand& operand) {
  if (!operand.leaf || !operand.frame.is_identity) return std::nullopt;
  const LeafGeometry& leaf = *operand.leaf;
  if (leaf.face_count() == 0) return std::nullopt;
  PlainBox result;
  result.box = box_of_points(leaf.vertices);
  std::array<bool, 6> seen{};
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const int side = leaf.facet[f] == 0 ? side_of(leaf, f, result.box) : -1;
    if (side < 0) return std::nullopt;
    const FaceLabel label{operand.first_source, 0, leaf.surface[f],
                          operand.appearance.value_or(leaf.appearance[f])};
    FaceLabel& of_side = result.sides[static_cast<size_t>(side)];
    bool& is_seen = seen[static_cast<size_t>(side)];
    if (is_seen && of_side != label) return std::nullopt;
    of_side = label;
    is_seen = true;
  }
  result.box = result.box.moved(operand.translation);
  return result;
}

template <class T>
void sort_once(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

template <class T>
uint32_t place_of(const std::vector<T>& values, const T& value) {
  return static_cast<uint32_t>(std::lower_bound(values.begin(), values.end(), value) -
                               values.begin());
}

}  // namespace

std::optional<BoxLattice> make_lattice(const std::vector<Operand>& operands) {
  std::vector<PlainBox> boxes;
  for (const Operand& operand : operands) {
    auto box = plain_box(operand);
    if (!box) return std::nullopt;
    boxes.push_back(*box);
  }
  BoxLattice lattice;
  for (const PlainBox& b : boxes) {
    for (size_t k = 0; k < 3; ++k) {
      lattice.planes[k].insert(lattice.planes[k].end(), {b.box.lo[k], b.box.hi[k]});
    }
    lattice.labels.insert(lattice.labels.end(), b.sides.begin(), b.sides.end());
  }
  uint64_t cells = 1;
  for (auto& planes : lattice.planes) {
    sort_once(planes);
    cells *= planes.size();
    if (cells > kCellsPerOperand * operands.size()) return std::nullopt;
  }
  sort_once(lattice.labels);
  for (const PlainBox& b : boxes) {
    BoxLattice::Box& made = lattice.boxes.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      made.lo[k] = place_of(lattice.planes[k], b.box.lo[k]);
      made.hi[k] = place_of(lattice.planes[k], b.box.hi[k]);
      made.label[k] = {place_of(lattice.labels, b.sides[2 * k]),
                       place_of(lattice.labels, b.sides[2 * k + 1])};
    }
  }
  return lattice;
}

}  // namespace csgrun

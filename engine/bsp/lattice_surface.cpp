#include "engine/bsp/lattice_surface.h"

#include <algorithm>
#include <numeric>

#include "engine/bsp/canonical_order.h"
#include "engine/bsp/cell_geometry.h"

namespace csgrun {

LatticeSurface::LatticeSurface(const BoxLattice& lattice) : lattice_(lattice) {
  for (int k = 0; k < 3; ++k) cells_[static_cast<size_t>(k)] = lattice.plane_count(k) + size_t{1};
  for (size_t k = 0; k < 3; ++k) {
    squares_[k].assign(lattice.planes[k].size() * cells_[(k + 1) % 3] * cells_[(k + 2) % 3], 0);
    has_squares_[k].assign(cells_[k], 0);
  }
}

/// Walks around the regions of equal squares.
class LatticeTracer {
 public:
  explicit LatticeTracer(const LatticeSurface& surface)
      : surface_(surface), lattice_(surface.lattice_), geometry_(planes_, nullptr) {
    for (size_t k = 0; k < 3; ++k) {
      for (const int64_t at : lattice_.planes[k]) {
        Plane plane;
        (k == 0 ? plane.a : k == 1 ? plane.b : plane.c) = 1;
        plane.d = -at;
        ids_[k].push_back(planes_.intern(plane));
      }
    }
    points_.assign(
        lattice_.planes[0].size() * lattice_.planes[1].size() * lattice_.planes[2].size(), kNone);
  }

  BoundaryMesh run() {
    for (size_t axis = 0; axis < 3; ++axis) {
      axis_ = axis;
      for (plane_ = 0; plane_ < lattice_.planes[axis].size(); ++plane_) {
        if (surface_.has_squares_[axis][plane_]) trace_plane();
      }
    }
    return canonical(geometry_, planes_, std::move(draft_));
  }

 private:
  struct Loop {
    uint32_t square;  ///< what it is around
    uint32_t first, count;
  };
  /// The end of a straight run of edges, and the plane that holds them.
  struct Turn {
    uint32_t point, plane;
  };

  void trace_plane() {
    const size_t u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    const auto columns = static_cast<long>(surface_.cells_[v]);
    const size_t count = surface_.cells_[u] * surface_.cells_[v];
    const uint32_t* squares = surface_.squares_[axis_].data() + plane_ * count;
    // Edges 0 to 3 of a square run along u, along v, back along u and back along v, and have it on
    // their left as seen from above.
    along_ = {columns, 1, -columns, -1};
    outside_ = {-1, columns, 1, -columns};
    seen_.assign(count, 0);
    loops_.clear();
    turns_.clear();
    // No square is in a cell that reaches to infinity.
    for (size_t s = 0; s < count; ++s) {
      if (squares[s] == 0) continue;
      for (int edge = 0; edge < 4; ++edge) {
        if (squares[static_cast<long>(s) + outside_[static_cast<size_t>(edge)]] != squares[s] &&
            !(seen_[s] >> edge & 1)) {
          trace_loop(squares, static_cast<long>(s), static_cast<size_t>(edge));
        }
      }
    }
    add_faces();
  }

  void trace_loop(const uint32_t* squares, long square, size_t edge) {
    const uint32_t value = squares[square];
    Loop loop{value, static_cast<uint32_t>(turns_.size()), 0};
    while (!(seen_[static_cast<size_t>(square)] >> edge & 1)) {
      seen_[static_cast<size_t>(square)] |= static_cast<uint8_t>(1 << edge);
      const long ahead = square + along_[edge], right = ahead + outside_[edge];
      if (squares[ahead] != value) {  // also where another corner touches this one
        add_turn(static_cast<size_t>(square), edge);
        edge = (edge + 1) % 4;
      } else if (squares[right] != value) {
        square = ahead;
      } else {
        add_turn(static_cast<size_t>(square), edge);
        square = right;
        edge = (edge + 3) % 4;
      }
    }
    loop.count = static_cast<uint32_t>(turns_.size()) - loop.first;
    loops_.push_back(loop);
  }

  /// The end of an edge of a square.
  void add_turn(size_t square, size_t edge) {
    const size_t u = (axis_ + 1) % 3, v = (axis_ + 2) % 3;
    const size_t cell_u = square / surface_.cells_[v], cell_v = square % surface_.cells_[v];
    std::array<size_t, 3> at;
    at[axis_] = plane_;
    at[u] = edge < 2 ? cell_u : cell_u - 1;
    at[v] = edge == 1 || edge == 2 ? cell_v : cell_v - 1;
    const PlaneId plane = edge % 2 == 0 ? ids_[v][at[v]] : ids_[u][at[u]];
    turns_.push_back({point(at), plane.index()});
  }

  uint32_t point(const std::array<size_t, 3>& at) {
    uint32_t& known =
        points_[(at[0] * lattice_.planes[1].size() + at[1]) * lattice_.planes[2].size() + at[2]];
    if (known == kNone) {
      std::array<uint32_t, 3> planes;
      std::array<double, 3> rounded;
      for (size_t k = 0; k < 3; ++k) {
        planes[k] = ids_[k][at[k]].index();
        rounded[k] = static_cast<double>(lattice_.planes[k][at[k]]);
      }
      known = geometry_.add_point(planes, rounded);
    }
    return known;
  }

  /// A face for each label and side.
  void add_faces() {
    std::stable_sort(loops_.begin(), loops_.end(),
                     [](const Loop& a, const Loop& b) { return a.square < b.square; });
    const PlaneId plane = ids_[axis_][plane_];
    for (size_t l = 0; l < loops_.size(); ++l) {
      const bool upper = (loops_[l].square - 1) % 2 == 1;
      if (l == 0 || loops_[l].square != loops_[l - 1].square) {
        draft_.begin_face(upper ? plane : plane.flip(), lattice_.labels[(loops_[l].square - 1) / 2],
                          false, false);
      }
      const Turn* const turns = turns_.data() + loops_[l].first;
      const uint32_t count = loops_[l].count;
      for (uint32_t i = 0; i < count; ++i) {
        const uint32_t end = upper ? i : count - 1 - i, start = end > 0 ? end - 1 : count - 1;
        if (upper) {
          draft_.edges.push_back({turns[start].point, turns[end].point, turns[end].plane});
        } else {
          draft_.edges.push_back({turns[end].point, turns[start].point, turns[end].plane});
        }
      }
      draft_.end_loop();
    }
  }

  const LatticeSurface& surface_;
  const BoxLattice& lattice_;
  PlaneTable planes_;
  CellGeometry geometry_;
  std::array<std::vector<PlaneId>, 3> ids_;  ///< per axis and plane
  std::vector<uint32_t> points_;             ///< per crossing of three planes
  DraftBoundary draft_;
  size_t axis_ = 0, plane_ = 0;
  std::array<long, 4> along_{}, outside_{};  ///< steps to the squares ahead and on the right
  std::vector<uint8_t> seen_;                ///< per square: a bit for each edge
  std::vector<Loop> loops_;
  std::vector<Turn> turns_;
};

BoundaryMesh LatticeSurface::boundary() const { return LatticeTracer(*this).run(); }

}  // namespace csgrun

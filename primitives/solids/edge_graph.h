// The flat sides of a solid, the straight edges between them, and how these follow one another.
#pragma once

#include <csgrun/primitives/solid_edges.h>

#include "primitives/solids/edge_sides.h"

namespace csgrun {

class EdgeGraph {
 public:
  struct Edge {
    SolidEdge line;
    /// Of the solid, at `from` and at `to`; of those between which there are only edges of a few
    /// grid steps, which are none of these, the first.
    std::array<uint32_t, 2> vertex;
    std::array<uint32_t, 2> side;  ///< left and right of it
    /// next[end][k]: the edge that side k has beyond that end.
    std::array<std::array<uint32_t, 2>, 2> next;
  };

  EdgeGraph(const Solid& solid, double grid_step_mm);

  /// Ordered by their ends.
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  /// The edges of a side.
  [[nodiscard]] const std::vector<uint32_t>& edges_of(uint32_t side) const {
    return edges_of_[side];
  }
  /// The side that a triangle of the solid is in.
  [[nodiscard]] uint32_t side_of(uint32_t triangle) const { return sides_.of[triangle]; }
  /// One of the solid's faces that make a side.
  [[nodiscard]] uint32_t face(uint32_t side) const { return sides_.face[side]; }
  /// How far the corners of a side may be off its plane: 0 but for what is flat by the user's
  /// numbers only.
  [[nodiscard]] double roughness(uint32_t side) const {
    return sides_.normal[side] ? sides_.roughness : 0;
  }
  /// The step of the grid that the solid was evaluated on, in mm.
  [[nodiscard]] double grid_step() const { return grid_step_; }
  /// How many edges end at a vertex.
  [[nodiscard]] uint32_t degree(uint32_t vertex) const { return degree_[vertex]; }

 private:
  void find_twins();
  void find_lines();
  [[nodiscard]] uint32_t from(uint32_t half) const { return solid_.triangles[half / 3][half % 3]; }
  [[nodiscard]] uint32_t to(uint32_t half) const { return from(around(half)); }
  static uint32_t around(uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }
  [[nodiscard]] uint32_t side_at(uint32_t half) const { return sides_.of[half / 3]; }
  /// The half-edge of the same side's boundary that goes on from one of them.
  [[nodiscard]] uint32_t following(uint32_t half) const;
  [[nodiscard]] bool is_boundary(uint32_t half) const {
    return side_at(half) != side_at(twin_[half]);
  }
  /// Of the side of a half-edge.
  [[nodiscard]] glm::dvec3 normal_at(uint32_t half) const;
  /// How far what lies on both sides of an edge may be off its line.
  [[nodiscard]] double roughness_of(uint32_t half) const;
  [[nodiscard]] bool goes_straight_on(uint32_t half, uint32_t next) const;
  void add_line(uint32_t first, std::span<const uint32_t> halves);
  void contract_short_edges();
  void unite(uint32_t v, uint32_t w);
  /// The one that stands for a vertex.
  [[nodiscard]] uint32_t united(uint32_t v) const;
  void close_gap(uint32_t edge, int side);
  void relink(uint32_t of, uint32_t edge, uint32_t side, uint32_t to);
  void sort_edges();

  const Solid& solid_;
  const double grid_step_;
  double scale_ = 0;  ///< the largest coordinate
  std::vector<uint32_t> twin_;
  FlatSides sides_;
  std::vector<uint32_t> edge_of_;      ///< by half-edge
  std::vector<uint32_t> united_with_;  ///< by vertex: one before it, or itself
  std::vector<Edge> edges_;
  std::vector<std::vector<uint32_t>> edges_of_;
  std::vector<uint32_t> degree_;
};

}  // namespace csgrun

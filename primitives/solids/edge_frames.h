// What a cut along each chosen edge of a solid reaches on the sides beside it.
#pragma once

#include <optional>

#include "primitives/solids/edge_graph.h"

namespace csgrun {

/// A chosen edge with the directions along its sides, and how far the cut goes there.
struct EdgeFrame {
  uint32_t edge = 0;              ///< of the graph
  glm::dvec3 start{0}, along{0};  ///< its lower end, and towards the other, of length 1
  double length = 0;
  std::array<glm::dvec3, 2> in;  ///< into each side, across the edge, of length 1
  double setback = 0;            ///< how far the cut goes on both sides
  double reach = 0;              ///< how far bodies reach into one another
  bool is_flush = false;         ///< whether they end in the planes of the solid
  /// How far bodies reach beyond the surface, so that no face of theirs lies in one of the solid's.
  [[nodiscard]] double outwards() const { return is_flush ? 0 : reach; }
};

/// How a cut ends on one side of an edge.
enum class EdgeEnd : uint8_t {
  kCap,     ///< at a side that bounds the solid there
  kWall,    ///< at one that rises from the edge's end
  kMitre,   ///< at the cut of the next edge, at a corner that points outwards
  kInside,  ///< at the cut of the next edge, at a corner that points inwards
  kGoesOn   ///< the next edge is on the same line
};

class EdgeFrames {
 public:
  EdgeFrames(const EdgeGraph& graph, std::span<const uint32_t> chosen);

  /// Distance from the edge on both sides; for a fillet the radius, of which it follows.
  void set_size(double size, bool is_radius);
  void set_reach(size_t frame, double reach, bool is_flush) {
    frames_[frame].reach = reach;
    frames_[frame].is_flush = is_flush;
  }

  [[nodiscard]] const EdgeGraph& graph() const { return graph_; }
  [[nodiscard]] const std::vector<EdgeFrame>& frames() const { return frames_; }
  /// That of a graph's edge, or null when it is not chosen.
  [[nodiscard]] const EdgeFrame* frame_of(uint32_t edge) const {
    return number_[edge] == UINT32_MAX ? nullptr : &frames_[number_[edge]];
  }

  /// The kind of an end on a side, the normal of the plane beyond the edge that this side has
  /// next, and the place along the edge at which a line beside it, off by `offset` from it, meets
  /// that plane.
  [[nodiscard]] EdgeEnd kind(const EdgeFrame& f, int end, int side) const;
  [[nodiscard]] glm::dvec3 plane_normal(const EdgeFrame& f, int end, int side) const;
  [[nodiscard]] double at_plane(const EdgeFrame& f, int end, int side,
                                const glm::dvec3& offset) const;
  /// Where the line on a side at the setback meets that of the next edge, along the edge.
  [[nodiscard]] double at_next_cut(const EdgeFrame& f, int end, int side) const;
  /// Along the edge: 0, or its length.
  static double at_end(const EdgeFrame& f, int end) { return end == 0 ? 0 : f.length; }

  /// The first chosen edge whose cut leaves one of its sides or meets another cut on it.
  [[nodiscard]] std::optional<uint32_t> first_without_room() const;
  /// For such an edge, a size below `size` that fits, rounded down to something short. Sets sizes.
  double size_that_fits(uint32_t frame, double size, bool is_radius);

 private:
  /// What the next edge does in the plane of the side: along the edge, away from it at the end (x),
  /// and into the side (y).
  struct Next {
    uint32_t edge;
    double x, y;
  };
  [[nodiscard]] Next next(const EdgeFrame& f, int end, int side) const;
  /// The part of a side that goes: four corners, as {along the edge, into the side}.
  using Strip = std::array<std::array<double, 2>, 4>;
  [[nodiscard]] Strip strip(const EdgeFrame& f, int side) const;

  /// The corners of a strip in space.
  [[nodiscard]] std::array<glm::dvec3, 4> strip_in_space(const EdgeFrame& f, int side) const;
  [[nodiscard]] bool has_room(const EdgeFrame& f) const;
  /// Whether a strip is too short for its mitres.
  [[nodiscard]] bool is_turned_over(const EdgeFrame& f, int side) const;
  /// Whether the strip of a side leaves another edge of that side alone, and the strip of that.
  [[nodiscard]] bool has_room_beside(const EdgeFrame& f, int side, uint32_t other) const;

  const EdgeGraph& graph_;
  std::vector<EdgeFrame> frames_;
  std::vector<uint32_t> number_;
};

}  // namespace csgrun

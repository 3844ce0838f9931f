// What a cut along each chosen edge of a solid reaches on the sides beside it.
#pragma once

#include <optional>
#include <vector>

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
  kGoesOn   ///< the next edge is on the same line, up to the rounding of their ends
};

class EdgeFrames {
 public:
  EdgeFrames(const EdgeGraph& graph, std::span<const uint32_t> chosen);
  EdgeFrames(const EdgeFrames&) = delete;
  EdgeFrames& operator=(const EdgeFrames&) = delete;

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
  /// Of the kind kGoesOn: whether it is exactly on that line, as far as doubles tell.
  [[nodiscard]] bool goes_straight_on(const EdgeFrame& f, int end, int side) const;
  [[nodiscard]] glm::dvec3 plane_normal(const EdgeFrame& f, int end, int side) const;
  [[nodiscard]] double at_plane(const EdgeFrame& f, int end, int side,
                                const glm::dvec3& offset) const;
  /// Where the line on a side at the setback meets that of the next edge, along the edge.
  [[nodiscard]] double at_next_cut(const EdgeFrame& f, int end, int side) const;
  /// Along the edge: 0, or its length.
  static double at_end(const EdgeFrame& f, int end) { return end == 0 ? 0 : f.length; }

  /// Where the strip of a side ends at the setback, or, where the edge vanishes before, at most.
  [[nodiscard]] double strip_end(const EdgeFrame& f, int end, int side) const;
  /// Where the end of a strip has a bend, as where the next edge vanishes: a place on the side, and
  /// the one under it in the plane of a chamfer.
  struct Bend {
    glm::dvec3 top, below;
  };
  [[nodiscard]] std::vector<Bend> bends(const EdgeFrame& f, int end, int side) const;

  /// The first chosen edge whose cut leaves one of its sides or meets another cut on it.
  [[nodiscard]] std::optional<uint32_t> first_without_room() const;
  /// Where there is such an edge, a size below `size` at which there is none, rounded down to
  /// something short. Sets sizes. O(n log n), some twenty times.
  double size_that_fits(double size, bool is_radius);

 private:
  /// What the next edge does in the plane of the side: along the edge, away from it at the end (x),
  /// and into the side (y).
  struct Next {
    uint32_t edge;
    double x, y;
  };
  [[nodiscard]] Next next(const EdgeFrame& f, int end, int side) const;
  /// The sine by which the next edge may be aslant and go straight on all the same.
  [[nodiscard]] double most_bend(const EdgeFrame& f, const Next& next) const;
  /// The chosen edge that is next on a side, behind a corner that points outwards, if it stands
  /// like the one before it and no other cut ends there.
  struct Around {
    const EdgeFrame* frame = nullptr;  ///< null if there is none
    int far_end = 0, side = 0;         ///< of that edge
    double turn = 0;                   ///< at the corner, degrees
  };
  [[nodiscard]] Around around(const EdgeFrame& f, int end, int side) const;
  /// Calls visit(around) for one after another, while it says so.
  template <class Visit>
  void walk(const EdgeFrame& f, int end, int side, Visit&& visit) const;
  /// The part of a side that goes: convex, from the edge itself counter-clockwise, as {along the
  /// edge, into the side}. A short edge may vanish before the setback, between neighbours that
  /// stand like it: what is nearer to their lines is theirs.
  using Place = std::array<double, 2>;
  [[nodiscard]] std::vector<Place> strip(const EdgeFrame& f, int side) const;
  void find_turned_over();
  [[nodiscard]] std::vector<Place> clipped_strip(const EdgeFrame& f, int side) const;
  /// The same between its mitres alone: four corners.
  [[nodiscard]] std::array<Place, 4> plain_strip(const EdgeFrame& f, int side) const;
  [[nodiscard]] bool reaches_setback(const EdgeFrame& f, int side) const;

  /// The corners of a strip in space.
  [[nodiscard]] std::vector<glm::dvec3> strip_in_space(const EdgeFrame& f, int side) const;
  /// Whether a strip is too short for its mitres.
  [[nodiscard]] bool is_turned_over(const EdgeFrame& f, int side) const {
    return is_turned_over_[number_[f.edge]][static_cast<size_t>(side)];
  }
  [[nodiscard]] bool has_room_at_ends(const EdgeFrame& f, int side) const;
  /// Whether the strip of a side leaves another edge of that side alone, and the strip of that.
  [[nodiscard]] bool has_room_beside(const EdgeFrame& f, int side, uint32_t other) const;

  const EdgeGraph& graph_;
  std::vector<EdgeFrame> frames_;
  std::vector<uint32_t> number_;
  /// By frame, end and side.
  std::vector<std::array<std::array<Around, 2>, 2>> around_;
  /// Per frame and side, for the size that was set last: whether the strip is turned over, and, if
  /// any is, the strips that were asked for.
  std::vector<std::array<bool, 2>> is_turned_over_;
  bool any_turned_over_ = false;
  mutable std::vector<std::array<std::vector<Place>, 2>> strips_;
};

}  // namespace csgrun

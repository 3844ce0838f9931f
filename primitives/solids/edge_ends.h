// Where the bodies along chosen edges end: at other sides of the solid, and at one another.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include <csgrun/engine/error.h>

#include "primitives/solids/edge_frames.h"

namespace csgrun {

/// The plane in which the cuts of two edges meet at a corner that points inwards: through the
/// corner, the point where their lines on the common side meet, and the third edge.
struct Mitre {
  glm::dvec3 corner{0}, normal{0};  ///< the normal points away from the edge
  double reach = 0;                 ///< more than what the cuts need around the corner
  double gap = 0;  ///< so far from the plane a cut ends, less than it reaches out of the solid
};

/// A vertex all three edges of which are chosen.
struct EdgeCorner {
  uint32_t vertex;
  std::array<uint32_t, 3> frames;
  glm::dvec3 centre{0};  ///< of the ball, for fillets
};

/// A vertex of more than three edges, all of which are chosen.
struct EdgeTip {
  uint32_t vertex;
  std::vector<uint32_t> frames;
};

class EdgeEnds {
 public:
  /// `radius` of fillets, else 0.
  EdgeEnds(const Solid& solid, const EdgeFrames& frames, double radius);

  [[nodiscard]] const std::vector<EdgeCorner>& corners() const { return corners_; }
  [[nodiscard]] const std::vector<EdgeTip>& tips() const { return tips_; }
  [[nodiscard]] bool is_tip(const EdgeFrame& f, int end) const {
    const auto at = [](const EdgeTip& tip, uint32_t vertex) { return tip.vertex < vertex; };
    const uint32_t vertex = edge(f).vertex[end];
    const auto found = std::lower_bound(tips_.begin(), tips_.end(), vertex, at);
    return found != tips_.end() && found->vertex == vertex;
  }
  /// The end of an edge at a vertex.
  [[nodiscard]] int end_at(const EdgeFrame& f, uint32_t vertex) const {
    return edge(f).vertex[0] == vertex ? 0 : 1;
  }
  /// That at an end of an edge, or null.
  [[nodiscard]] const EdgeCorner* corner_at(const EdgeFrame& f, int end) const;
  /// The two sides of the first edge of a corner, and the one that both others have.
  [[nodiscard]] std::array<glm::dvec3, 3> normals_at(const EdgeCorner& corner) const;
  /// The point that is as far in front of all three sides at a corner.
  [[nodiscard]] glm::dvec3 in_front(const EdgeCorner& corner, double distance) const;

  /// The three lines along an edge between which its prism is, as offsets from the edge: those on
  /// the sides and the one outside of the edge.
  using Lines = std::array<glm::dvec3, 3>;
  [[nodiscard]] static Lines lines(const EdgeFrame& f);
  /// Where the lines on the sides meet those of the next edges, at one end.
  [[nodiscard]] std::array<glm::dvec3, 2> meeting_points(const EdgeFrame& f, int end) const;
  struct PrismEnd {
    std::array<double, 3> at{};  ///< where these lines end
    /// What else the prism goes round, where the mitre has bends.
    std::vector<glm::dvec3> bends;
    std::optional<Mitre> wall;  ///< the prism goes beyond it
  };
  /// Fails where edges that are not chosen come between those that are.
  [[nodiscard]] Result<PrismEnd> end_of(const EdgeFrame& f, int end) const;
  [[nodiscard]] Mitre mitre_at(const EdgeFrame& f, int end, int side) const;
  /// At a corner of a rim that points inwards (edge_rims.h): beyond the mitre, and along it.
  [[nodiscard]] PrismEnd end_beyond_mitre(const EdgeFrame& f, int end) const;
  /// So many times the reach prisms go beyond mitres of corners that point inwards.
  static constexpr double kBeyondMitres = 8;

  /// Whether bodies along an edge can end in the very planes of the solid: where these are upright
  /// on the axes, all that is on the grid is in them.
  [[nodiscard]] bool can_be_flush(const EdgeFrame& f) const;

 private:
  void find_corners(double radius);
  /// Where a plane through the end of an edge meets the lines, and so much farther along it.
  [[nodiscard]] PrismEnd end_in_plane(const EdgeFrame& f, int end, const glm::dvec3& normal,
                                      double more) const;
  [[nodiscard]] bool is_convex(uint32_t vertex, std::span<const uint32_t> frames) const;
  [[nodiscard]] const EdgeGraph::Edge& edge(const EdgeFrame& f) const {
    return frames_.graph().edges()[f.edge];
  }

  const Solid& solid_;
  const EdgeFrames& frames_;
  const bool is_fillet_;
  std::vector<EdgeCorner> corners_;
  std::vector<EdgeTip> tips_;        ///< ascending
  std::vector<uint32_t> corner_of_;  ///< by vertex of the solid: its place in corners_
};

bool is_along_axis(const glm::dvec3& unit);

/// "the edge from {0, 0, 0} to {1, 0, 0}", for messages.
std::string edge_text(const SolidEdge& edge);

}  // namespace csgrun

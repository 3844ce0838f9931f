// Whether two triangles over doubles meet in more than corners and edges that both have, exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <csgrun/engine/exact_triangles.h>

#include "engine/mesh/triangle_shape.h"

namespace csgrun {

class CrossingTest {
 public:
  /// A point that two triangles have, as doubles tell it; none when they do not meet.
  using Meeting = std::optional<glm::dvec3>;

  /// O(n) for n triangles.
  explicit CrossingTest(const TriangleView& mesh);

  /// The triangle has other corners now.
  void renew(const TriangleView& mesh, uint32_t triangle);

  [[nodiscard]] bool has_area(uint32_t triangle) const { return views_[triangle].sign != 0; }

  /// A point of both triangles, which have area, beyond the corners and edges which both have.
  [[nodiscard]] Meeting crossing(uint32_t first, uint32_t second) const;

 private:
  using Triangle = std::array<uint32_t, 3>;

  /// The plane of a triangle, that tells quickly on which side of it most points are.
  class QuickPlane {
   public:
    explicit QuickPlane(const TriangleCorners& t);
    /// +1 or -1, or 0 where doubles do not tell.
    [[nodiscard]] int side(const glm::dvec3& p) const;

   private:
    glm::dvec3 origin_, normal_, size_;
  };

  static size_t index_of(const std::array<bool, 3>& flags, bool value);
  [[nodiscard]] glm::dvec3 middle(const Triangle& t) const;
  /// Whether the corners of a triangle that another one has not are plainly on one side of that
  /// one's plane: then it has nothing of the plane but the others.
  [[nodiscard]] bool is_clear_of(const Triangle& t, const std::array<bool, 3>& is_shared,
                                 uint32_t other) const;
  [[nodiscard]] int side(const Triangle& t, uint32_t point) const;
  /// Whether a point of the triangle's plane lies in it, boundary included.
  [[nodiscard]] bool contains(uint32_t triangle, uint32_t point) const;
  /// Where two segments of one plane, seen along `axis`, meet.
  [[nodiscard]] Meeting segments_meet(int axis, uint32_t a, uint32_t b, uint32_t c,
                                      uint32_t d) const;
  /// Segments of one line meet when an end of one lies in the other, which is in its box.
  [[nodiscard]] Meeting collinear_meet(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const;
  /// The point of the segment whose distances at its ends are these, of different signs or zero.
  [[nodiscard]] glm::dvec3 between(uint32_t a, double at_a, uint32_t b, double at_b) const;
  /// Where the segment a b meets the triangle, boundaries included.
  [[nodiscard]] Meeting segment_meets(uint32_t a, uint32_t b, uint32_t triangle) const;
  [[nodiscard]] Meeting segment_meets_in_plane(uint32_t a, uint32_t b, uint32_t triangle) const;
  [[nodiscard]] Meeting without_common_corner(uint32_t first, uint32_t second) const;
  /// Whether all corners of s lie strictly on one side of t's plane.
  [[nodiscard]] bool is_apart(const Triangle& s, const Triangle& t) const;
  /// What they have in common beyond one corner ends on a side opposite to it.
  [[nodiscard]] Meeting beyond_corner(uint32_t first, size_t s_at, uint32_t second,
                                      size_t t_at) const;
  /// Two that share an edge overlap when they lie in one plane and on one side of the edge.
  [[nodiscard]] Meeting beyond_edge(uint32_t first, size_t s_at, uint32_t second,
                                    size_t t_at) const;

  std::span<const glm::dvec3> p_;
  std::span<const Triangle> triangles_;
  std::vector<TriangleAspect> views_;
  std::vector<QuickPlane> planes_;
};

}  // namespace csgrun

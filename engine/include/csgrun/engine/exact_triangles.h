// Exact questions about a triangle mesh over doubles, as it stands in a file: no grid, no rounding.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace csgrun {

/// Somebody's arrays. Coordinates are finite.
struct TriangleView {
  std::span<const glm::dvec3> points;
  std::span<const std::array<uint32_t, 3>> triangles;
};

/// Two triangles that meet in anything but corners and edges which both have.
struct TriangleCrossing {
  std::array<uint32_t, 2> triangles{};  ///< the smaller number first
  glm::dvec3 place{};  ///< near a point that both have: correct to a few roundings below 1e100
};

/// Crossings of a mesh in ascending order of their triangles; at most `most` of them, then the
/// search ends. Corners are the same when they have the same number: weld points of equal
/// coordinates first where surfaces may touch. Touching counts: a corner in the middle of another's
/// edge or face, overlapping edges, overlapping triangles of one plane. Triangles without area are
/// left out. Exact. O(n log n) and the pairs whose boxes overlap: about 1 us a triangle on a clean
/// mesh. On so many threads; 0: as many as the process may use.
std::vector<TriangleCrossing> find_crossings(const TriangleView& mesh, uint64_t most,
                                             unsigned threads = 0);

/// The same for a mesh in which triangles cross only where `some`, which ascend, do: O(n), and
/// O(log n) and the pairs whose boxes overlap for each of these.
std::vector<TriangleCrossing> find_crossings(const TriangleView& mesh, uint64_t most,
                                             std::span<const uint32_t> some, unsigned threads = 0);

/// What single triangles cross, as find_crossings() has it, while a few of them change.
class LocalCrossings {
 public:
  /// The arrays of the view outlive this; corners of triangles may change, points may not.
  /// O(n log n).
  explicit LocalCrossings(const TriangleView& mesh);
  ~LocalCrossings();
  LocalCrossings(const LocalCrossings&) = delete;
  LocalCrossings& operator=(const LocalCrossings&) = delete;

  /// The triangle has other corners now, or its old ones again.
  void changed(uint32_t triangle);
  /// The triangles that it crosses, ascending; none if it has no area. O(log n), and the triangles
  /// whose boxes overlap its own.
  [[nodiscard]] std::vector<uint32_t> of(uint32_t triangle) const;

 private:
  class Search;
  std::unique_ptr<Search> search_;
};

/// Whether the triangle's corners lie on one line, or coincide. Exact.
bool is_degenerate(const TriangleView& mesh, uint32_t triangle);

/// The sign of normal . direction, where the normal is that from which the triangle's corners run
/// counter-clockwise. Exact for the doubles given.
int facing(const TriangleView& mesh, uint32_t triangle, const glm::dvec3& direction);

/// How often the surface wraps around a point just in front of each of `triangles`, near its
/// middle: 0 outside and 1 inside of a solid, less than 0 in front of what is inside out. Exact.
/// REQUIRES: the mesh is closed; these triangles have area, and nothing meets their insides.
/// O(log n) for each, and the triangles whose boxes a ray from there along an axis meets.
std::vector<int> windings_in_front(const TriangleView& mesh, std::span<const uint32_t> triangles);

/// The volume that a closed mesh encloses, negative when it is inside out: the exact sum, rounded
/// once.
double exact_volume(const TriangleView& mesh);

/// The sign of the determinant of b - a, c - a, d - a: positive when d lies on the side from which
/// a, b, c run counter-clockwise. Exact; a filter in doubles answers first.
int orient(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// The sign of the area of a, b, c seen along `axis` (0, 1, 2), the other two axes in cyclic order.
/// Exact, with a filter.
int orient_along(int axis, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace csgrun

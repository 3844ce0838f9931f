// Where two convex polygons meet: a segment whose ends are named by an edge of one and the plane of
// the other, or, where a sign is zero, by a corner.
//
// Both polygons cut the line in which their planes meet in an interval. Seen along the direction d
// = n_p x n_q, p's interval runs from the edge on which its boundary rises through q's plane to the
// one on which it falls, and q's from where it falls through p's plane to where it rises. Which of
// two ends comes first is the orientation of the two edges (Guigue & Devillers 2003).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/corner_blocks.h"
#include "engine/bsp/flat_pair.h"
#include "engine/bsp/vertex_signs.h"

namespace csgrun {

/// What two polygons of different operands have in common. If their planes differ, a segment (or a
/// point), from its lower end along n_p x n_q to the upper one: on p, what is behind q is on its
/// left, seen from outside; on q, what is behind p is on its right.
struct Contact {
  /// Where an edge (by its first corner) of p or q passes through the other's plane.
  struct End {
    bool on_p;
    uint32_t edge;
    uint32_t vertex;  ///< the corner in the plane, or kNone
  };
  uint32_t p, q;
  bool is_plain;     ///< no sign was zero
  bool is_coplanar;  ///< then there are no ends
  /// Whether p has corners in front of q's plane and behind it, and the reverse.
  bool p_front, p_back, q_front, q_back;
  End lower, upper;

  /// Whether all that they have in common is a corner of one of them.
  [[nodiscard]] bool is_corner() const {
    return !is_coplanar && lower.vertex != kNone && lower.vertex == upper.vertex;
  }
};

enum class Meeting : uint8_t {
  kApart,
  kContact,
  kFlatCorner,  ///< they are coplanar and have a corner of both in common, and nothing else
  kUndecided,   ///< without planes this cannot be told
};

class PairTest {
 public:
  explicit PairTest(const Job& job);

  /// How p and q, of different operands, meet; fills in `contact` unless they are apart. (Coplanar
  /// ones are said to be in contact when their boxes are, but for triangles on the grid that have
  /// nothing in common, or a corner of both.) Where doubles and 128-bit integers do not do, and
  /// `planes` is given, planes decide; they must have been made.
  Meeting run(uint32_t p, uint32_t q, CellGeometry* planes, Contact& contact);
  /// Equal vertices have one number, unequal ones have not; kNone: that is not known of one. Where
  /// polygons have corners in common, signs are zero that doubles do not tell in frames.
  void know_equal_vertices(std::vector<uint32_t> numbers) { number_of_ = std::move(numbers); }
  /// After a contact that is not plain: the corners of either polygon in the other's plane. After
  /// kFlatCorner: the two in common.
  void add_touching_vertices(const Contact& contact, std::vector<uint32_t>& vertices) const;

  [[nodiscard]] const VertexSigns& signs() const { return signs_; }

 private:
  /// Where the boundary of a polygon falls and rises through the other's plane, by edges.
  struct Passage {
    uint32_t falls = 0, rises = 0;
    bool front = false, back = false, zero = false;  ///< corners of each kind
  };

  /// Of four vertices of two operands, whose coordinates are off by `error` at most.
  int orient(const std::array<uint32_t, 4>& v, uint32_t operand, uint32_t other, double error) {
    if (planes_only_) return kUnsure;
    const int sign = signs_.orient(job_.rounded(v[0]), job_.rounded(v[1]), job_.rounded(v[2]),
                                   job_.rounded(v[3]), error);
    return sign == kUnsure && error > 0 ? orient_whole(v, operand, other) : sign;
  }
  int orient_whole(const std::array<uint32_t, 4>& vertices, uint32_t operand, uint32_t other);
  struct Base {
    uint32_t polygon = kNone;
    std::array<uint32_t, 3> corners{};
    VertexSigns::Base signs;  ///< set with the polygon
    /// If the plane is one of a coordinate along an axis: that one, and whether it grows to the
    /// front.
    bool is_level = false, grows = false;
    size_t axis = 0;
    double level = 0;
  };
  const Base& base_of(uint32_t polygon);
  void find_level(Base& base) const;
  int corner_sides(uint32_t p, uint32_t q, std::vector<int8_t>& sides);
  int level_sides(const JobPolygon& own, const Base& base, std::vector<int8_t>& sides);
  int corner_side(const JobPolygon& own, const JobPolygon& other, const Base& base, uint32_t vertex,
                  double error);
  static constexpr bool walk(std::span<const int8_t> sides, Passage& passage);
  static bool find_passage(const std::vector<int8_t>& sides, Passage& passage);
  /// Whether the point in which edge i of p passes through q's plane lies on the inner side of edge
  /// j of q: +1, 0, -1, or kUnsure. `falls`: towards the back of q.
  int inside(uint32_t p, uint32_t i, bool falls, uint32_t q, uint32_t j);
  [[nodiscard]] bool are_equal(uint32_t vertex, uint32_t other) const {
    return number_of_[vertex] != kNone && number_of_[vertex] == number_of_[other];
  }
  [[nodiscard]] bool is_corner_of(uint32_t vertex, const JobPolygon& polygon) const;
  Meeting flat_meeting(const Contact& contact);
  [[nodiscard]] Contact::End end_of(uint32_t polygon, uint32_t edge, bool on_p) const;

  const Job& job_;
  VertexSigns signs_;
  std::array<Base, 128> bases_;  ///< of the polygons that were asked for last
  CornerBlocks blocks_;
  const bool planes_only_;  ///< tests want to see that
  CellGeometry* planes_ = nullptr;
  std::vector<uint32_t> number_of_;  ///< see know_equal_vertices; empty: nothing is known
  std::vector<int8_t> sides_p_, sides_q_;
  FlatPair flat_;  ///< what the last pair has in common if it is coplanar and was told
};

}  // namespace csgrun

#include "engine/bsp/pair_test.h"

#include <algorithm>
#include <cassert>

#include "engine/exact/forced_tier.h"

namespace csgrun {
namespace {

/// Three corners of a polygon that are not collinear, in its order: those of the largest triangle
/// at the first corner, as doubles tell.
std::array<uint32_t, 3> base_corners(const Job& job, const JobPolygon& polygon) {
  const auto corners = job.corners(polygon);
  if (corners.size() == 3) return {corners[0], corners[1], corners[2]};
  const auto& a = job.rounded(corners[0]);
  double largest = 0;
  size_t best = 1;
  for (size_t i = 1; i + 1 < corners.size(); ++i) {
    const auto &b = job.rounded(corners[i]), &c = job.rounded(corners[i + 1]);
    const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    const double size = x * x + y * y + z * z;
    if (size > largest) largest = size, best = i;
  }
  return {corners[0], corners[best], corners[best + 1]};
}

}  // namespace

PairTest::PairTest(const Job& job)
    : job_(job), signs_(job, false), blocks_(job), planes_only_(forced_tier >= 0) {}

/// Pairs come by the second polygon, and the first one's neighbours follow each other.
const PairTest::Base& PairTest::base_of(uint32_t polygon) {
  Base& known = bases_[polygon % bases_.size()];
  if (known.polygon != polygon) {
    known = {};
    known.polygon = polygon;
    known.corners = base_corners(job_, job_.polygons()[polygon]);
    known.signs = VertexSigns::base(job_.rounded(known.corners[0]), job_.rounded(known.corners[1]),
                                    job_.rounded(known.corners[2]));
    if (!planes_only_) find_level(known);
  }
  return known;
}

void PairTest::find_level(Base& base) const {
  [[maybe_unused]] constexpr Int128 kExact = Int128{1} << 53;  // doubles hold it
  const JobPolygon& polygon = job_.polygons()[base.polygon];
  if (polygon.support.valid()) {
    const Plane plane = job_.planes().oriented(polygon.support);
    const std::array<Int128, 3> normal{plane.a, plane.b, plane.c};
    for (size_t k = 0; k < 3; ++k) {
      const bool is_unit = normal[k] == 1 || normal[k] == -1;
      if (!is_unit || normal[(k + 1) % 3] != 0 || normal[(k + 2) % 3] != 0) continue;
      assert(plane.d < kExact && plane.d > -kExact);  // it is a coordinate
      base.is_level = true;
      base.grows = normal[k] > 0;
      base.axis = k;
      base.level = static_cast<double>(base.grows ? -plane.d : plane.d);
    }
    return;
  }
  if (signs_.error(polygon.operand) > 0) return;
  const auto &a = job_.rounded(base.corners[0]), &b = job_.rounded(base.corners[1]),
             &c = job_.rounded(base.corners[2]);
  for (size_t k = 0; k < 3; ++k) {
    if (a[k] != b[k] || a[k] != c[k]) continue;
    const size_t i = (k + 1) % 3, j = (k + 2) % 3;
    const auto whole = [](double v) { return static_cast<Int128>(static_cast<int64_t>(v)); };
    const Int128 turn =
        whole(b[i] - a[i]) * whole(c[j] - a[j]) - whole(b[j] - a[j]) * whole(c[i] - a[i]);
    base.is_level = turn != 0;
    base.grows = turn > 0;
    base.axis = k;
    base.level = a[k];
    return;
  }
}

/// The same where coordinates are whole numbers: of results all but what was cut is on the grid,
/// and leaves of one frame are in that.
int PairTest::orient_whole(const std::array<uint32_t, 4>& vertices, uint32_t operand,
                           uint32_t other) {
  std::array<VertexSigns::Position, 4> at;
  if (job_.are_in_one_frame(operand, other)) {
    for (size_t i = 0; i < 4; ++i) {
      const bool is_own = vertices[i] - job_.vertex_start(operand) <
                          job_.vertex_start(operand + 1) - job_.vertex_start(operand);
      const IVec3 p = job_.frame_point(is_own ? operand : other, vertices[i]);
      for (size_t k = 0; k < 3; ++k) at[i][k] = static_cast<double>(p[k]);
    }
    const int sign = signs_.orient(at[0], at[1], at[2], at[3], 0);
    return sign != kUnsure && job_.is_mirrored(operand) ? -sign : sign;
  }
  for (size_t i = 0; i < 4; ++i) {
    if (!job_.vertex_name(vertices[i]).is_on_grid) return kUnsure;
    at[i] = job_.rounded(vertices[i]);
  }
  return signs_.orient(at[0], at[1], at[2], at[3], 0);
}

/// The sides of p's corners on q's plane. +1 or -1 when all are strictly on that side, 0 when not,
/// or kUnsure.
int PairTest::corner_sides(uint32_t p, uint32_t q, std::vector<int8_t>& sides) {
  const JobPolygon &own = job_.polygons()[p], &other = job_.polygons()[q];
  const Base& known = base_of(q);
  const double error = std::max(signs_.error(own.operand), signs_.error(other.operand));
  sides.resize(own.count);
  if (own.count == 3 && !known.is_level && !planes_only_) {
    // Nearly all are of this kind, and told at once.
    const uint64_t filtered = signs_.filtered;
    const uint32_t* const corners = job_.corners(own).data();
    const int a = signs_.filter(known.signs, job_.rounded(corners[0]), error),
              b = signs_.filter(known.signs, job_.rounded(corners[1]), error),
              c = signs_.filter(known.signs, job_.rounded(corners[2]), error);
    if (a != 0 && b != 0 && c != 0) {
      sides[0] = static_cast<int8_t>(a), sides[1] = static_cast<int8_t>(b);
      sides[2] = static_cast<int8_t>(c);
      return a == b && b == c ? a : 0;
    }
    signs_.filtered = filtered;  // they are counted below
  }
  if (known.is_level && signs_.error(own.operand) == 0) return level_sides(own, known, sides);
  const Base base = known;  // what is written to `sides` might be it
  bool any[3] = {};         // behind, on and in front of the plane
  std::span<const VertexSigns::Box> blocks;
  if (own.count >= CornerBlocks::kWorthIt && !base.is_level && !planes_only_) {
    blocks = blocks_.of(p);
  }
  const auto corners = job_.corners(own);
  for (uint32_t i = 0; i < own.count; ++i) {
    if (!blocks.empty() && i % CornerBlocks::kEach == 0) {
      const int all = signs_.filter(base.signs, blocks[i / CornerBlocks::kEach], error);
      if (all != 0) {
        const uint32_t count = std::min(CornerBlocks::kEach, own.count - i);
        std::fill_n(sides.data() + i, count, static_cast<int8_t>(all));
        any[all + 1] = true;
        i += count - 1;
        continue;
      }
    }
    const int s = corner_side(own, other, base, corners[i], error);
    if (s == kUnsure) return kUnsure;
    sides[i] = static_cast<int8_t>(s);
    any[s + 1] = true;
  }
  return any[1] || any[0] == any[2] ? 0 : any[2] ? 1 : -1;
}

/// Whether a vertex of another operand equals a corner. REQUIRES: numbers.
bool PairTest::is_corner_of(uint32_t vertex, const JobPolygon& polygon) const {
  const auto corners = job_.corners(polygon);
  return std::any_of(corners.begin(), corners.end(),
                     [&](uint32_t corner) { return are_equal(vertex, corner); });
}

/// That of one corner. kUnsure only without planes.
int PairTest::corner_side(const JobPolygon& own, const JobPolygon& other, const Base& base,
                          uint32_t vertex, double error) {
  if (!number_of_.empty() && is_corner_of(vertex, other)) return 0;
  int s = kUnsure;
  if (base.is_level) {
    // What is rounded keeps the order, but for ties.
    const double above = job_.rounded(vertex)[base.axis] - base.level;
    if (above != 0) s = (above > 0) == base.grows ? 1 : -1;
    ++signs_.filtered;
  } else if (!planes_only_) {
    s = signs_.filter(base.signs, job_.rounded(vertex), error);
    if (s == 0) {
      s = orient({base.corners[0], base.corners[1], base.corners[2], vertex}, own.operand,
                 other.operand, error);
    }
  }
  if (s != kUnsure || !planes_) return s;
  s = planes_->side_of_vertex(other.support.index(), vertex);
  return other.support.flipped() ? -s : s;
}

/// The same of corners on the grid and a plane across an axis: whole numbers are not rounded.
int PairTest::level_sides(const JobPolygon& own, const Base& base, std::vector<int8_t>& sides) {
  const uint32_t* const corners = job_.corners(own).data();
  const std::array<double, 3>* const at = &job_.rounded(0);
  int8_t* const out = sides.data();
  const size_t axis = base.axis;
  const double level = base.level;
  const int way = base.grows ? 1 : -1;
  int least = 1, most = -1;
  for (uint32_t i = 0; i < own.count; ++i) {
    const double above = at[corners[i]][axis] - level;
    const int s = above > 0 ? way : above < 0 ? -way : 0;
    out[i] = static_cast<int8_t>(s);
    least = std::min(least, s), most = std::max(most, s);
  }
  signs_.filtered += own.count;
  return least == most ? least : 0;
}

/// False when all corners lie in the plane. A corner in the plane counts as the far side of those
/// that do not.
constexpr bool PairTest::walk(std::span<const int8_t> sides, Passage& passage) {
  int8_t front = 0, back = 0, zero = 0;
  for (const int8_t s : sides) front |= s > 0, back |= s < 0, zero |= s == 0;
  passage.front = front != 0, passage.back = back != 0, passage.zero = zero != 0;
  if (!passage.front && !passage.back) return false;
  const int8_t lowest = passage.front ? 1 : 0;  // of those in front
  const auto count = static_cast<uint32_t>(sides.size());
  bool is_front = sides[0] >= lowest;
  constexpr uint32_t kAtOnce = 8;
  for (uint32_t i = 0; i < count; ++i) {
    // Where many are equal, nothing falls or rises.
    while (i + kAtOnce < count && __builtin_memcmp(&sides[i], &sides[i + 1], kAtOnce) == 0) {
      i += kAtOnce;
    }
    const bool is_next = sides[i + 1 < count ? i + 1 : 0] >= lowest;
    passage.falls = is_front && !is_next ? i : passage.falls;
    passage.rises = !is_front && is_next ? i : passage.rises;
    is_front = is_next;
  }
  return true;
}

bool PairTest::find_passage(const std::vector<int8_t>& sides, Passage& passage) {
  if (sides.size() != 3) return walk(sides, passage);
  // Nearly all are triangles, of which there are so few kinds.
  static constexpr auto kOfTriangles = [] {
    std::array<Passage, 27> all{};
    for (int kind = 0; kind < 27; ++kind) {
      const std::array<int8_t, 3> of_kind{static_cast<int8_t>(kind / 9 - 1),
                                          static_cast<int8_t>(kind / 3 % 3 - 1),
                                          static_cast<int8_t>(kind % 3 - 1)};
      walk(of_kind, all[static_cast<size_t>(kind)]);
    }
    return all;
  }();
  passage = kOfTriangles[static_cast<size_t>(9 * sides[0] + 3 * sides[1] + sides[2] + 13)];
  return passage.front || passage.back;
}

int PairTest::inside(uint32_t p, uint32_t i, bool falls, uint32_t q, uint32_t j) {
  const JobPolygon &own = job_.polygons()[p], &other = job_.polygons()[q];
  const auto of_p = job_.corners(own), of_q = job_.corners(other);
  const uint32_t i_next = i + 1 < own.count ? i + 1 : 0, j_next = j + 1 < other.count ? j + 1 : 0;
  const double error = std::max(signs_.error(own.operand), signs_.error(other.operand));
  if (!number_of_.empty()) {
    // Edges that have an end in common are in one plane.
    for (const uint32_t end : {of_q[j], of_q[j_next]}) {
      if (are_equal(end, of_p[i]) || are_equal(end, of_p[i_next])) return 0;
    }
  }
  const int s =
      orient({of_q[j], of_q[j_next], of_p[i], of_p[i_next]}, own.operand, other.operand, error);
  if (s != kUnsure) return falls ? -s : s;
  if (!planes_) return kUnsure;
  const uint32_t edge = job_.edge_planes(other)[j];
  const uint32_t x =
      planes_->add_point({own.support.index(), job_.edge_planes(own)[i], other.support.index()});
  for (const uint32_t v : of_q) {
    const int inner = planes_->side_of_vertex(edge, v);
    if (inner != 0) return planes_->side(edge, x) * inner;
  }
  assert(false);
  return 0;
}

Meeting PairTest::run(uint32_t p, uint32_t q, CellGeometry* planes, Contact& contact) {
  planes_ = planes;
  // Few corners tell as well as many that polygons are apart.
  const bool p_first = job_.polygons()[p].count <= job_.polygons()[q].count;
  int p_side = 0, q_side = 0;
  for (const bool of_p : {p_first, !p_first}) {
    const int side =
        of_p ? p_side = corner_sides(p, q, sides_p_) : q_side = corner_sides(q, p, sides_q_);
    if (side == 1 || side == -1) return Meeting::kApart;
  }
  if (p_side == kUnsure || q_side == kUnsure) return Meeting::kUndecided;
  contact.p = p;
  contact.q = q;
  Passage of_p, of_q;
  contact.is_coplanar = !find_passage(sides_p_, of_p) || !find_passage(sides_q_, of_q);
  contact.is_plain = false;
  if (contact.is_coplanar) return flat_meeting(contact);
  // p from rises to falls, q from falls to rises.
  const int upper_reaches = inside(p, of_p.falls, true, q, of_q.falls);
  if (upper_reaches == kUnsure) return Meeting::kUndecided;
  if (upper_reaches < 0) return Meeting::kApart;
  const int lower_reaches = inside(p, of_p.rises, false, q, of_q.rises);
  if (lower_reaches == kUnsure) return Meeting::kUndecided;
  if (lower_reaches < 0) return Meeting::kApart;
  const int lower_on_p = inside(p, of_p.rises, false, q, of_q.falls);
  const int upper_on_p = inside(p, of_p.falls, true, q, of_q.rises);
  if (lower_on_p == kUnsure || upper_on_p == kUnsure) return Meeting::kUndecided;
  contact.is_plain = !of_p.zero && !of_q.zero && upper_reaches != 0 && lower_reaches != 0 &&
                     lower_on_p != 0 && upper_on_p != 0;
  contact.p_front = of_p.front, contact.p_back = of_p.back;
  contact.q_front = of_q.front, contact.q_back = of_q.back;
  contact.lower = lower_on_p >= 0 ? end_of(p, of_p.rises, true) : end_of(q, of_q.falls, false);
  contact.upper = upper_on_p >= 0 ? end_of(p, of_p.falls, true) : end_of(q, of_q.rises, false);
  return Meeting::kContact;
}

Meeting PairTest::flat_meeting(const Contact& contact) {
  // Of others there are not so many in one plane that it would pay.
  const auto is_grid_triangle = [&](uint32_t polygon) {
    const JobPolygon& p = job_.polygons()[polygon];
    return p.count == 3 && signs_.error(p.operand) == 0;
  };
  flat_ = {};
  if (!planes_only_ && is_grid_triangle(contact.p) && is_grid_triangle(contact.q)) {
    flat_ = flat_pair(job_, contact.p, contact.q);
  }
  switch (flat_.meeting) {
    case FlatMeeting::kApart:
      return Meeting::kApart;
    case FlatMeeting::kCorner:
      return Meeting::kFlatCorner;
    case FlatMeeting::kOther:
      break;
  }
  return Meeting::kContact;
}

Contact::End PairTest::end_of(uint32_t polygon, uint32_t edge, bool on_p) const {
  const std::vector<int8_t>& sides = on_p ? sides_p_ : sides_q_;
  const auto corners = job_.corners(job_.polygons()[polygon]);
  const uint32_t next = edge + 1 < corners.size() ? edge + 1 : 0;
  const uint32_t vertex = sides[edge] == 0   ? corners[edge]
                          : sides[next] == 0 ? corners[next]
                                             : kNone;
  return {on_p, edge, vertex};
}

void PairTest::add_touching_vertices(const Contact& contact,
                                     std::vector<uint32_t>& vertices) const {
  if (contact.is_coplanar && flat_.meeting == FlatMeeting::kCorner) {
    vertices.insert(vertices.end(), {flat_.p_corner, flat_.q_corner});
    return;
  }
  const auto add = [&](uint32_t polygon, const std::vector<int8_t>& sides) {
    const auto corners = job_.corners(job_.polygons()[polygon]);
    for (size_t i = 0; i < corners.size(); ++i) {
      if (sides[i] == 0) vertices.push_back(corners[i]);
    }
  };
  add(contact.p, sides_p_);
  add(contact.q, sides_q_);
}

}  // namespace csgrun

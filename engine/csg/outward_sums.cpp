#include "engine/csg/outward_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/csg/convex_hull.h"
#include "engine/csg/wide_cross.h"

namespace csgrun {
namespace {

/// Of products of unit normals and coordinates relative to the largest: far above their error. More
/// is summed than needed where it is extreme only up to this; of what there must be one that is
/// truly extreme, integers tell which.
constexpr double kSlack = 0x1p-40;
constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

/// What of a convex solid is extreme along the normal of a face, at least up to kSlack.
struct Extreme {
  std::vector<uint32_t> corners;
  bool is_flat = true;  ///< they are all extreme alike, exactly; else they must all be summed with
  IVec3 middle{};       ///< an extreme point: one of the corners, or between them in their plane
};

/// A convex solid as seen from a point inside of it, about one in size.
class ConvexBody {
 public:
  /// False when there is no grid point inside.
  bool build(const std::vector<IVec3>& points);

  [[nodiscard]] const IVec3& centre() const { return centre_; }
  [[nodiscard]] size_t count() const { return corners_.size(); }
  [[nodiscard]] const IVec3& corner(uint32_t c) const { return hull_.vertices[c]; }
  /// What is extreme along a unit vector, which is that of an exact one.
  [[nodiscard]] Extreme extreme(const glm::dvec3& direction, const Vec128& exact) const;
  /// Marks those of them that are farthest along another one.
  void mark_farthest(const Extreme& extreme, const glm::dvec3& direction,
                     std::vector<uint8_t>& marks) const;
  /// Marks those that are extreme along any vector between two unit vectors, which are not
  /// opposite; not all that are extreme along these two.
  void mark_between(const glm::dvec3& a, const glm::dvec3& b, std::vector<uint8_t>& marks) const;
  /// Marks those that are extreme along any vector that makes no acute angle with any of these.
  void mark_away_from(const std::vector<glm::dvec3>& directions, std::vector<uint8_t>& marks) const;

 private:
  /// The sign of how far a point is in front of a face.
  [[nodiscard]] int height(uint32_t face, const IVec3& point) const {
    const uint32_t* c = hull_.corners.data() + hull_.face_starts[face];
    const auto& at = hull_.vertices;  // no three corners of a hull's face are in line
    return side(at[c[0]], at[c[1]], at[c[2]], point);
  }
  void find_normals();

  LeafGeometry hull_;
  IVec3 centre_{};
  std::vector<glm::dvec3> corners_;  // of the hull, relative to the centre, scaled
  std::vector<glm::dvec3> face_normals_;
  std::vector<std::vector<uint32_t>> face_at_;  // the faces around a corner, in order
};

bool ConvexBody::build(const std::vector<IVec3>& points) {
  hull_ = convex_hull(points);
  if (hull_.vertices.empty()) return false;
  for (int i = 0; i < 3; ++i) {
    Int128 sum = 0;
    for (const IVec3& v : hull_.vertices) sum += v[i];
    centre_[i] = static_cast<int64_t>(sum / static_cast<Int128>(hull_.vertices.size()));
  }
  for (uint32_t f = 0; f < hull_.face_count(); ++f) {
    if (height(f, centre_) >= 0) return false;
  }
  double largest = 0;
  for (const IVec3& v : hull_.vertices) {
    glm::dvec3& c = corners_.emplace_back();
    for (int i = 0; i < 3; ++i) {
      c[i] = static_cast<double>(v[i] - centre_[i]);
      largest = std::max(largest, std::fabs(c[i]));
    }
  }
  for (glm::dvec3& c : corners_) c /= largest;
  find_normals();
  return true;
}

void ConvexBody::find_normals() {
  std::vector<uint32_t> face_of(hull_.corners.size()), first(count(), kNone);
  face_normals_.resize(hull_.face_count());
  for (uint32_t f = 0; f < hull_.face_count(); ++f) {
    const uint32_t begin = hull_.face_starts[f], end = hull_.face_starts[f + 1];
    const auto at = [&](uint32_t c) { return hull_.vertices[hull_.corners[c]]; };
    Vec128 normal{};
    for (uint32_t c = begin; c < end; ++c) {
      face_of[c] = f;
      first[hull_.corners[c]] = c;
      if (c <= begin + 1) continue;
      const Vec128 part = cross(at(begin), at(c - 1), at(c));
      for (int i = 0; i < 3; ++i) normal[i] += part[i];
    }
    for (int i = 0; i < 3; ++i) face_normals_[f][i] = static_cast<double>(normal[i]);
    face_normals_[f] = glm::normalize(face_normals_[f]);
  }
  face_at_.resize(count());
  for (uint32_t v = 0; v < count(); ++v) {
    uint32_t c = first[v];
    do {
      const uint32_t f = face_of[c];
      face_at_[v].push_back(f);
      // The edge that comes to the corner, as its other face runs it: away from the corner.
      c = hull_.opposite[c == hull_.face_starts[f] ? hull_.face_starts[f + 1] - 1 : c - 1];
    } while (c != first[v]);
  }
}

Extreme ConvexBody::extreme(const glm::dvec3& direction, const Vec128& exact) const {
  double most = -HUGE_VAL;
  for (const glm::dvec3& c : corners_) most = std::max(most, glm::dot(direction, c));
  Extreme result;
  for (uint32_t i = 0; i < count(); ++i) {
    if (glm::dot(direction, corners_[i]) >= most - kSlack) result.corners.push_back(i);
  }
  // Differences of coordinates are at most 2^41, so this is below 2^126.
  const auto exact_height = [&](const IVec3& point) {
    Int128 sum = 0;
    for (int k = 0; k < 3; ++k) sum += exact[k] * (point[k] - centre_[k]);
    return sum;
  };
  result.middle = corner(result.corners[0]);
  Int128 highest = exact_height(result.middle);
  for (const uint32_t c : result.corners) {
    const Int128 here = exact_height(corner(c));
    result.is_flat &= here == highest;
    if (here > highest) highest = here, result.middle = corner(c);
  }
  if (!result.is_flat || result.corners.size() < 3) return result;
  IVec3 middle;
  for (int k = 0; k < 3; ++k) {
    Int128 sum = 0;
    for (const uint32_t c : result.corners) sum += corner(c)[k];
    middle[k] = static_cast<int64_t>(sum / static_cast<Int128>(result.corners.size()));
  }
  bool is_on_face = exact_height(middle) == highest;
  for (uint32_t f = 0; is_on_face && f < hull_.face_count(); ++f) {
    is_on_face = height(f, middle) <= 0;
  }
  if (is_on_face) result.middle = middle;
  return result;
}

void ConvexBody::mark_farthest(const Extreme& extreme, const glm::dvec3& direction,
                               std::vector<uint8_t>& marks) const {
  double most = -HUGE_VAL;
  for (const uint32_t c : extreme.corners) most = std::max(most, glm::dot(direction, corners_[c]));
  for (const uint32_t c : extreme.corners) {
    if (glm::dot(direction, corners_[c]) >= most - kSlack) marks[c] = 1;
  }
}

void ConvexBody::mark_between(const glm::dvec3& a, const glm::dvec3& b,
                              std::vector<uint8_t>& marks) const {
  // What is extreme between two directions is on the upper right of a plane with one axis along
  // each: a chain from what is farthest along b to what is farthest along a.
  struct Shadow {
    double x, y;
    uint32_t corner;
  };
  std::vector<Shadow> shadows;
  for (uint32_t i = 0; i < count(); ++i) {
    shadows.push_back({glm::dot(a, corners_[i]), glm::dot(b, corners_[i]), i});
  }
  std::sort(shadows.begin(), shadows.end(), [](const Shadow& p, const Shadow& q) {
    return p.x != q.x ? p.x > q.x : p.y != q.y ? p.y > q.y : p.corner < q.corner;
  });
  std::vector<Shadow> chain;
  for (const Shadow& s : shadows) {
    if (!chain.empty() && s.y <= chain.back().y) continue;
    while (chain.size() >= 2) {
      const Shadow &p = chain[chain.size() - 2], &q = chain.back();
      if ((q.x - p.x) * (s.y - p.y) - (q.y - p.y) * (s.x - p.x) > 0) break;
      chain.pop_back();
    }
    chain.push_back(s);
  }
  for (const Shadow& s : shadows) {
    bool is_near = false;
    for (size_t k = 0; k < chain.size() && !is_near; ++k) {
      const Shadow& p = chain[k];
      is_near = std::fabs(s.x - p.x) <= kSlack && std::fabs(s.y - p.y) <= kSlack;
      if (is_near || k + 1 == chain.size()) continue;
      const Shadow& q = chain[k + 1];  // farther along y, and less far along x
      const double u = q.y - p.y, v = p.x - q.x;
      is_near =
          s.x <= p.x && s.y <= q.y && u * (s.x - p.x) + v * (s.y - p.y) >= -kSlack * std::max(u, v);
    }
    if (is_near) marks[s.corner] = 1;
  }
}

void ConvexBody::mark_away_from(const std::vector<glm::dvec3>& directions,
                                std::vector<uint8_t>& marks) const {
  std::vector<glm::dvec3> cone, rest;
  for (size_t v = 0; v < count(); ++v) {
    if (marks[v] != 0) continue;
    cone.clear();
    for (const uint32_t f : face_at_[v]) cone.push_back(face_normals_[f]);
    for (const glm::dvec3& d : directions) {
      rest.clear();
      for (size_t i = 0; i < cone.size(); ++i) {
        const glm::dvec3 &p = cone[i], &q = cone[i + 1 < cone.size() ? i + 1 : 0];
        const double at_p = glm::dot(p, d), at_q = glm::dot(q, d);
        if (at_p <= kSlack) rest.push_back(p);
        if ((at_p <= kSlack) != (at_q <= kSlack)) {
          const glm::dvec3 between = p * std::fabs(at_q) + q * std::fabs(at_p);
          const double length = glm::length(between);
          if (length > 0) rest.push_back(between / length);
        }
      }
      cone.swap(rest);
      if (cone.empty()) break;
    }
    if (!cone.empty()) marks[v] = 1;
  }
}

class Outward {
 public:
  Outward(const GridSolid& a, const ConvexBody& body) : a_(a), body_(body) {}

  std::vector<std::vector<IVec3>> bodies() {
    list_rims();
    list_extremes();
    tasks_.resize(a_.patches.size());
    weight_.assign(a_.patches.size(), 0);
    for (const GridSolid::Rim& r : a_.rims) {
      if (r.is_convex) ++weight_[r.patch], ++weight_[r.other];
    }
    // One that is summed with all of the convex solid has what its edges need.
    for (uint32_t p = 0; p < a_.patches.size(); ++p) {
      if (!a_.patches[p].is_exact) weight_[p] = kNone;
    }
    for (uint32_t r = 0; r < a_.rims.size(); ++r) {
      const GridSolid::Rim& rim = a_.rims[r];
      tasks_[rim.patch].sides.push_back(r);
      tasks_[rim.other].sides.push_back(r);
      // To the patch that has the most: few patches have many then.
      if (rim.is_convex) tasks_[heavier(rim.patch, rim.other)].edges.push_back(r);
    }
    for (uint32_t v = 0; v < a_.points.size(); ++v) give_corner(v);
    std::vector<std::vector<IVec3>> result;
    for (uint32_t p = 0; p < a_.patches.size(); ++p) result.push_back(points_of(p));
    return result;
  }

 private:
  struct Tasks {                    ///< what a patch is there for
    std::vector<uint32_t> sides;    ///< its own edges
    std::vector<uint32_t> edges;    ///< convex edges: all that is between their faces
    std::vector<uint32_t> corners;  ///< all that is away from these
    bool has_corner = false;        ///< that its face's extreme ones must all be summed with
  };

  void list_rims() {
    starts_.assign(a_.points.size() + 1, 0);
    for (const GridSolid::Rim& r : a_.rims) ++starts_[r.from + 1], ++starts_[r.to + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    rim_at_.resize(starts_.back());
    std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (uint32_t r = 0; r < a_.rims.size(); ++r) {
      rim_at_[next[a_.rims[r].from]++] = r;
      rim_at_[next[a_.rims[r].to]++] = r;
    }
  }

  void list_extremes() {
    std::vector<bool> is_known;
    for (uint32_t p = 0; p < a_.patches.size(); ++p) {
      const GridSolid::Patch& patch = a_.patches[p];
      if (patch.face >= extreme_.size()) {
        extreme_.resize(patch.face + size_t{1});
        is_known.resize(patch.face + size_t{1});
      }
      Extreme& extreme = extreme_[patch.face];
      // One with rounded corners is summed with everything; its normal is not the face's.
      if (patch.is_exact ? !is_known[patch.face] : extreme.corners.empty()) {
        extreme = body_.extreme(patch.normal, exact_normal(patch));
        is_known[patch.face] = patch.is_exact;
      }
    }
  }

  /// Along the normal of a patch, exactly; null if it is rounded to nothing.
  [[nodiscard]] Vec128 exact_normal(const GridSolid::Patch& patch) const {
    Vec128 normal{};
    for (size_t c = 2; c < patch.corners.size() && is_zero(normal); ++c) {
      normal = cross(a_.points[patch.corners[0]], a_.points[patch.corners[c - 1]],
                     a_.points[patch.corners[c]]);
    }
    return normal;
  }

  /// Corners with three convex edges or more go to one of the patches around, and to one of each
  /// face that has a convex corner there.
  void give_corner(uint32_t v) {
    uint32_t convex = 0, patch = kNone;
    beside_.clear();
    for (const uint32_t r : rims_at(v)) {
      const GridSolid::Rim& rim = a_.rims[r];
      convex += rim.is_convex ? 1 : 0;
      const uint32_t here = heavier(rim.patch, rim.other);
      patch = patch == kNone ? here : heavier(patch, here);
      const glm::dvec3 away = direction(r, v);
      // The face on the left of an edge that leaves the corner starts there.
      const bool leaves = rim.from == v;
      beside_.push_back({a_.patches[rim.patch].face, leaves, rim.patch, away});
      beside_.push_back({a_.patches[rim.other].face, !leaves, rim.other, away});
    }
    if (convex >= 3) tasks_[patch].corners.push_back(v);
    std::sort(beside_.begin(), beside_.end(), [](const Beside& p, const Beside& q) {
      return std::tie(p.face, p.starts, p.patch) < std::tie(q.face, q.starts, q.patch);
    });
    for (size_t i = 0, end = 0; i < beside_.size(); i = end) {
      while (end < beside_.size() && beside_[end].face == beside_[i].face) ++end;
      if (extreme_[beside_[i].face].corners.size() < 2) continue;
      // One edge that comes and one that leaves; else there is more to the corner.
      const Beside &comes = beside_[i], &leaves = beside_[end - 1];
      const glm::dvec3& normal = a_.patches[comes.patch].normal;
      const bool is_reflex = end - i == 2 && !comes.starts && leaves.starts &&
                             glm::dot(glm::cross(leaves.away, comes.away), normal) < -kSlack;
      if (!is_reflex) tasks_[comes.patch].has_corner = true;
    }
  }

  std::vector<IVec3> points_of(uint32_t p) {
    const GridSolid::Patch& patch = a_.patches[p];
    const Tasks& tasks = tasks_[p];
    const Extreme& extreme = extreme_[patch.face];
    marks_.assign(body_.count(), patch.is_exact ? 0 : 1);
    if (patch.is_exact) {
      if (tasks.has_corner || !extreme.is_flat) {
        for (const uint32_t c : extreme.corners) marks_[c] = 1;
      }
      for (const uint32_t r : tasks.sides) {
        const GridSolid::Rim& rim = a_.rims[r];
        const glm::dvec3 along = direction(r, rim.patch == p ? rim.from : rim.to);
        body_.mark_farthest(extreme, glm::cross(along, patch.normal), marks_);
      }
      for (const uint32_t r : tasks.edges) {
        const GridSolid::Rim& rim = a_.rims[r];
        body_.mark_between(a_.patches[rim.patch].normal, a_.patches[rim.other].normal, marks_);
      }
      for (const uint32_t v : tasks.corners) {
        away_.clear();
        for (const uint32_t r : rims_at(v)) away_.push_back(direction(r, v));
        body_.mark_away_from(away_, marks_);
      }
    }
    std::vector<IVec3> points;
    for (const uint32_t c : patch.corners) {
      const IVec3& at = a_.points[c];
      const auto add = [&](const IVec3& q) {
        points.push_back({at[0] + q[0], at[1] + q[1], at[2] + q[2]});
      };
      add(body_.centre());
      add(extreme.middle);
      for (uint32_t i = 0; i < marks_.size(); ++i) {
        if (marks_[i] != 0) add(body_.corner(i));
      }
    }
    return points;
  }

  [[nodiscard]] uint32_t heavier(uint32_t p, uint32_t q) const {
    if (weight_[p] != weight_[q]) return weight_[p] > weight_[q] ? p : q;
    return std::min(p, q);
  }
  [[nodiscard]] std::span<const uint32_t> rims_at(uint32_t v) const {
    return {rim_at_.data() + starts_[v], rim_at_.data() + starts_[v + 1]};
  }
  /// Of an edge, away from one of its ends.
  [[nodiscard]] glm::dvec3 direction(uint32_t rim, uint32_t from) const {
    const IVec3& p = a_.points[from];
    const IVec3& q = a_.points[a_.rims[rim].from == from ? a_.rims[rim].to : a_.rims[rim].from];
    glm::dvec3 d;
    for (int i = 0; i < 3; ++i) d[i] = static_cast<double>(q[i] - p[i]);
    return glm::normalize(d);
  }

  struct Beside {  ///< a face beside an edge at the corner at hand
    uint32_t face;
    bool starts;  ///< as the face runs it, the edge starts at the corner
    uint32_t patch;
    glm::dvec3 away;
  };

  const GridSolid& a_;
  const ConvexBody& body_;
  std::vector<uint32_t> starts_, rim_at_;  // edges by the points at their ends
  std::vector<Extreme> extreme_;           // by face
  std::vector<uint32_t> weight_;           // by patch: convex edges beside it
  std::vector<Tasks> tasks_;
  std::vector<Beside> beside_;
  std::vector<uint8_t> marks_;
  std::vector<glm::dvec3> away_;
};

}  // namespace

bool outward_sums(const GridSolid& a, const std::vector<IVec3>& convex, OutwardSums& result) {
  ConvexBody body;
  if (!body.build(convex)) return false;
  result.centre = body.centre();
  result.bodies = Outward(a, body).bodies();
  return true;
}

}  // namespace csgrun

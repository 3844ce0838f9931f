// sweep: rings of the outline where the path's pieces meet, and walls between them.
//
// At a corner of the path the ring lies in the plane that halves the angle. To turn the frame by
// the least rotation from one direction to the next and to reflect it at that plane (and turn it
// back over) is the same, so what arrives along one piece leaves along the next: walls are prisms.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include <csgrun/primitives/sweep.h>
#include <csgrun/primitives/trig.h>

#include "primitives/base/text.h"
#include "primitives/shape2d/extrude_facets.h"
#include "primitives/shape2d/noise_corners.h"
#include "primitives/shape2d/profile.h"
#include "primitives/shape2d/sweep_ends.h"
#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

constexpr const char* kSweep = "sweep";

double length_of(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

/// From point i of the path to the next one.
glm::dvec3 direction_of(const std::vector<glm::dvec3>& path, size_t i) {
  const glm::dvec3 way = path[(i + 1) % path.size()] - path[i];
  return way / length_of(way);
}

/// What linear_extrude is asked for with such a twist.
LinearExtrudeOptions twisted_extrusion(const SweepOptions& o) {
  LinearExtrudeOptions extrusion;
  extrusion.twist = -o.twist;
  extrusion.scale = o.scale;
  extrusion.facets = o.facets;
  return extrusion;
}

/// Whether walls over straight edges are bent, by more than the path.
bool bends_walls(const SweepOptions& o) { return o.twist != 0 || o.scale.x != o.scale.y; }

double farthest_from_path(const Shape2D& shape) {
  double square = 0;
  for (const Shape2D::Loop& loop : shape.loops()) {
    for (const glm::dvec2& p : loop) square = std::max(square, glm::dot(p, p));
  }
  return std::sqrt(square);
}

/// How a ring leans: so much of the way to the plane that halves the angle of a bend near it.
struct Lean {
  glm::dvec3 half{0};  ///< across that plane
  double part = 0;
};

struct Way {
  std::vector<glm::dvec3> points;
  std::vector<Lean> leans;  ///< of each point; none for a path as it is given
};

/// The path with more points, so that what bends walls does so in steps as small as
/// linear_extrude's. The ring at a bend lies aslant, and rings near it would cross it: they lean
/// the more the nearer they are, from twice as far on as it reaches along the piece. So what is
/// ahead of a point at one is ahead of it at all. Without room for that there are none.
Way divided(const std::vector<glm::dvec3>& path, const Shape2D& shape, const SweepOptions& o) {
  constexpr double kReaches = 2, kLeastReaches = 1.25;
  const size_t n = path.size(), pieces = o.closed ? n : n - 1;
  double total = 0;
  for (size_t i = 0; i < pieces; ++i) total += length_of(path[(i + 1) % n] - path[i]);
  const double slices = slices_of(shape, twisted_extrusion(o), total);
  const double farthest = farthest_from_path(shape) * std::max({1.0, o.scale.x, o.scale.y});
  const auto half_at = [&](size_t i) {
    if (!o.closed && (i == 0 || i + 1 == n)) return glm::dvec3(0);
    return direction_of(path, (i + n - 1) % n) + direction_of(path, i);
  };
  Way result;
  for (size_t i = 0; i < pieces; ++i) {
    const size_t next = (i + 1) % n;
    const glm::dvec3 a = path[i], way = path[next] - a;
    const double length = length_of(way);
    // A turn of whole steps must not get one more by rounding.
    constexpr double kNoise = 1e-9;
    const double steps = slices * length / total;
    const double parts = std::clamp(std::ceil(steps - kNoise), 1.0, kMostPoints);
    // Of both ends: how far the ring there reaches along this piece, and what leans towards it.
    const std::array<glm::dvec3, 2> half{half_at(i), half_at(next)};
    std::array<double, 2> reach{0, 0};
    for (int end = 0; end < 2; ++end) {
      const double along = std::fabs(glm::dot(half[end], way)) / length;
      if (along > 0) reach[end] = farthest * length_of(glm::cross(half[end], way)) / length / along;
    }
    const double reaches = std::min(kReaches, length / (reach[0] + reach[1]));
    result.points.push_back(a);
    result.leans.emplace_back();
    if (reaches < kLeastReaches) continue;
    for (double k = 1; k < parts && static_cast<double>(result.points.size()) <= kMostPoints; ++k) {
      result.points.push_back(a + way * (k / parts));
      Lean& lean = result.leans.emplace_back();
      for (int end = 0; end < 2; ++end) {
        const double far = length * (end == 0 ? k : parts - k) / parts;
        if (far < reaches * reach[end]) lean = {half[end], 1 - far / (reaches * reach[end])};
      }
    }
  }
  if (!o.closed) {
    result.points.push_back(path.back());
    result.leans.emplace_back();
  }
  return result;
}

/// The loops of the shape, where walls are bent with points on long edges, as linear_extrude has
/// them: walls over straight edges bulge.
std::vector<Shape2D::Loop> divided_loops(const Shape2D& shape, const SweepOptions& o,
                                         size_t pieces) {
  if (!bends_walls(o)) return o.upright ? loops_without_noise(shape) : shape.loops();
  return split_outlines(shape, twisted_extrusion(o), static_cast<int>(pieces));
}

/// Directions across a piece of the path: x of the outline, y, and the way forward.
struct Frame {
  glm::dvec3 x, y, forward;
};

/// Turned with the path from one direction to the next.
Frame carried(const Frame& frame, const glm::dvec3& forward) {
  // Two reflections are a rotation: at the plane across the path, then at the halving plane.
  const glm::dvec3 half = frame.forward + forward;
  const double square = glm::dot(half, half);
  const auto move = [&](const glm::dvec3& v) {
    return v - half * (2 * glm::dot(v, half) / square);
  };
  Frame next{move(frame.x), move(frame.y), forward};
  // Rounding adds up along a path of many points: y stays across, x across both.
  next.y -= forward * glm::dot(next.y, forward);
  next.y /= length_of(next.y);
  next.x = glm::cross(next.y, forward);
  return next;
}

/// Where the outline's Y points to at the start of a path that begins in this direction.
glm::dvec3 up_at_start(const glm::dvec3& forward, const std::optional<glm::dvec3>& up) {
  const bool along_z = forward.x == 0 && forward.y == 0;
  return up ? *up : along_z ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
}

/// Y as far up as it can be across the path; nothing where up is along it.
std::optional<Frame> upright_frame(const glm::dvec3& forward, const glm::dvec3& up) {
  const glm::dvec3 y = up - forward * glm::dot(up, forward);
  const double length = length_of(y);
  constexpr double kLeast = 1e-9;  // of a direction that is given with sixteen digits
  if (!(length > kLeast)) return std::nullopt;
  return Frame{glm::cross(y / length, forward), y / length, forward};
}

/// The angle from frame a to b about their common direction, counter-clockwise seen against it.
double angle_between(const Frame& a, const Frame& b) {
  return atan2_deg(glm::dot(b.x, a.y), glm::dot(b.x, a.x));
}

class Sweeper {
 public:
  /// `loops` are those of the shape, perhaps with more points on edges. `rolls`: what each frame
  /// is to be turned by, in degrees, to stand upright.
  Sweeper(const Shape2D& shape, std::vector<Shape2D::Loop> loops, const SweepOptions& options,
          Way way, std::vector<Frame> frames, std::vector<double> rolls)
      : options_(options),
        path_(std::move(way.points)),
        leans_(std::move(way.leans)),
        frames_(std::move(frames)),
        rolls_(std::move(rolls)),
        loops_(std::move(loops)),
        profile_(make_profile(shape, loops_)) {}

  PolygonMesh build() {
    mesh_.kind = kSweep;
    walk();
    for (size_t i = 0; i < path_.size(); ++i) add_ring(i);
    const size_t pieces = frames_.size();
    uint32_t surface = 0;
    for (size_t l = 0; l < profile_.loops.size(); ++l) {
      uint32_t chains = 0;
      const std::vector<uint32_t> chain = smooth_chains(loops_[l], chains);
      const std::vector<uint32_t>& loop = profile_.loops[l];
      for (size_t k = 0; k < loop.size(); ++k) {
        for (size_t j = 0; j < pieces; ++j) {
          add_side(j, loop[k], loop[(k + 1) % loop.size()], profile_.is_hole[l],
                   surface + 1 + chain[k] + chains * bend_[j]);
        }
      }
      surface += chains * (bend_.back() + 1);
    }
    if (!options_.closed) {
      add_cap(0, true);
      if (!ends_in_point()) add_cap(path_.size() - 1, false);
    }
    return std::move(mesh_);
  }

  /// Of the mesh that was built: what takes off what is beyond the ends that become planes, when
  /// these go on as in `beyond`, which has the points as they are.
  std::vector<CutEnd> cut_ends(std::span<const glm::dvec3> points,
                               std::vector<glm::dvec3>& beyond) const {
    std::vector<CutEnd> ends;
    for (const bool is_last : {false, true}) {
      if (options_.closed || (is_last && ends_in_point())) continue;
      const size_t own = is_last ? rings_.size() - 1 : 0, before = is_last ? own - 1 : 1;
      const glm::dvec3 forward = frames_[is_last ? frames_.size() - 1 : 0].forward;
      auto end = cut_end({points, rings_},
                         {is_last, path_[own], is_last ? forward : -forward, has_flat_walls()});
      if (!end) continue;
      for (size_t k = 0; k < rings_[own].size(); ++k) {
        const uint32_t corner = rings_[own][k];
        beyond[corner] = beyond_end(points[corner], points[rings_[before][k]], end->beyond);
      }
      end->tool.kind = kSweep;
      ends.push_back(*std::move(end));
    }
    return ends;
  }

 private:
  [[nodiscard]] bool ends_in_point() const { return options_.scale == glm::dvec2(0); }

  /// Whether no piece turns the outline or scales it.
  [[nodiscard]] bool has_flat_walls() const {
    constexpr double kNoise = 1e-9;  // degrees
    if (options_.twist != 0 || options_.scale != glm::dvec2(1)) return false;
    return std::all_of(rolls_.begin(), rolls_.end(), [&](double roll) {
      return std::fabs(std::remainder(roll - rolls_[0], 360)) < kNoise;
    });
  }

  void walk() {
    along_.push_back(0);
    for (size_t i = 0; i < frames_.size(); ++i)
      along_.push_back(along_.back() + length_of(path_[(i + 1) % path_.size()] - path_[i]));
    // Walls go on smoothly until the path turns sharply.
    const double least_cosine = cos_deg(kSmoothTurnDegrees);
    for (size_t i = 0; i < frames_.size(); ++i) {
      const bool smooth =
          i == 0 || glm::dot(frames_[i - 1].forward, frames_[i].forward) > least_cosine;
      bend_.push_back(i == 0 ? 0 : bend_.back() + (smooth ? 0 : 1));
    }
    if (!options_.closed) return;
    // Home again, the frame has turned: what is missing is added along the way.
    const Frame home = carried(frames_.back(), frames_[0].forward);
    correction_ = angle_between(home, frames_[0]);
  }

  void add_ring(size_t i) {
    const size_t n = path_.size();
    const bool ends = !options_.closed && (i == 0 || i + 1 == n);
    const size_t piece_before = i > 0 ? i - 1 : ends ? 0 : frames_.size() - 1;
    const size_t piece_after = ends ? piece_before : i;
    const Frame &before = frames_[piece_before], &after = frames_[piece_after];
    // The ring lies where the lines of the piece before meet the halving plane; the first of a
    // closed path is seen from the piece after it, from which the frames were carried on.
    const Frame& frame = i == 0 ? after : before;
    const glm::dvec3 half = before.forward + after.forward;
    const Lean lean = leans_.empty() ? Lean() : leans_[i];
    const double part = along_[i] / along_.back();
    double angle = (options_.twist + (options_.upright ? 0 : correction_)) * part;
    if (options_.upright) {
      // Halfway between what the two pieces ask for: the path's turn is in both frames already.
      const double from = rolls_[piece_before] - (i == 0 ? correction_ : 0);
      angle += from + std::remainder(rolls_[piece_after] - from, 360) / 2;
    }
    const double c = cos_deg(angle), s = sin_deg(angle);
    const glm::dvec2 scale = glm::dvec2(1) + (options_.scale - glm::dvec2(1)) * part;
    std::vector<uint32_t>& ring = rings_.emplace_back();
    if (ends_in_point() && i + 1 == n) {
      ring.assign(profile_.points.size(), static_cast<uint32_t>(mesh_.points.size()));
      mesh_.points.push_back(path_[i]);
      return;
    }
    for (const glm::dvec2& p : profile_.points) {
      const glm::dvec2 q = p * scale;
      const glm::dvec3 across = frame.x * (c * q.x - s * q.y) + frame.y * (s * q.x + c * q.y);
      double back = glm::dot(across, half) / glm::dot(frame.forward, half);
      if (lean.part > 0)
        back += lean.part * glm::dot(across, lean.half) / glm::dot(frame.forward, lean.half);
      ring.push_back(static_cast<uint32_t>(mesh_.points.size()));
      mesh_.points.push_back(path_[i] + across - frame.forward * back);
    }
  }

  void add_side(size_t piece, uint32_t p, uint32_t q, bool hole, uint32_t surface) {
    const std::vector<uint32_t>&ring = rings_[piece], &next = rings_[(piece + 1) % rings_.size()];
    const uint32_t a = ring[p], b = ring[q], c = next[q], d = next[p];
    if (c == d) {
      mesh_.add_face(std::array<uint32_t, 3>{a, b, c}, surface);
      return;
    }
    // Rounded quadrilaterals are planar only along the axes: triangles are what they say.
    const auto& points = mesh_.points;
    // Of two equal diagonals the one that the twist leans to, as linear_extrude has it. Without a
    // twist one that does not depend on which way the outline goes: a wall that two sweeps have in
    // common is cut alike.
    const auto is_before = [](const glm::dvec3& v, const glm::dvec3& w) {
      return std::tie(v.x, v.y, v.z) < std::tie(w.x, w.y, w.z);
    };
    const bool is_c_of_equal =
        options_.twist != 0 ? (options_.twist < 0) != hole : is_before(points[a], points[b]);
    const bool from_a =
        is_cut_from_first(points[a], points[b], points[c], points[d], is_c_of_equal);
    mesh_.add_face(std::array<uint32_t, 3>{a, b, from_a ? c : d}, surface);
    mesh_.add_face(std::array<uint32_t, 3>{c, d, from_a ? a : b}, surface);
  }

  void add_cap(size_t at, bool backwards) {
    for (const Shape2D::Region& region : profile_.regions) {
      std::vector<std::vector<uint32_t>> loops;
      auto add = [&](uint32_t l) {
        std::vector<uint32_t>& loop = loops.emplace_back();
        for (const uint32_t p : profile_.loops[l]) loop.push_back(rings_[at][p]);
        if (backwards) std::reverse(loop.begin(), loop.end());
      };
      add(region.outer);
      for (const uint32_t hole : region.holes) add(hole);
      add_face_with_holes(mesh_, loops);
    }
  }

  const SweepOptions& options_;
  std::vector<glm::dvec3> path_;
  std::vector<Lean> leans_;    // of the rings; none: all zero
  std::vector<Frame> frames_;  // of each piece
  std::vector<double> rolls_;  // likewise
  std::vector<Shape2D::Loop> loops_;
  Profile profile_;
  std::vector<double> along_;   // how far each point of the path lies from its start
  std::vector<uint32_t> bend_;  // per piece: how many sharp turns lie before it
  double correction_ = 0;
  std::vector<std::vector<uint32_t>> rings_;
  PolygonMesh mesh_;
};

std::optional<Error> check(const SweepOptions& o) {
  if (!std::isfinite(o.twist)) return not_finite(kSweep, "twist", o.twist);
  if (!std::isfinite(o.facets.fn)) return not_finite(kSweep, "fn", o.facets.fn);
  if (!std::isfinite(o.facets.fa)) return not_finite(kSweep, "fa", o.facets.fa);
  for (int i = 0; i < 2; ++i) {
    if (!std::isfinite(o.scale[i])) return not_finite(kSweep, "scale", o.scale[i]);
    if (o.scale[i] < 0 || (o.scale[i] == 0 && o.scale != glm::dvec2(0))) {
      return invalid_argument("sweep: scale must be positive, or 0 both ways, got " +
                              number_text(o.scale[i]));
    }
  }
  if (o.closed && o.twist != 360 * std::round(o.twist / 360)) {
    return invalid_argument("sweep: the twist of a closed path must be a multiple of 360, got " +
                            number_text(o.twist));
  }
  if (o.closed && o.scale != glm::dvec2(1)) {
    return invalid_argument("sweep: a closed path ends as it begins, without a scale");
  }
  for (size_t i = 0; i < o.path.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (std::isfinite(o.path[i][k])) continue;
      return invalid_argument("sweep: point " + std::to_string(i) +
                              " of the path must be finite, got " + number_text(o.path[i][k]));
    }
  }
  return std::nullopt;
}

/// A path that goes back on itself has no plane that halves the angle.
std::optional<Error> check_turns(const std::vector<glm::dvec3>& path, bool closed) {
  for (size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < path.size(); ++i) {
    const glm::dvec3 in = direction_of(path, (i + path.size() - 1) % path.size());
    // Next to the way back, at a cosine of -1, a mitre has no end.
    if (glm::dot(in, direction_of(path, i)) > -0.9999) continue;
    return invalid_argument("sweep: the path turns back at its point " + std::to_string(i));
  }
  return std::nullopt;
}

Result<Sweeper> make_sweeper(const Shape2D& shape, const SweepOptions& options) {
  if (shape.empty()) return invalid_argument("sweep: the shape is empty");
  if (auto error = check(options)) return *error;
  std::vector<glm::dvec3> path;
  for (const glm::dvec3& p : options.path) {
    if (path.empty() || p != path.back()) path.push_back(p);
  }
  if (options.closed && path.size() > 1 && path.front() == path.back()) path.pop_back();
  const size_t least = options.closed ? 3 : 2;
  if (path.size() < least) {
    return invalid_argument("sweep: the path needs at least " + std::to_string(least) +
                            " different points, got " + std::to_string(path.size()));
  }
  if (auto error = check_turns(path, options.closed)) return *error;
  Way way = bends_walls(options) ? divided(path, shape, options) : Way{path, {}};
  path = way.points;
  const size_t pieces = options.closed ? path.size() : path.size() - 1;
  const double rings = static_cast<double>(path.size());
  if (rings > kMostPoints) return too_many_points(kSweep, rings, rings);
  std::vector<Shape2D::Loop> loops = divided_loops(shape, options, pieces);
  size_t outline = 0;
  for (const Shape2D::Loop& loop : loops) outline += loop.size();
  const double points = rings * static_cast<double>(outline);
  if (points > kMostPoints) return too_many_points(kSweep, rings, points);
  std::vector<Frame> frames;
  std::vector<double> rolls;
  const glm::dvec3 up = up_at_start(direction_of(path, 0), options.up);
  for (size_t i = 0; i < pieces; ++i) {
    const glm::dvec3 forward = direction_of(path, i);
    const std::optional<Frame> upright = upright_frame(forward, up);
    if (i == 0 && !upright)
      return invalid_argument("sweep: up must not point along the start of the path");
    if (options.upright && !upright) {
      const glm::dvec3& p = path[i];
      return invalid_argument(
          "sweep: an upright shape cannot stand where the path goes along up, at {" +
          number_text(p.x) + ", " + number_text(p.y) + ", " + number_text(p.z) + "}");
    }
    frames.push_back(i == 0 ? *upright : carried(frames.back(), forward));
    if (options.upright) rolls.push_back(angle_between(frames.back(), *upright));
  }
  return Sweeper(shape, std::move(loops), options, std::move(way), std::move(frames),
                 std::move(rolls));
}

}  // namespace

MeshResult sweep_shape(const Shape2D& shape, const SweepOptions& options) {
  auto sweeper = make_sweeper(shape, options);
  if (!sweeper) return sweeper.error();
  return sweeper->build();
}

Result<NodePtr> sweep_solid(const Shape2D& shape, const SweepOptions& options,
                            const SourceRef& where, const MakeLeaf& make_leaf) {
  const auto leaf = [&](PolygonMesh mesh) {
    return make_leaf ? make_leaf(std::move(mesh))
                     : Node::leaf(std::make_shared<const PolygonMesh>(std::move(mesh)), where);
  };
  auto sweeper = make_sweeper(shape, options);
  if (!sweeper) return sweeper.error();
  PolygonMesh mesh = sweeper->build();
  std::vector<glm::dvec3> beyond = mesh.points;
  std::vector<CutEnd> ends = sweeper->cut_ends(mesh.points, beyond);
  if (ends.empty()) return leaf(std::move(mesh));
  PolygonMesh longer = mesh;
  longer.points = std::move(beyond);
  std::vector<NodePtr> operands{leaf(std::move(longer))};
  for (CutEnd& end : ends)
    operands.push_back(Node::transformed(end.map, leaf(std::move(end.tool)), where));
  return Node::difference_as(std::move(operands), leaf(std::move(mesh)), where);
}

}  // namespace csgrun

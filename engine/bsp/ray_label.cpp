#include "engine/bsp/ray_label.h"

#include <limits>
#include <span>
#include <vector>

#include "engine/bsp/piece_store.h"
#include "engine/bsp/rounded_box.h"

namespace csgrun {
namespace {

using Position = std::array<double, 3>;

constexpr RayDirection kDirections[] = {
    RayBoxes::kFirst, {0.0313720703125, 0.0117}, {0.0057373046875, 0.0427}};

/// Kept from one polygon to the next: most are small, and most rays meet few.
struct Memory {
  std::vector<Position> corners;
  std::vector<uint32_t> ends;  ///< of its loops
  std::vector<double> y, z;    ///< corners as the ray sees them
};

constexpr double kBoxLimit = PolygonBox::kLimit;  // boxes are clamped there

class Ray {
 public:
  Ray(VertexSigns& signs, const Position& from, double error, const RayDirection& direction,
      Memory& memory)
      : signs_(signs),
        from_(from),
        error_(error),
        direction_(direction),
        y_(memory.y),
        z_(memory.z) {}

  [[nodiscard]] bool may_meet(const PolygonBox& box) const {
    for (int k = 0; k < 3; ++k) {
      if (box.hi[k] < from_[k] - error_) return false;
    }
    // Twice as far as the ray gets: rounding is no matter.
    const double reach = box.hi[0] >= kBoxLimit ? std::numeric_limits<double>::infinity()
                                                : 2 * (box.hi[0] - from_[0]) + 1;
    return box.lo[1] <= from_[1] + error_ + reach * direction_.y &&
           box.lo[2] <= from_[2] + error_ + reach * direction_.z;
  }

  /// Whether the ray meets a convex polygon, the corners of which are as wrong as `error` at most.
  Inside meets(std::span<const Position> corners, double polygon_error) {
    const double error = std::max(error_, polygon_error);
    const double e = shear(corners, error);
    const auto beside = [&](const std::vector<double>& v) {
      return std::all_of(v.begin(), v.end(), [&](double x) { return x > e; }) ||
             std::all_of(v.begin(), v.end(), [&](double x) { return x < -e; });
    };
    if (beside(y_) || beside(z_)) return Inside::kNo;
    const double most = most_beside();
    const double bound = turn_bound(e, most);
    bool left = false, right = false, unsure = false;
    for (size_t i = 0; i < y_.size(); ++i) {
      const size_t j = i + 1 < y_.size() ? i + 1 : 0;
      const double turn = y_[i] * z_[j] - z_[i] * y_[j];
      left |= turn > bound;
      right |= turn < -bound;
      unsure |= std::fabs(turn) <= bound;
    }
    if (left && right) return Inside::kNo;  // a convex loop that goes round is seen from one side
    if (unsure) return Inside::kUnknown;
    const int side = side_of_start(corners, error);
    if (side == 0 || side == kUnsure) return Inside::kUnknown;
    return side == (left ? -1 : 1) ? Inside::kYes : Inside::kNo;
  }

  /// The same of a polygon of loops, which end at `ends`: where an odd number of edges cross the
  /// half line y > 0, z = 0, as the ray is seen.
  Inside meets_loops(std::span<const Position> corners, std::span<const uint32_t> ends,
                     double polygon_error) {
    const double error = std::max(error_, polygon_error);
    const double e = shear(corners, error);
    const double most = most_beside();
    const double bound = turn_bound(e, most);
    bool inside = false;
    for (size_t l = 0, begin = 0; l < ends.size(); begin = ends[l++]) {
      for (size_t i = begin; i < ends[l]; ++i) {
        const size_t j = i + 1 < ends[l] ? i + 1 : begin;
        if ((z_[i] > e && z_[j] > e) || (z_[i] < -e && z_[j] < -e)) continue;
        if (y_[i] < -e && y_[j] < -e) continue;
        if (std::fabs(z_[i]) <= e || std::fabs(z_[j]) <= e) return Inside::kUnknown;
        const double turn = y_[i] * z_[j] - z_[i] * y_[j];
        if (std::fabs(turn) <= bound) return Inside::kUnknown;
        inside ^= (turn > 0) == (z_[j] > 0);
      }
    }
    if (!inside) return Inside::kNo;
    // Any three corners that turn, as they are seen and in space, tell on which side the ray
    // starts. Differences are off by 2 e, so is a turn by 8 e most + 8 e e, and by its roundings.
    const double corner_bound = 16 * e * most + 16 * e * e;
    for (size_t i = 2; i < corners.size(); ++i) {
      const double turn = (y_[i - 1] - y_[i - 2]) * (z_[i] - z_[i - 2]) -
                          (z_[i - 1] - z_[i - 2]) * (y_[i] - y_[i - 2]);
      if (std::fabs(turn) <= corner_bound) continue;
      const int side = signs_.orient(corners[i - 2], corners[i - 1], corners[i], from_, error);
      if (side == 0 || side == kUnsure) continue;
      return side == (turn > 0 ? -1 : 1) ? Inside::kYes : Inside::kNo;
    }
    return Inside::kUnknown;
  }

 private:
  /// Notes corners relative to the start, sheared so that the ray is the first axis. Returns by how
  /// much a coordinate may be wrong.
  double shear(std::span<const Position> corners, double error) {
    y_.resize(corners.size());
    z_.resize(corners.size());
    double reach = 0;
    for (size_t i = 0; i < corners.size(); ++i) {
      const Position& c = corners[i];
      const double dx = c[0] - from_[0], dy = c[1] - from_[1], dz = c[2] - from_[2];
      y_[i] = dy - direction_.y * dx;
      z_[i] = dz - direction_.z * dx;
      reach = std::max({reach, std::fabs(dx), std::fabs(dy), std::fabs(dz)});
    }
    // Of each: two rounded coordinates, three roundings of values below 2 reach.
    return 4 * error + 0x1p-50 * reach;
  }

  [[nodiscard]] double most_beside() const {
    double most = 0;
    for (size_t i = 0; i < y_.size(); ++i)
      most = std::max({most, std::fabs(y_[i]), std::fabs(z_[i])});
    return most;
  }

  /// A turn is off by 4 e most + 2 e e, and by its own three roundings, which are less than
  /// 2^-51 most most: most is below 2 reach, and e no less than 2^-50 reach.
  static double turn_bound(double e, double most) { return 5 * e * most + 2 * e * e; }

  int side_of_start(std::span<const Position> c, double error) {
    // Corners may stand in line, or so nearly that doubles do not tell: any three that turn will do.
    int side = 0;
    for (size_t i = 1; i + 1 < c.size() && (side == 0 || side == kUnsure); ++i) {
      const int s = signs_.orient(c[0], c[i], c[i + 1], from_, error);
      if (s != 0) side = s;
    }
    return side;
  }

  VertexSigns& signs_;
  const Position from_;
  const double error_;
  const RayDirection direction_;
  std::vector<double>& y_;
  std::vector<double>& z_;
};

/// Those of a face that a ray may meet (RayBoxes).
void add_corners(const Job& job, uint32_t operand, uint32_t face, std::vector<Position>& corners) {
  if (!job.some_faces(operand)) {
    const JobPolygon& polygon = job.polygons()[job.polygon_start(operand) + face];
    for (const uint32_t v : job.corners(polygon)) corners.push_back(job.rounded(v));
    return;
  }
  // The job does not have all of them.
  const LeafGeometry& leaf = *job.leaf(operand);
  for (uint32_t c = leaf.face_starts[face]; c < leaf.face_starts[face + 1]; ++c) {
    corners.push_back(job.rounded(job.vertex_start(operand) + leaf.corners[c]));
  }
}

}  // namespace

Inside ray_label(const Job& job, VertexSigns& signs, RayBoxes& boxes, uint32_t operand,
                 const Position& point, double error) {
  for (const double c : point) {
    if (std::fabs(c) >= kBoxLimit) return Inside::kUnknown;
  }
  const double operand_error = signs.error(operand);
  // What bins leave out, meets() would say no to: it is more beside the ray than any corner is
  // wrong by, as the ray sees it.
  const bool may_use_bins = 4 * std::max(error, operand_error) + 1 <= RayBoxes::kMargin;
  thread_local Memory memory;
  std::vector<Position>& corners = memory.corners;
  std::vector<uint32_t>& ends = memory.ends;
  for (const RayDirection& direction : kDirections) {
    Ray ray(signs, point, error, direction, memory);
    bool inside = false, unsure = false;
    const auto look_at = [&](Inside met) {
      unsure |= met == Inside::kUnknown;
      inside ^= met == Inside::kYes;
    };
    if (const PieceOperand* all = job.pieces(operand)) {
      const PieceStore& store = *all->store;
      all->pieces.each(
          [&](const PieceBox& box) { return !unsure && ray.may_meet(rounded_outwards(box)); },
          [&](uint32_t piece) {
            if (unsure || !ray.may_meet(rounded_outwards(store.box(piece)))) return;
            store.each_face(piece, [&](std::span<const uint32_t> points) {
              if (unsure) return;
              corners.clear();
              PieceBox box;
              for (const uint32_t p : points) box.add(corners.emplace_back(store.rounded(p)));
              if (!ray.may_meet(rounded_outwards(box))) return;
              if (!store.is_region(piece)) return look_at(ray.meets(corners, operand_error));
              ends.clear();
              store.each_loop(piece, [&](uint32_t, uint32_t end) { ends.push_back(end); });
              look_at(ray.meets_loops(corners, ends, operand_error));
            });
          });
    } else {
      const uint32_t count = boxes.face_count(operand);
      const PolygonBox* const own =
          job.some_faces(operand) ? nullptr : job.boxes().data() + job.polygon_start(operand);
      const auto look_at_face = [&](uint32_t f) {
        if (own ? !ray.may_meet(own[f]) : !ray.may_meet(boxes.box(operand, f))) return;
        corners.clear();
        add_corners(job, operand, f, corners);
        look_at(ray.meets(corners, operand_error));
      };
      if (may_use_bins && &direction == &kDirections[0]) {
        if (const auto near = boxes.along_first(operand, point)) {
          for (size_t i = 0; i < near->size() && !unsure; ++i) look_at_face((*near)[i]);
          if (!unsure) return inside ? Inside::kYes : Inside::kNo;
          continue;
        }
      }
      const std::span<const PolygonBox> runs = boxes.of(operand);
      for (uint32_t f = 0; f < count && !unsure; ++f) {
        if (!runs.empty() && f % RayBoxes::kEach == 0 && !ray.may_meet(runs[f / RayBoxes::kEach])) {
          f += RayBoxes::kEach - 1;
          continue;
        }
        look_at_face(f);
      }
    }
    if (!unsure) return inside ? Inside::kYes : Inside::kNo;
  }
  return Inside::kUnknown;
}

}  // namespace csgrun

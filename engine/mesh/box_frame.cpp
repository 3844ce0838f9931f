#include "engine/mesh/box_frame.h"

#include <algorithm>
#include <cmath>

#include "engine/base/vec3d.h"

namespace csgrun {
namespace {

using Vec = Vec3d;

/// Normals are gathered in this many classes for each coordinate from 0 to 1.
constexpr double kClasses = 32;
/// A frame must save so much to be worth the time that coordinates along it take.
constexpr double kWorthwhile = 0.6;
/// A triangle is long if its longest side is so many times its height over that; and one in
/// kLongShare of so many must be.
constexpr double kLong = 8;
constexpr size_t kLongSample = 128, kLongShare = 8;

Vec unit(const Vec& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Of length 1, its largest coordinate positive; for directions that count the same both ways.
Vec line_of(const Vec& a) {
  const Vec d = unit(a);
  size_t largest = 0;
  for (size_t k = 1; k < 3; ++k) {
    if (std::fabs(d[k]) > std::fabs(d[largest])) largest = k;
  }
  return d[largest] < 0 ? Vec{-d[0], -d[1], -d[2]} : d;
}

/// The first three corners of a face, relative to the first one.
struct Sample {
  std::array<Vec, 3> points;
  Vec normal, longest;  ///< lines, the second along the longest edge
  double weight;        ///< the square of that: what the box of a long triangle grows with
};

std::vector<Sample> samples_of(std::span<const std::array<Vec, 3>> triangles) {
  std::vector<Sample> samples;
  samples.reserve(triangles.size());
  for (const std::array<Vec, 3>& triangle : triangles) {
    Sample s{};
    for (size_t i = 1; i < 3; ++i) s.points[i] = minus(triangle[i], triangle[0]);
    const Vec normal = cross(s.points[1], s.points[2]);
    if (dot(normal, normal) == 0) continue;
    s.normal = line_of(normal);
    Vec longest{};
    for (const Vec& edge : {s.points[1], s.points[2], minus(s.points[2], s.points[1])}) {
      if (dot(edge, edge) <= s.weight) continue;
      s.weight = dot(edge, edge);
      longest = edge;
    }
    s.longest = line_of(longest);
    samples.push_back(s);
  }
  return samples;
}

/// The first three corners of a face.
std::array<Vec, 3> corners_of(const LeafGeometry& leaf, size_t face) {
  std::array<Vec, 3> triangle;
  for (size_t i = 0; i < 3; ++i) {
    const IVec3& p = leaf.vertices[leaf.corners[leaf.face_starts[face] + i]];
    for (size_t k = 0; k < 3; ++k) triangle[i][k] = static_cast<double>(p[k]);
  }
  return triangle;
}

struct Line {
  Vec direction;
  double weight;
};

/// A number for the class of a direction of length 1.
uint32_t class_of(const Vec& direction) {
  static_assert(2 * kClasses + 1 < 128);
  uint32_t number = 0;
  for (const double c : direction) {
    const double place = (c + 1) * kClasses + 0.5;
    number = number << 7 | (place >= 0 && place < 128 ? static_cast<uint32_t>(place) : 0);
  }
  return number;
}

/// Of the class of lines that weighs most, the line that does; of length 0 if there are none.
Vec heaviest(const std::vector<Line>& lines) {
  struct Keyed {
    uint32_t key, line;
  };
  std::vector<Keyed> order(lines.size());
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = {class_of(lines[i].direction), i};
  std::sort(order.begin(), order.end(), [](const Keyed& a, const Keyed& b) {
    return a.key != b.key ? a.key < b.key : a.line < b.line;
  });
  Vec best{};
  double most = 0;
  for (size_t i = 0, j = 0; i < order.size(); i = j) {
    double weight = 0;
    uint32_t large = order[i].line;
    for (; j < order.size() && order[j].key == order[i].key; ++j) {
      const Line& line = lines[order[j].line];
      weight += line.weight;
      if (line.weight > lines[large].weight) large = order[j].line;
    }
    if (weight > most) most = weight, best = lines[large].direction;
  }
  return best;
}

/// What the boxes of the samples cost: a box meets others in proportion to its surface.
template <class Project>
double cost(std::span<const Sample> samples, Project project) {
  double sum = 0;
  for (const Sample& s : samples) {
    Vec lo{}, hi{};
    for (size_t i = 1; i < 3; ++i) {
      const Vec p = project(s.points[i]);
      for (size_t k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
    }
    const Vec size = minus(hi, lo);
    sum += size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
  }
  return sum;
}

Vec along(const BoxFrame& frame, const Vec& p) {
  return {dot(frame[0], p), dot(frame[1], p), dot(frame[2], p)};
}

/// Twice what rounding may do to coordinates along a frame of points, themselves correctly rounded,
/// whose coordinates are at most `reach`: they are off by less than 2^-49 of that.
double slack_of(double reach) { return 0x1p-47 * reach; }

using Bound = std::array<float, 3>;

/// The boxes of `faces` many faces, which face_at(i) names, from bounds of vertices.
template <class FaceAt, class Bounds>
std::vector<FloatBox> boxes_from(const LeafGeometry& leaf, size_t faces, FaceAt face_at,
                                 Bounds bounds) {
  std::vector<FloatBox> boxes;
  boxes.reserve(faces);
  for (size_t i = 0; i < faces; ++i) {
    const uint32_t f = face_at(i), begin = leaf.face_starts[f], end = leaf.face_starts[f + 1];
    FloatBox box = bounds(leaf.corners[begin]);
    for (uint32_t c = begin + 1; c < end; ++c) {
      const FloatBox at = bounds(leaf.corners[c]);
      for (size_t k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], at.lo[k]);
        box.hi[k] = std::max(box.hi[k], at.hi[k]);
      }
    }
    boxes.push_back(box);
  }
  return boxes;
}

template <class FaceAt>
std::vector<FloatBox> boxes_of(const LeafGeometry& leaf, size_t faces, FaceAt face_at,
                               const std::optional<BoxFrame>& frame) {
  if (!frame) {
    return boxes_from(leaf, faces, face_at, [&](uint32_t v) {
      const IVec3& p = leaf.vertices[v];
      const Bound at{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
      return FloatBox{at, at};
    });
  }
  double reach = 0;
  for (const IVec3& p : leaf.vertices) {
    for (size_t k = 0; k < 3; ++k) reach = std::max(reach, std::fabs(static_cast<double>(p[k])));
  }
  const double slack = slack_of(reach);  // rounding to float is monotone
  std::vector<FloatBox> bounds(leaf.vertices.size());
  for (size_t v = 0; v < bounds.size(); ++v) {
    const IVec3& at = leaf.vertices[v];
    const Vec p = along(*frame, {static_cast<double>(at[0]), static_cast<double>(at[1]),
                                 static_cast<double>(at[2])});
    for (size_t k = 0; k < 3; ++k) {
      bounds[v].lo[k] = static_cast<float>(p[k] - slack);
      bounds[v].hi[k] = static_cast<float>(p[k] + slack);
    }
  }
  return boxes_from(leaf, faces, face_at, [&](uint32_t v) { return bounds[v]; });
}

}  // namespace

std::optional<BoxFrame> find_box_frame(std::span<const std::array<Vec3d, 3>> sample) {
  const std::vector<Sample> samples = samples_of(sample);
  if (samples.empty()) return std::nullopt;
  std::vector<Line> lines;
  lines.reserve(samples.size());
  for (const Sample& s : samples) lines.push_back({s.normal, s.weight});
  BoxFrame frame{heaviest(lines)};
  lines.clear();
  for (const Sample& s : samples) {
    if (std::fabs(dot(s.longest, frame[0])) < 1 / kClasses) lines.push_back({s.longest, s.weight});
  }
  // There are some: the edges of the triangle whose normal that is.
  frame[2] = unit(cross(frame[0], heaviest(lines)));
  frame[1] = cross(frame[2], frame[0]);
  const double before = cost(samples, [](const Vec& p) { return p; });
  const double after = cost(samples, [&](const Vec& p) { return along(frame, p); });
  // (Where squares overflow, or lose digits at the low end, there is none.)
  const bool is_sound = std::all_of(frame.begin(), frame.end(), [](const Vec& axis) {
    return std::fabs(dot(axis, axis) - 1) < 0x1p-40;
  });
  if (!is_sound || !std::isfinite(before) || !(after < kWorthwhile * before)) return std::nullopt;
  return frame;
}

std::optional<BoxFrame> find_box_frame(const LeafGeometry& leaf) {
  std::vector<std::array<Vec, 3>> sample;
  const size_t count = leaf.face_count(), step = count / kFrameSample + 1;
  sample.reserve(count / step + 1);
  for (size_t f = 0; f < count; f += step) {
    sample.push_back(corners_of(leaf, f));
  }
  return find_box_frame(sample);
}

Box box_along(const BoxFrame& frame, std::span<const Vec3d> points, double reach) {
  const Vec first = along(frame, points[0]);
  Box box{first, first};
  for (const Vec3d& point : points.subspan(1)) {
    const Vec p = along(frame, point);
    box.include({p, p});
  }
  const double slack = slack_of(reach);
  for (size_t k = 0; k < 3; ++k) {
    box.lo[k] -= slack;
    box.hi[k] += slack;
  }
  return box;
}

std::vector<FloatBox> face_boxes(const LeafGeometry& leaf, const std::optional<BoxFrame>& frame) {
  return boxes_of(
      leaf, leaf.face_count(), [](size_t i) { return static_cast<uint32_t>(i); }, frame);
}

std::vector<FloatBox> face_boxes(const LeafGeometry& leaf, std::span<const uint32_t> faces,
                                 const std::optional<BoxFrame>& frame) {
  return boxes_of(
      leaf, faces.size(), [&](size_t i) { return faces[i]; }, frame);
}

bool has_long_triangles(std::span<const std::array<Vec3d, 3>> sample) {
  size_t found = 0;
  for (const auto& t : sample) {
    const Vec a = minus(t[1], t[0]), b = minus(t[2], t[1]), c = minus(t[0], t[2]),
              normal = cross(a, b);
    const double longest = std::max({dot(a, a), dot(b, b), dot(c, c)});
    if (longest > kLong * std::sqrt(dot(normal, normal))) ++found;
  }
  return found * kLongShare > sample.size();
}

bool has_long_triangles(const LeafGeometry& leaf) {
  std::vector<std::array<Vec, 3>> sample;
  sample.reserve(kLongSample);
  for (size_t f = 0, step = leaf.face_count() / kLongSample + 1; f < leaf.face_count(); f += step) {
    if (leaf.face_starts[f + 1] - leaf.face_starts[f] == 3) sample.push_back(corners_of(leaf, f));
  }
  return has_long_triangles(sample);
}

std::array<std::vector<FloatBox>, 2> face_diagonals(const LeafGeometry& leaf) {
  const auto boxes = [&](int64_t sign) {
    std::vector<Bound> bounds(leaf.vertices.size());
    for (size_t v = 0; v < bounds.size(); ++v) {
      const IVec3& p = leaf.vertices[v];
      for (size_t k = 0; k < 3; ++k) {
        bounds[v][k] = static_cast<float>(p[k] + sign * p[(k + 1) % 3]);
      }
    }
    return boxes_from(
        leaf, leaf.face_count(), [](size_t i) { return static_cast<uint32_t>(i); },
        [&](uint32_t v) {
          return FloatBox{bounds[v], bounds[v]};
        });
  };
  return {boxes(1), boxes(-1)};
}

}  // namespace csgrun

#include "tests/bench/models.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace csgrun::bench {
namespace {

using Vector = std::array<double, 3>;

/// Waves of six octaves in directions that have nothing to do with each other: bumps at every
/// scale, and no plane of symmetry.
double bumps(const Vector& d, double strength, int octaves) {
  double sum = 0, frequency = 2.3, amplitude = strength;
  for (int o = 0; o < octaves; ++o) {
    for (int w = 0; w < 3; ++w) {
      const double turn = 1.7 * o + 2.4 * w;
      const double along = std::cos(turn) * d[0] + std::sin(turn) * std::cos(turn * 0.7) * d[1] +
                           std::sin(turn) * std::sin(turn * 0.7) * d[2];
      sum += amplitude / 3 * std::sin(frequency * (1 + 0.21 * w) * along + 1.3 * o + 0.9 * w);
    }
    frequency *= 2.1;
    amplitude *= 0.5;
  }
  return sum;
}

Vector unit(const RawMesh& sphere, size_t i) {
  const double *p = &sphere.points[3 * i], l = std::hypot(p[0], p[1], p[2]);
  return {p[0] / l, p[1] / l, p[2] / l};
}

/// A sphere of about `faces` triangles (8 n^2), each of its points moved to map(direction).
template <class Map>
RawMesh mapped_sphere(size_t faces, Map&& map) {
  const int n =
      std::max(1, static_cast<int>(std::lround(std::sqrt(static_cast<double>(faces) / 8))));
  RawMesh mesh = octahedron_sphere(1, 4 * n);
  for (size_t i = 0; i < mesh.point_count(); ++i) {
    const Vector p = map(unit(mesh, i));
    for (int k = 0; k < 3; ++k) {
      mesh.points[3 * i + static_cast<size_t>(k)] = static_cast<float>(p[static_cast<size_t>(k)]);
    }
  }
  return mesh;
}

/// Where on a rod along z a direction of the sphere lies: from the lower end (0) to the upper (1),
/// and around it.
struct OnRod {
  double along, around;
};
OnRod on_rod(const Vector& d) {
  return {1 - std::acos(std::clamp(d[2], -1.0, 1.0)) / M_PI, std::atan2(d[1], d[0])};
}

RawMesh statue(size_t faces) {
  return mapped_sphere(faces, [](const Vector& tilted) {
    // So that neither an edge nor a corner of the octahedron lies on the axis of the turn.
    const double c = std::cos(0.4), s = std::sin(0.4);
    const double x = c * tilted[0] + s * tilted[2], up = c * tilted[2] - s * tilted[0];
    const Vector turned{x, c * tilted[1] - s * up, s * tilted[1] + c * up};
    const double r = 10 * (1 + bumps(turned, 0.35, 6));
    return Vector{r * turned[0], 0.8 * r * turned[1], 2.5 * r * turned[2]};
  });
}

RawMesh sieve(size_t faces) {
  // A round plate with a round rim; nine dimples on either side leave little between them.
  constexpr double kFlat = 2.5, kRim = 0.5, kApart = 1.3, kDimple = 0.55, kDepth = 0.45;
  return mapped_sphere(faces, [=](const Vector& d) {
    const OnRod at = on_rod(d);
    // Along the plate: from the middle of one side over the rim to that of the other.
    const double s = (2 * kFlat + M_PI * kRim) * (0.5 - std::abs(at.along - 0.5));
    const double bend = std::max(0.0, (s - kFlat) / kRim);
    const double out = std::min(s, kFlat) + kRim * std::sin(bend);
    const double x = out * std::cos(at.around), y = out * std::sin(at.around);
    double half = kRim * std::cos(bend);
    for (int i = 0; i < 9; ++i) {
      const double off = std::hypot(x - kApart * (i % 3 - 1), y - kApart * (i / 3 - 1)) / kDimple;
      if (off < 1) half -= kDepth * (1 + std::cos(M_PI * off)) / 2;
    }
    return Vector{x, y, at.along < 0.5 ? -half : half};
  });
}

RawMesh twins(size_t faces) {
  RawMesh both;
  for (const double side : {-1.0, 1.0}) {
    const RawMesh one = mapped_sphere(faces / 2, [&](const Vector& d) {
      const double r = 1 + bumps({d[0] + side, d[1], d[2]}, 0.12, 3);
      return Vector{r * d[0] + side * 1.12, r * d[1], r * d[2]};
    });
    const auto first = static_cast<uint32_t>(both.point_count());
    both.points.insert(both.points.end(), one.points.begin(), one.points.end());
    for (const uint32_t t : one.triangles) both.triangles.push_back(first + t);
  }
  return both;
}

RawMesh ring(size_t faces) {
  return mapped_sphere(faces, [](const Vector& d) {
    const OnRod at = on_rod(d);
    constexpr double kRadius = 3, kTube = 0.8, kGap = 0.05;
    // Round ends: the tube's radius falls off over its own length.
    const double length = 2 * M_PI * kRadius - kGap - 2 * kTube;
    const double total = length + 2 * kTube, s = total * at.along;
    const double into = std::min({s / kTube, (total - s) / kTube, 1.0});
    const double r = kTube * std::sqrt(std::max(0.0, into * (2 - into)));
    const double turn = (s + kGap / 2) / kRadius, across = kRadius + r * std::cos(at.around);
    return Vector{across * std::cos(turn), across * std::sin(turn), -r * std::sin(at.around)};
  });
}

/// A joint: everything beyond `at` (along z, at rest) is turned about an axis parallel to y through
/// `at`, and the skin within `width` of it follows in proportion, as in the usual skinning of
/// characters.
struct Joint {
  double at, width, degrees;
};
Vector bent(const Vector& p, double rest, const Joint& joint) {
  const double share = std::clamp(0.5 + (rest - joint.at) / joint.width, 0.0, 1.0);
  const double a = joint.degrees * M_PI / 180, z = p[2] - joint.at;
  const double x = std::cos(a) * p[0] + std::sin(a) * z, up = std::cos(a) * z - std::sin(a) * p[0];
  return {p[0] + share * (x - p[0]), p[1], p[2] + share * (up - z)};
}

RawMesh contortionist(size_t faces) {
  return mapped_sphere(faces, [](const Vector& d) {
    const OnRod at = on_rod(d);
    const double z = 10 * at.along;  // 0 at the feet, 10 at the top of the head
    const auto swell = [&](double middle, double width, double size) {
      const double t = (z - middle) / width;
      return size * std::exp(-t * t);
    };
    const double rounded = std::min({1.0, std::sqrt(z / 0.5), std::sqrt((10 - z) / 0.5)});
    double r = 0.45 + swell(1.6, 0.9, 0.2) + swell(4.2, 1.0, 0.55) + swell(6.6, 0.9, 0.5) +
               swell(9.1, 0.6, 0.45);
    r *= rounded * (1 + bumps({d[0] * 2, d[1] * 2, z}, 0.03, 3));
    Vector p{r * std::cos(at.around), 1.3 * r * std::sin(at.around), z};
    // From the head down, so that what lies beyond a joint is turned as a whole.
    for (const Joint& joint : {Joint{8.1, 0.8, 75}, Joint{5.3, 1.2, 125}, Joint{2.6, 0.8, -140}}) {
      p = bent(p, z, joint);
    }
    return p;
  });
}

}  // namespace

RawMesh model(const std::string& name, size_t faces) {
  if (name == "statue") return statue(faces);
  if (name == "sieve") return sieve(faces);
  if (name == "twins") return twins(faces);
  if (name == "ring") return ring(faces);
  if (name == "contortionist") return contortionist(faces);
  return {};
}

}  // namespace csgrun::bench

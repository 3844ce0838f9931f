#include "tests/bench/workloads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace csgrun::bench {
namespace {

constexpr double kDome = 50;  ///< the radius

/// Donald Knuth's MMIX generator; the upper 53 bits make a number in [0, 1).
class Generator {
 public:
  explicit Generator(uint64_t seed) : state_(seed) {}
  double next() {
    state_ = state_ * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_;
};

struct SineCosine {
  double sine, cosine;
};

/// libm's, but exact where the value is: every engine is given the same numbers on one machine.
SineCosine of_degrees(double degrees) {
  double d = std::fmod(degrees, 360.0);
  if (d < 0) d += 360;
  if (d == 0) return {0, 1};
  if (d == 90) return {1, 0};
  if (d == 180) return {0, -1};
  if (d == 270) return {-1, 0};
  SineCosine r{std::sin(d * M_PI / 180), std::cos(d * M_PI / 180)};
  if (d == 30) r.sine = 0.5;
  if (d == 60) r.cosine = 0.5;
  return r;
}

void add_point(RawMesh& mesh, double x, double y, double z) {
  mesh.points.insert(mesh.points.end(), {x, y, z});
}

void add_triangle(RawMesh& mesh, uint32_t a, uint32_t b, uint32_t c) {
  mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
}

/// Square columns of one level and all finer ones within [a, a + w] x [b, b + w], along an axis.
void add_bars(std::vector<RawMesh>& bars, int axis, double side, double a, double b, double w) {
  const double third = w / 3;
  const std::array<double, 2> lo{a + third, b + third}, hi{a + 2 * third, b + 2 * third};
  std::array<double, 3> from{}, to{};
  int k = 0;
  for (int c = 0; c < 3; ++c) {
    from[c] = c == axis ? -1 : lo[k];
    to[c] = c == axis ? side + 1 : hi[k];
    if (c != axis) ++k;
  }
  bars.push_back(box(from[0], from[1], from[2], to[0], to[1], to[2]));
  if (third < 2) return;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i != 1 || j != 1) add_bars(bars, axis, side, a + i * third, b + j * third, third);
    }
  }
}

/// Rows of a rotation matrix, drawn uniformly from all: a unit quaternion of uniform direction
/// (Shoemake, Graphics Gems III, 1992).
std::array<glm::dvec3, 3> draw_rotation(Generator& random) {
  const double u = random.next(), v = 2 * M_PI * random.next(), w = 2 * M_PI * random.next();
  const double a = std::sqrt(1 - u), b = std::sqrt(u);
  const double x = a * std::sin(v), y = a * std::cos(v), z = b * std::sin(w), s = b * std::cos(w);
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - s * z), 2 * (x * z + s * y)},
           {2 * (x * y + s * z), 1 - 2 * (x * x + z * z), 2 * (y * z - s * x)},
           {2 * (x * z - s * y), 2 * (y * z + s * x), 1 - 2 * (x * x + y * y)}}};
}

glm::dvec3 turned(const std::array<glm::dvec3, 3>& rows, const glm::dvec3& p) {
  glm::dvec3 q;
  for (int k = 0; k < 3; ++k) q[k] = rows[k].x * p.x + rows[k].y * p.y + rows[k].z * p.z;
  return q;
}

RawMesh turned_at_random(const RawMesh& mesh, Generator& random) {
  const auto rows = draw_rotation(random);
  RawMesh r = mesh;
  for (size_t i = 0; i < r.points.size(); i += 3) {
    const glm::dvec3 q = turned(rows, {mesh.points[i], mesh.points[i + 1], mesh.points[i + 2]});
    for (int k = 0; k < 3; ++k) r.points[i + k] = q[k];
  }
  return r;
}

}  // namespace

PolygonMesh polygon_mesh(const RawMesh& raw, bool keep_facets) {
  PolygonMesh mesh;
  mesh.points.resize(raw.point_count());
  for (size_t i = 0; i < raw.point_count(); ++i) {
    mesh.points[i] = {raw.points[3 * i], raw.points[3 * i + 1], raw.points[3 * i + 2]};
  }
  mesh.corners = raw.triangles;
  mesh.loop_starts.reserve(raw.triangle_count() + 1);
  mesh.face_starts.reserve(raw.triangle_count() + 1);
  for (size_t t = 1; t <= raw.triangle_count(); ++t) {
    mesh.loop_starts.push_back(static_cast<uint32_t>(3 * t));
    mesh.face_starts.push_back(static_cast<uint32_t>(t));
  }
  mesh.keep_facets = keep_facets;
  return mesh;
}

RawMesh box(double x0, double y0, double z0, double x1, double y1, double z1) {
  RawMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    add_point(mesh, corner & 1 ? x1 : x0, corner & 2 ? y1 : y0, corner & 4 ? z1 : z0);
  }
  mesh.triangles = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

RawMesh octahedron_sphere(double radius, int segments) {
  const int n = segments / 4;
  RawMesh mesh;
  std::map<std::array<int, 3>, uint32_t> known;
  const auto vertex = [&](int a, int b, int c) {
    const auto [at, fresh] =
        known.try_emplace({a, b, c}, static_cast<uint32_t>(mesh.point_count()));
    if (fresh) {
      const std::array<double, 3> p{std::sin(M_PI / 2 * a / n), std::sin(M_PI / 2 * b / n),
                                    std::sin(M_PI / 2 * c / n)};
      const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
      add_point(mesh, radius * p[0] / length, radius * p[1] / length, radius * p[2] / length);
    }
    return at->second;
  };
  for (int octant = 0; octant < 8; ++octant) {
    const int sx = octant & 1 ? -1 : 1, sy = octant & 2 ? -1 : 1, sz = octant & 4 ? -1 : 1;
    const bool mirrored = sx * sy * sz < 0;
    const auto at = [&](int i, int j) { return vertex(sx * i, sy * j, sz * (n - i - j)); };
    const auto triangle = [&](uint32_t a, uint32_t b, uint32_t c) {
      add_triangle(mesh, a, mirrored ? c : b, mirrored ? b : c);
    };
    for (int i = 0; i < n; ++i) {
      for (int j = 0; i + j < n; ++j) {
        const uint32_t a = at(i, j), b = at(i + 1, j), c = at(i, j + 1);
        triangle(a, b, c);
        if (i + j + 2 <= n) triangle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
    }
  }
  return mesh;
}

RawMesh cylinder(double radius, double height, int segments) {
  RawMesh mesh;
  for (const double z : {0.0, height}) {
    for (int i = 0; i < segments; ++i) {
      const SineCosine t = of_degrees(360.0 * i / segments);
      add_point(mesh, radius * t.cosine, radius * t.sine, z);
    }
  }
  const auto n = static_cast<uint32_t>(segments);
  for (uint32_t i = 0; i < n; ++i) {
    const uint32_t j = (i + 1) % n;
    add_triangle(mesh, i, j, n + j);
    add_triangle(mesh, i, n + j, n + i);
  }
  for (uint32_t i = 1; i + 1 < n; ++i) {
    add_triangle(mesh, 0, i + 1, i);
    add_triangle(mesh, n, n + i, n + i + 1);
  }
  return mesh;
}

RawMesh moved(const RawMesh& mesh, double x, double y, double z) {
  RawMesh r = mesh;
  for (size_t i = 0; i < r.points.size(); i += 3) {
    r.points[i] += x, r.points[i + 1] += y, r.points[i + 2] += z;
  }
  return r;
}

RawMesh rotated_z(const RawMesh& mesh, double degrees) {
  if (degrees == 0) return mesh;
  double lo[2] = {HUGE_VAL, HUGE_VAL}, hi[2] = {-HUGE_VAL, -HUGE_VAL};
  for (size_t i = 0; i < mesh.points.size(); i += 3) {
    for (int k = 0; k < 2; ++k) {
      lo[k] = std::min(lo[k], mesh.points[i + k]);
      hi[k] = std::max(hi[k], mesh.points[i + k]);
    }
  }
  const double cx = (lo[0] + hi[0]) / 2, cy = (lo[1] + hi[1]) / 2;
  const SineCosine t = of_degrees(degrees);
  RawMesh r = mesh;
  for (size_t i = 0; i < r.points.size(); i += 3) {
    const double x = mesh.points[i] - cx, y = mesh.points[i + 1] - cy;
    r.points[i] = cx + (t.cosine * x - t.sine * y);
    r.points[i + 1] = cy + (t.sine * x + t.cosine * y);
  }
  return r;
}

std::vector<RawMesh> drill_spheres(int n) {
  const RawMesh sphere = octahedron_sphere(1.5, 32);
  Generator random(12345);
  std::vector<RawMesh> spheres;
  for (int i = 0; i < n; ++i) {
    const double x = 100 * random.next(), y = 100 * random.next();
    spheres.push_back(moved(sphere, x, y, 20));
  }
  return spheres;
}

std::vector<RawMesh> dome_spheres(int n) {
  const RawMesh sphere = octahedron_sphere(2, 32);
  Generator random(12345);
  std::vector<RawMesh> spheres;
  for (int i = 0; i < n; ++i) {
    const double z = 2 * random.next() - 1, angle = 2 * M_PI * random.next();
    const double r = std::sqrt(1 - z * z);
    spheres.push_back(
        moved(sphere, kDome * r * std::cos(angle), kDome * r * std::sin(angle), kDome * z));
  }
  return spheres;
}

RawMesh dome() { return octahedron_sphere(kDome, 128); }

RawMesh block() { return box(0, 0, 0, 100, 100, 20); }

std::vector<RawMesh> menger_bars(int k) {
  const double side = std::pow(3.0, k);
  std::vector<RawMesh> bars;
  for (int axis = 0; axis < 3; ++axis) add_bars(bars, axis, side, 0, 0, side);
  return bars;
}

RawMesh menger_cube(int k) {
  const double side = std::pow(3.0, k);
  return box(0, 0, 0, side, side, side);
}

std::vector<RawMesh> cylinder_grid(int n) {
  const RawMesh one = cylinder(0.6, 1, 32);
  std::vector<RawMesh> all;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) all.push_back(moved(one, i, j, 0));
  }
  return all;
}

std::vector<RawMesh> cube_grid(int n) {
  std::vector<RawMesh> all;
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) all.push_back(box(x, y, z, x + 1, y + 1, z + 1));
    }
  }
  return all;
}

std::vector<RawMesh> shells(int n) {
  const RawMesh sphere = octahedron_sphere(10, 40);
  Generator random(12345);
  std::vector<RawMesh> all;
  for (int i = 0; i < n; ++i) all.push_back(turned_at_random(sphere, random));
  return all;
}

std::vector<RawMesh> rods(int n) {
  const RawMesh rod = box(-100, -1, -1, 100, 1, 1);
  Generator random(12345);
  std::vector<RawMesh> all;
  for (int i = 0; i < n; ++i) {
    const RawMesh turned = turned_at_random(rod, random);
    const double x = 50 * random.next(), y = 50 * random.next(), z = 50 * random.next();
    all.push_back(moved(turned, x, y, z));
  }
  return all;
}

std::vector<RawMesh> plates(int n) {
  const RawMesh plate = box(0, 0, 0, 14, 13, 5);
  Generator random(12345);
  std::vector<RawMesh> all;
  for (int i = 0; i < n; ++i) {
    const RawMesh turned = rotated_z(plate, 360 * random.next());
    const double x = 300 * random.next(), y = 300 * random.next();
    all.push_back(moved(turned, x, y, 0));
  }
  return all;
}

void scale_to_box(PolygonMesh& mesh) {
  glm::dvec3 lo(HUGE_VAL), hi(-HUGE_VAL);
  for (const glm::dvec3& p : mesh.points) {
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  }
  const glm::dvec3 size = hi - lo, middle = (lo + hi) / 2.0;
  const double scale = 100 / std::max({size.x, size.y, size.z});
  for (glm::dvec3& p : mesh.points) p = (p - middle) * scale;
}

void rotate_at_random(PolygonMesh& mesh, uint64_t seed) {
  Generator random(seed);
  const auto rows = draw_rotation(random);
  for (glm::dvec3& p : mesh.points) p = turned(rows, p);
}

}  // namespace csgrun::bench

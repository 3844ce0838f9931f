// csgdistance A B: how far two surfaces are apart: the largest distance from a vertex of either to
// the surface of the other, and the same for the vertices rounded to float32. One JSON line.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <csgrun/primitives/mesh_file.h>

namespace {

using Triangle = std::array<glm::dvec3, 3>;

struct Surface {
  std::vector<glm::dvec3> points;
  std::vector<Triangle> triangles;
};

Surface read(const std::string& path) {
  const auto mesh = csgrun::read_mesh_file(path);
  if (!mesh) {
    std::fprintf(stderr, "csgdistance: %s\n", mesh.error().message.c_str());
    std::exit(1);
  }
  Surface s{mesh->points, {}};
  for (size_t l = 0; l < mesh->loop_count(); ++l) {
    const uint32_t first = mesh->loop_starts[l];
    for (uint32_t c = first + 1; c + 1 < mesh->loop_starts[l + 1]; ++c) {
      s.triangles.push_back({mesh->points[mesh->corners[first]], mesh->points[mesh->corners[c]],
                             mesh->points[mesh->corners[c + 1]]});
    }
  }
  return s;
}

void round_to_float(Surface& s) {
  const auto rounded = [](const glm::dvec3& p) {
    return glm::dvec3(static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
  };
  for (glm::dvec3& p : s.points) p = rounded(p);
  for (Triangle& t : s.triangles) {
    for (glm::dvec3& p : t) p = rounded(p);
  }
}

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

double squared_to_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 along = b - a;
  const double length = dot(along, along);
  const double t = length > 0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0.0;
  const glm::dvec3 d = p - a - along * t;
  return dot(d, d);
}

double squared_to_triangle(const glm::dvec3& p, const Triangle& t) {
  const glm::dvec3 u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double d = uu * vv - uv * uv;
  double nearest = std::min({squared_to_segment(p, t[0], t[1]), squared_to_segment(p, t[1], t[2]),
                             squared_to_segment(p, t[2], t[0])});
  if (d > 0) {
    const double a = (vv * wu - uv * wv) / d, b = (uu * wv - uv * wu) / d;
    if (a >= 0 && b >= 0 && a + b <= 1) {
      const glm::dvec3 off = w - u * a - v * b;
      nearest = std::min(nearest, dot(off, off));
    }
  }
  return nearest;
}

/// The largest distance from a vertex of `from` to the surface `to`. Vertices that both have are
/// quick; for others all triangles are looked at.
double one_sided(const Surface& from, const Surface& to) {
  const auto key = [](const glm::dvec3& p) { return std::array<double, 3>{p.x, p.y, p.z}; };
  std::set<std::array<double, 3>> known;
  for (const glm::dvec3& p : to.points) known.insert(key(p));
  double largest = 0;
  for (const glm::dvec3& p : from.points) {
    if (known.contains(key(p))) continue;
    double nearest = HUGE_VAL;
    for (const Triangle& t : to.triangles) nearest = std::min(nearest, squared_to_triangle(p, t));
    largest = std::max(largest, nearest);
  }
  return std::sqrt(largest);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: csgdistance A B\n");
    return 2;
  }
  Surface a = read(argv[1]), b = read(argv[2]);
  const double distance = std::max(one_sided(a, b), one_sided(b, a));
  round_to_float(a);
  round_to_float(b);
  std::printf("{\"distance\":%.17g,\"distance_of_floats\":%.17g}\n", distance,
              std::max(one_sided(a, b), one_sided(b, a)));
  return 0;
}

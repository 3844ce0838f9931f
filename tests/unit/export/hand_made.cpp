#include "tests/unit/export/hand_made.h"

#include <array>
#include <utility>

namespace csgrun::testing {

HandMade::HandMade() { solid.appearances.emplace_back(); }

uint32_t HandMade::vertex(double x, double y, double z) {
  solid.positions.emplace_back(x, y, z);
  solid.positions_f32.push_back(
      {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  // Copies of a point are one point, as the engine has it.
  const auto [place, fresh] = points_.emplace(std::array{x, y, z}, points_.size());
  solid.point_of.push_back(static_cast<uint32_t>(place->second));
  return static_cast<uint32_t>(solid.positions.size() - 1);
}

uint32_t HandMade::appearance(const Appearance& a) {
  solid.appearances.push_back(a);
  return static_cast<uint32_t>(solid.appearances.size() - 1);
}

uint32_t HandMade::source(std::string kind, std::string where) {
  solid.sources.push_back({std::move(kind), std::move(where)});
  return static_cast<uint32_t>(solid.sources.size() - 1);
}

void HandMade::face(const std::vector<uint32_t>& loop, uint32_t appearance, uint32_t surface,
                    uint32_t source) {
  std::vector<std::array<uint32_t, 3>> fan;
  for (size_t i = 1; i + 1 < loop.size(); ++i) fan.push_back({loop[0], loop[i], loop[i + 1]});
  face({loop}, fan, appearance, surface, source);
}

void HandMade::face(const std::vector<std::vector<uint32_t>>& loops,
                    const std::vector<std::array<uint32_t, 3>>& triangles, uint32_t appearance,
                    uint32_t surface, uint32_t source) {
  const auto first_loop = static_cast<uint32_t>(solid.loop_starts.size() - 1);
  for (const auto& loop : loops) {
    solid.loop_vertices.insert(solid.loop_vertices.end(), loop.begin(), loop.end());
    solid.loop_starts.push_back(static_cast<uint32_t>(solid.loop_vertices.size()));
  }
  solid.triangles.insert(solid.triangles.end(), triangles.begin(), triangles.end());
  solid.triangle_face.resize(solid.triangles.size(), static_cast<uint32_t>(solid.faces.size()));
  solid.faces.push_back(
      {first_loop, static_cast<uint32_t>(loops.size()), appearance, surface, source});
}

void HandMade::box(const glm::dvec3& low, const glm::dvec3& high, uint32_t appearance) {
  std::array<uint32_t, 8> v{};
  for (uint32_t i = 0; i < 8; ++i) {
    v[i] = vertex(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  }
  for (const std::array<int, 4>& f : {std::array{0, 2, 3, 1},
                                      {4, 5, 7, 6},
                                      {0, 1, 5, 4},
                                      {1, 3, 7, 5},
                                      {3, 2, 6, 7},
                                      {2, 0, 4, 6}}) {
    face({v[f[0]], v[f[1]], v[f[2]], v[f[3]]}, appearance);
  }
}

void HandMade::tetrahedron(const std::array<glm::dvec3, 4>& p) {
  std::array<uint32_t, 4> v{};
  for (size_t i = 0; i < 4; ++i) v[i] = vertex(p[i].x, p[i].y, p[i].z);
  face({v[0], v[1], v[2]});
  face({v[0], v[3], v[1]});
  face({v[0], v[2], v[3]});
  face({v[1], v[3], v[2]});
}

void HandMade::prism(const std::vector<std::pair<double, double>>& corners, double h,
                     uint32_t side_surface) {
  std::vector<uint32_t> bottom, top;
  for (const auto& [x, y] : corners) bottom.push_back(vertex(x, y, 0));
  for (const auto& [x, y] : corners) top.push_back(vertex(x, y, h));
  face(top);
  face(std::vector<uint32_t>(bottom.rbegin(), bottom.rend()));
  for (size_t i = 0; i < corners.size(); ++i) {
    const size_t j = (i + 1) % corners.size();
    face({bottom[i], bottom[j], top[j], top[i]}, 0, side_surface);
  }
}

SolidPtr HandMade::share() const { return std::make_shared<Solid>(solid); }

SolidPtr cube(double size) {
  HandMade made;
  made.box({0, 0, 0}, {size, size, size});
  return made.share();
}

SolidPtr edge_touching_cubes() {
  HandMade made;
  made.box({0, 0, 0}, {1, 1, 1});
  made.box({-1, -1, 0}, {0, 0, 1});
  return made.share();
}

SolidPtr dumbbell(double width) {
  HandMade made;
  const double low = 0.5, high = 0.5 + width;
  // Corners of squares in the y-z plane, counter-clockwise seen from +x.
  const auto square = [&](double x, double a, double b) {
    return std::array{made.vertex(x, a, a), made.vertex(x, b, a), made.vertex(x, b, b),
                      made.vertex(x, a, b)};
  };
  const auto ring_triangles = [](const std::array<uint32_t, 4>& out,
                                 const std::array<uint32_t, 4>& in) {
    std::vector<std::array<uint32_t, 3>> t;
    for (size_t i = 0; i < 4; ++i) {
      const size_t j = (i + 1) % 4;
      t.push_back({out[i], out[j], in[i]});
      t.push_back({out[j], in[j], in[i]});
    }
    return t;
  };
  const auto reversed = [](std::array<uint32_t, 4> s) {
    return std::array{s[0], s[3], s[2], s[1]};
  };
  const auto walls = [&](const std::array<uint32_t, 4>& a, const std::array<uint32_t, 4>& b) {
    for (size_t i = 0; i < 4; ++i) made.face({a[i], a[(i + 1) % 4], b[(i + 1) % 4], b[i]});
  };
  const auto as_list = [](const std::array<uint32_t, 4>& s) {
    return std::vector<uint32_t>(s.begin(), s.end());
  };
  const auto a = square(0, 0, 1), b = square(1, 0, 1), c = square(1, low, high),
             d = square(2, low, high), e = square(2, 0, 1), f = square(3, 0, 1);
  made.face(as_list(reversed(a)));
  walls(a, b);
  made.face({as_list(b), as_list(reversed(c))}, ring_triangles(b, c));
  walls(c, d);
  made.face({as_list(reversed(e)), as_list(d)}, ring_triangles(reversed(e), reversed(d)));
  walls(e, f);
  made.face(as_list(f));
  return made.share();
}

}  // namespace csgrun::testing

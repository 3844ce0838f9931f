// A small software renderer: triangles and lines over a depth buffer, flat shading, seen in
// parallel.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace csgrun::experiments {

/// Red, green, blue in [0, 1].
using Colour = glm::dvec3;

/// Where the model is seen from, and which part of it fills the picture.
struct View {
  double turn = 30;     ///< degrees about z, the up axis
  double tilt = 20;     ///< degrees above the horizon
  glm::dvec3 middle{};  ///< what is in the middle of the picture
  double height = 1;    ///< of what is seen, in the model's units
};

/// Everything beyond the plane is cut away: where dot(normal, x) > offset.
struct CutPlane {
  glm::dvec3 normal{};
  double offset = 0;
};

class Picture {
 public:
  Picture(int width, int height, const View& view);

  /// A triangle; `paint` gives the colour of a point of it before shading, from its place and
  /// whether its back is seen.
  template <class Paint>
  void triangle(const std::array<glm::dvec3, 3>& corners, const std::optional<CutPlane>& cut,
                Paint&& paint);
  /// A line over what is there, `pixels` wide.
  void line(const glm::dvec3& from, const glm::dvec3& to, double pixels, const Colour& colour);

  /// Portable pixmap (binary PPM). False when it cannot be written.
  [[nodiscard]] bool write(const std::string& path) const;

 private:
  static constexpr int kSamples = 3;  ///< in each direction of a pixel

  struct Sample {
    float depth = -1e30f;
    std::array<uint8_t, 3> colour{255, 255, 255};
  };
  /// Sample coordinates (x right, y down) and depth towards the viewer.
  [[nodiscard]] glm::dvec3 project(const glm::dvec3& p) const;
  /// How bright a surface with this normal is.
  [[nodiscard]] double light(const glm::dvec3& normal) const;
  void put(int x, int y, double depth, const Colour& colour);

  int width_, height_;  ///< in samples
  View view_;
  double scale_;
  glm::dvec3 right_{}, up_{}, towards_{};
  std::vector<Sample> samples_;
};

template <class Paint>
void Picture::triangle(const std::array<glm::dvec3, 3>& corners, const std::optional<CutPlane>& cut,
                       Paint&& paint) {
  const auto cross = [](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
  };
  const auto dot = [](const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  };
  const glm::dvec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const bool back = dot(normal, towards_) < 0;
  const double brightness = light(back ? -normal : normal);
  const std::array<glm::dvec3, 3> p{project(corners[0]), project(corners[1]), project(corners[2])};
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
  if (area == 0) return;
  const auto range = [](double a, double b, double c, int end, int& from, int& to) {
    from = std::max(0, static_cast<int>(std::min({a, b, c})));
    to = std::min(end - 1, static_cast<int>(std::max({a, b, c})) + 1);
  };
  int x0, x1, y0, y1;
  range(p[0].x, p[1].x, p[2].x, width_, x0, x1);
  range(p[0].y, p[1].y, p[2].y, height_, y0, y1);
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double px = x + 0.5, py = y + 0.5;
      std::array<double, 3> share{};
      bool inside = true;
      for (int k = 0; k < 3 && inside; ++k) {
        const glm::dvec3 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
        share[k] = ((a.x - px) * (b.y - py) - (a.y - py) * (b.x - px)) / area;
        inside = share[k] >= 0;
      }
      if (!inside) continue;
      const glm::dvec3 place =
          share[0] * corners[0] + share[1] * corners[1] + share[2] * corners[2];
      if (cut && dot(cut->normal, place) > cut->offset) continue;
      const double depth = share[0] * p[0].z + share[1] * p[1].z + share[2] * p[2].z;
      put(x, y, depth, paint(place, back) * brightness);
    }
  }
}

}  // namespace csgrun::experiments

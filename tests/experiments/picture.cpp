#include "tests/experiments/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace csgrun::experiments {

Picture::Picture(int width, int height, const View& view)
    : width_(width * kSamples),
      height_(height * kSamples),
      view_(view),
      scale_(height_ / view.height),
      samples_(static_cast<size_t>(width_) * static_cast<size_t>(height_)) {
  const double turn = view.turn * M_PI / 180, tilt = view.tilt * M_PI / 180;
  right_ = {std::cos(turn), std::sin(turn), 0};
  towards_ = {std::sin(turn) * std::cos(tilt), -std::cos(turn) * std::cos(tilt), std::sin(tilt)};
  up_ = {-std::sin(turn) * std::sin(tilt), std::cos(turn) * std::sin(tilt), std::cos(tilt)};
}

glm::dvec3 Picture::project(const glm::dvec3& p) const {
  const glm::dvec3 q = p - view_.middle;
  const auto along = [&](const glm::dvec3& d) { return q.x * d.x + q.y * d.y + q.z * d.z; };
  return {width_ / 2.0 + scale_ * along(right_), height_ / 2.0 - scale_ * along(up_),
          scale_ * along(towards_)};
}

double Picture::light(const glm::dvec3& normal) const {
  const double length = std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
  if (length == 0) return 0;
  const auto from = [&](const glm::dvec3& d) {
    return std::max(0.0, (normal.x * d.x + normal.y * d.y + normal.z * d.z) / length);
  };
  const glm::dvec3 key = 0.45 * right_ * -1.0 + 0.55 * up_ + 0.7 * towards_;
  return std::min(1.0, 0.28 + 0.62 * from(key) + 0.22 * from(towards_));
}

void Picture::put(int x, int y, double depth, const Colour& colour) {
  Sample& sample =
      samples_[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
  if (depth <= sample.depth) return;
  sample.depth = static_cast<float>(depth);
  for (int k = 0; k < 3; ++k) {
    sample.colour[static_cast<size_t>(k)] =
        static_cast<uint8_t>(std::lround(255 * std::clamp(colour[k], 0.0, 1.0)));
  }
}

void Picture::line(const glm::dvec3& from, const glm::dvec3& to, double pixels,
                   const Colour& colour) {
  const glm::dvec3 a = project(from), b = project(to);
  const double radius = pixels * kSamples / 2;
  const double length = std::hypot(b.x - a.x, b.y - a.y);
  const int steps = std::max(1, static_cast<int>(2 * length / std::max(1.0, radius)));
  // A little nearer than the surface that the line lies on.
  const double lift = 2 * kSamples;
  for (int i = 0; i <= steps; ++i) {
    const glm::dvec3 p = a + (b - a) * (static_cast<double>(i) / steps);
    for (int y = static_cast<int>(p.y - radius); y <= static_cast<int>(p.y + radius) + 1; ++y) {
      for (int x = static_cast<int>(p.x - radius); x <= static_cast<int>(p.x + radius) + 1; ++x) {
        if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
        if (std::hypot(x + 0.5 - p.x, y + 0.5 - p.y) > radius) continue;
        put(x, y, p.z + lift, colour);
      }
    }
  }
}

bool Picture::write(const std::string& path) const {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (!file) return false;
  const int columns = width_ / kSamples, rows = height_ / kSamples;
  std::fprintf(file, "P6\n%d %d\n255\n", columns, rows);
  std::vector<uint8_t> row(static_cast<size_t>(columns) * 3);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      std::array<int, 3> sum{};
      for (int j = 0; j < kSamples; ++j) {
        for (int i = 0; i < kSamples; ++i) {
          const Sample& sample =
              samples_[static_cast<size_t>(y * kSamples + j) * static_cast<size_t>(width_) +
                       static_cast<size_t>(x * kSamples + i)];
          for (size_t k = 0; k < 3; ++k) sum[k] += sample.colour[k];
        }
      }
      for (size_t k = 0; k < 3; ++k) {
        row[static_cast<size_t>(x) * 3 + k] = static_cast<uint8_t>(sum[k] / (kSamples * kSamples));
      }
    }
    std::fwrite(row.data(), 1, row.size(), file);
  }
  return std::fclose(file) == 0;
}

}  // namespace csgrun::experiments

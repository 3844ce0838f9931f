#include "tests/support/random_frames.h"

#include <cmath>

namespace csgrun::test {

Matrix times(const Matrix& a, const Matrix& b) {
  Matrix r{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
    }
  }
  return r;
}

Matrix turn_about(int axis, double degrees) {
  const double a = degrees * 3.14159265358979323846 / 180;
  Matrix m{};
  const int i = (axis + 1) % 3, j = (axis + 2) % 3;
  m[axis][axis] = 1;
  m[i][i] = m[j][j] = std::cos(a);
  m[i][j] = -std::sin(a);
  m[j][i] = std::sin(a);
  return m;
}

Frame frame_of(const Matrix& inverse) {
  Frame frame;
  frame.is_identity = false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      frame.matrix[i][j] = std::llround(std::ldexp(inverse[i][j], Frame::kShift));
    }
  }
  return frame;
}

Frame random_frame(Random& random) {
  Matrix m = turn_about(static_cast<int>(random.integer(0, 2)),
                        static_cast<double>(random.integer(1, 89)));
  const int64_t kind = random.integer(0, 5);
  if (kind >= 2) {
    for (int axis = 0; axis < 3; ++axis) {
      m = times(turn_about(axis, static_cast<double>(random.integer(-180, 180))), m);
    }
  }
  if (kind == 3 || kind == 0) {
    const auto row = static_cast<size_t>(random.integer(0, 2));
    for (double& v : m[row]) v = -v;
  }
  if (kind == 4) {
    Matrix shear = turn_about(0, 0);
    shear[static_cast<size_t>(random.integer(0, 1))][2] =
        static_cast<double>(random.integer(-8, 8)) / 5;
    m = times(shear, m);
  }
  return frame_of(m);
}

}  // namespace csgrun::test

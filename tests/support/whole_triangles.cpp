#include "tests/support/whole_triangles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace csgrun::test {

double gap(const Triangle& s, const Triangle& t, const Vec& way) {
  const auto range = [&](const Triangle& x) {
    return std::minmax({dot(x[0], way), dot(x[1], way), dot(x[2], way)});
  };
  const auto [s_lo, s_hi] = range(s);
  const auto [t_lo, t_hi] = range(t);
  return std::max(t_lo - s_hi, s_lo - t_hi);
}

bool are_apart(const Triangle& s, const Triangle& t) {
  std::vector<Vec> ways{normal(s), normal(t)};
  for (size_t i = 0; i < 3; ++i) {
    ways.push_back(cross(edge(s, i), normal(s)));
    ways.push_back(cross(edge(t, i), normal(t)));
    for (size_t k = 0; k < 3; ++k) ways.push_back(cross(edge(s, i), edge(t, k)));
  }
  return std::any_of(ways.begin(), ways.end(), [&](const Vec& way) { return gap(s, t, way) > 0; });
}

double most_room(const Triangle& s, const Triangle& t) {
  double most = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 4; ++i) {
    const Vec way = i == 3 ? normal(s) : cross(edge(s, i), normal(s));
    most = std::max(most, gap(s, t, way) / std::sqrt(dot(way, way)));
  }
  return most;
}

Triangle random_triangle(Random& random, int64_t reach) {
  Triangle t;
  do {
    for (Vec& p : t) {
      for (double& c : p) c = static_cast<double>(random.integer(-reach, reach));
    }
  } while (normal(t) == Vec{});
  return t;
}

Triangle random_neighbour(const Triangle& own, Random& random, int64_t size) {
  Triangle t = random_triangle(random, size);
  if (random.integer(0, 2) == 0) t[0] = own[1], t[1] = own[2];
  if (random.integer(0, 3) == 0) {
    const auto a = static_cast<double>(random.integer(-1, 2));
    for (size_t k = 0; k < 3; ++k) t[2][k] = own[0][k] + a * edge(own, 1)[k];
  }
  if (random.integer(0, 3) > 0) return t;
  do {
    for (Vec& p : t) {
      const auto a = static_cast<double>(random.integer(-3, 3)),
                 b = static_cast<double>(random.integer(-3, 3));
      for (size_t k = 0; k < 3; ++k) p[k] = own[0][k] + a * edge(own, 0)[k] + b * edge(own, 1)[k];
    }
  } while (normal(t) == Vec{});
  return t;
}

Triangle scaled(Triangle t, double factor, const Vec& move) {
  for (Vec& p : t) {
    for (size_t k = 0; k < 3; ++k) p[k] = p[k] * factor + move[k];
  }
  return t;
}

Triangle random_touching(const Triangle& own, Random& random, int64_t size, const Vec& move) {
  Triangle t = random_triangle(random, size);
  const auto corner = static_cast<size_t>(random.integer(0, 2));
  t[corner] = own[static_cast<size_t>(random.integer(0, 2))];
  t = scaled(t, 3, move);
  if (random.integer(0, 1)) {
    for (size_t k = 0; k < 3; ++k) t[corner][k] = own[0][k] + own[1][k] + own[2][k] + move[k];
  }
  return t;
}

}  // namespace csgrun::test

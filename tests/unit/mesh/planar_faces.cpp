#include "tests/unit/mesh/planar_faces.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace csgrun::test {

int GridOracle::orient(uint32_t a, uint32_t b, uint32_t c) const {
  const int64_t value = cross(points_[a], points_[b], points_[c]);
  return (value > 0) - (value < 0);
}

int GridOracle::compare(uint32_t a, uint32_t b) const {
  const auto key = [&](uint32_t v) {
    const FlatPoint& p = points_[v];
    return std::pair(p[0] * first_[0] + p[1] * first_[1], p[0] * second_[0] + p[1] * second_[1]);
  };
  return key(a) < key(b) ? -1 : key(b) < key(a) ? 1 : 0;
}

double GridOracle::along(uint32_t a) const {
  return static_cast<double>(points_[a][0] * first_[0] + points_[a][1] * first_[1]);
}

int64_t twice_area(const std::vector<FlatLoop>& loops, const std::vector<FlatPoint>& points) {
  int64_t sum = 0;
  for (const FlatLoop& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint &a = points[loop[i]], &b = points[loop[(i + 1) % loop.size()]];
      sum += a[0] * b[1] - a[1] * b[0];
    }
  }
  return sum;
}

const char* fault(const std::vector<FlatLoop>& loops, const std::vector<FlatPoint>& points,
                  const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  int64_t area = 0;
  for (const auto& t : triangles) {
    const int64_t twice = cross(points[t[0]], points[t[1]], points[t[2]]);
    if (twice <= 0) return "a triangle is flat or turned over";
    area += twice;
    for (int i = 0; i < 3; ++i) {
      if (++balance[{t[i], t[(i + 1) % 3]}] > 1) return "a directed edge occurs twice";
    }
  }
  if (area != twice_area(loops, points)) return "the areas differ";
  for (const FlatLoop& loop : loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const auto edge = std::pair(loop[i], loop[(i + 1) % loop.size()]);
      if (balance[edge] != 1) return "an edge of a loop is missing";
      balance[edge] = 0;
    }
  }
  for (const auto& [edge, count] : balance) {
    if (count == 1) {
      const auto reverse = balance.find({edge.second, edge.first});
      if (reverse == balance.end() || reverse->second != 1) return "a diagonal has one side only";
    }
  }
  return nullptr;
}

namespace {

/// Links directed edges to loops; where several leave a vertex, one of them at random.
std::vector<FlatLoop> trace(const std::set<std::pair<uint32_t, uint32_t>>& edges,
                            std::mt19937& random) {
  std::map<uint32_t, std::vector<uint32_t>> out;
  for (const auto& [from, to] : edges) out[from].push_back(to);
  std::vector<FlatLoop> loops;
  for (auto& [start, targets] : out) {
    while (!targets.empty()) {
      FlatLoop loop;
      uint32_t at = start;
      do {
        loop.push_back(at);
        auto& choice = out[at];
        std::swap(choice[random() % choice.size()], choice.back());
        at = choice.back();
        choice.pop_back();
      } while (at != start);
      loops.push_back(std::move(loop));
    }
  }
  return loops;
}

}  // namespace

std::vector<std::array<uint32_t, 3>> random_triangulation(int n,
                                                          const std::vector<FlatPoint>& points,
                                                          int flips, std::mt19937& random) {
  std::vector<std::array<uint32_t, 3>> triangles;
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      const auto a = static_cast<uint32_t>(y * (n + 1) + x);
      const uint32_t b = a + 1, c = a + static_cast<uint32_t>(n) + 2, d = c - 1;
      if (random() % 2) {
        triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
      } else {
        triangles.push_back({a, b, d}), triangles.push_back({b, c, d});
      }
    }
  }
  std::map<std::pair<uint32_t, uint32_t>, size_t> owner;
  const auto enter = [&](size_t t) {
    for (int i = 0; i < 3; ++i) owner[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
  };
  for (size_t t = 0; t < triangles.size(); ++t) enter(t);
  for (int flip = 0; flip < flips; ++flip) {
    const size_t t = random() % triangles.size();
    const int i = static_cast<int>(random() % 3);
    const uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3],
                   c = triangles[t][(i + 2) % 3];
    const auto other = owner.find({b, a});
    if (other == owner.end()) continue;
    const size_t s = other->second;
    uint32_t d = 0;
    for (uint32_t v : triangles[s]) {
      if (v != a && v != b) d = v;
    }
    if (cross(points[a], points[d], points[c]) <= 0 ||
        cross(points[d], points[b], points[c]) <= 0) {
      continue;
    }
    owner.erase({a, b}), owner.erase({b, a});
    triangles[t] = {a, d, c}, triangles[s] = {d, b, c};
    enter(t), enter(s);
  }
  return triangles;
}

std::vector<FlatLoop> random_patch(const std::vector<std::array<uint32_t, 3>>& triangles,
                                   double density, std::mt19937& random) {
  std::map<std::pair<uint32_t, uint32_t>, size_t> owner;
  std::vector<bool> chosen(triangles.size());
  for (size_t t = 0; t < triangles.size(); ++t) {
    chosen[t] = static_cast<double>(random() % 1000) < density * 1000;
    for (int i = 0; i < 3; ++i) owner[{triangles[t][i], triangles[t][(i + 1) % 3]}] = t;
  }
  const size_t seed = random() % triangles.size();
  chosen[seed] = true;
  std::vector<bool> reached(triangles.size());
  std::vector<size_t> todo{seed};
  reached[seed] = true;
  std::set<std::pair<uint32_t, uint32_t>> boundary;
  while (!todo.empty()) {
    const size_t t = todo.back();
    todo.pop_back();
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      const auto other = owner.find({b, a});
      if (other == owner.end() || !chosen[other->second]) {
        boundary.insert({a, b});
      } else if (!reached[other->second]) {
        reached[other->second] = true;
        todo.push_back(other->second);
      }
    }
  }
  return trace(boundary, random);
}

std::vector<FlatPoint> grid_points(int n) {
  std::vector<FlatPoint> points;
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) points.push_back({x, y});
  }
  return points;
}

}  // namespace csgrun::test

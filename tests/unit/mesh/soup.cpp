#include "tests/unit/mesh/soup.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace csgrun::test {

PolygonMesh Soup::mesh() const {
  PolygonMesh result;
  result.points = points;
  for (const Face& face : faces) result.add_face(face);
  return result;
}

void Soup::add(const Soup& other) {
  const auto base = static_cast<uint32_t>(points.size());
  points.insert(points.end(), other.points.begin(), other.points.end());
  for (Face face : other.faces) {
    for (uint32_t& v : face) v += base;
    faces.push_back(face);
  }
}

void Soup::turn() {
  for (Face& face : faces) std::reverse(face.begin(), face.end());
}

Soup box(const glm::dvec3& lo, const glm::dvec3& hi) {
  Soup soup;
  for (int i = 0; i < 8; ++i) {
    soup.points.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  }
  soup.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}};
  return soup;
}

Soup cube() { return box({0, 0, 0}, {1, 1, 1}); }

Soup unwelded(const Soup& soup) {
  Soup result;
  for (const Face& face : soup.faces) {
    Face own;
    for (const uint32_t v : face) {
      own.push_back(static_cast<uint32_t>(result.points.size()));
      result.points.push_back(soup.points[v]);
    }
    result.faces.push_back(own);
  }
  return result;
}

Soup random_cells(Random& random, int size, int count, int64_t& volume) {
  std::set<std::array<int, 3>> cells{{size / 2, size / 2, size / 2}};
  std::array<int, 3> at = *cells.begin();
  for (int i = 0; i < count; ++i) {
    std::array<int, 3> next = at;
    next[random.integer(0, 2)] += random.integer(0, 1) == 0 ? 1 : -1;
    const bool inside =
        std::all_of(next.begin(), next.end(), [&](int c) { return c >= 0 && c < size; });
    if (inside) at = next;
    cells.insert(at);
  }
  volume = static_cast<int64_t>(cells.size());
  Soup soup;
  std::map<std::array<int, 3>, uint32_t> number;
  const auto point = [&](const std::array<int, 3>& p) {
    const auto [found, is_new] = number.emplace(p, static_cast<uint32_t>(soup.points.size()));
    if (is_new) soup.points.emplace_back(p[0], p[1], p[2]);
    return found->second;
  };
  for (const auto& cell : cells) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        std::array<int, 3> beyond = cell;
        beyond[axis] += side == 1 ? 1 : -1;
        if (cells.count(beyond) > 0) continue;
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::array<int, 3>, 4> q;
        for (int k = 0; k < 4; ++k) {
          q[k] = cell;
          q[k][axis] += side;
          q[k][u] += k == 1 || k == 2;
          q[k][v] += k >= 2;
        }
        Face face{point(q[0]), point(q[1]), point(q[2]), point(q[3])};
        if (side == 0) std::reverse(face.begin(), face.end());
        std::rotate(face.begin(), face.begin() + random.integer(0, 3), face.end());
        soup.faces.push_back({face[0], face[1], face[2]});
        soup.faces.push_back({face[0], face[2], face[3]});
      }
    }
  }
  return soup;
}

bool is_balanced(const PolygonMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  for (size_t l = 0; l < mesh.loop_count(); ++l) {
    const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
    for (uint32_t i = begin; i < end; ++i) {
      const uint32_t a = mesh.corners[i], b = mesh.corners[i + 1 < end ? i + 1 : begin];
      if (a == b) return false;
      balance[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& e) { return e.second == 0; });
}

std::vector<std::string> lines(const RepairReport& report) {
  std::vector<std::string> result;
  for (const RepairStep& step : report.steps) result.push_back(step.text());
  return result;
}

double repaired_volume(const Soup& soup, const RepairOptions& options, Lines* said) {
  RepairReport report;
  const Result<PolygonMesh> mesh = repair_mesh(soup.mesh(), options, &report);
  EXPECT_TRUE(mesh) << mesh.error().message;
  if (!mesh) return 0;
  EXPECT_TRUE(is_balanced(*mesh));
  if (said != nullptr) *said = lines(report);
  return signed_volume(*mesh);
}

std::string refusal(const Soup& soup, const RepairOptions& options) {
  const Result<PolygonMesh> mesh = repair_mesh(soup.mesh(), options, nullptr);
  EXPECT_FALSE(mesh);
  if (mesh) return {};
  EXPECT_EQ(mesh.error().code, ErrorCode::kInvalidMesh);
  return mesh.error().message;
}

RepairOptions filling() {
  RepairOptions options;
  options.fill_holes = true;
  return options;
}

}  // namespace csgrun::test

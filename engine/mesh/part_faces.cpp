#include "engine/mesh/part_faces.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/base/none.h"
#include "engine/bsp/union_find.h"

namespace csgrun {
namespace {

using Loop = std::vector<uint32_t>;

/// The triangles of one face: half-edge 3 t + k leaves corner k of its triangle t.
class FaceTriangles {
 public:
  FaceTriangles(const Solid& solid, size_t begin, size_t end)
      : solid_(solid), begin_(begin), twin_(3 * (end - begin), kNone) {
    struct Half {
      uint32_t lo, hi, number;
    };
    std::vector<Half> halves;
    for (uint32_t h = 0; h < twin_.size(); ++h) {
      const uint32_t a = from(h), b = from(next(h));
      halves.push_back({std::min(a, b), std::max(a, b), h});
    }
    std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) {
      return std::pair(a.lo, a.hi) < std::pair(b.lo, b.hi);
    });
    for (size_t i = 0; i + 1 < halves.size(); ++i) {
      if (halves[i].lo != halves[i + 1].lo || halves[i].hi != halves[i + 1].hi) continue;
      twin_[halves[i].number] = halves[i + 1].number;
      twin_[halves[i + 1].number] = halves[i].number;
    }
  }

  [[nodiscard]] size_t rim_size() const {
    return static_cast<size_t>(std::count(twin_.begin(), twin_.end(), kNone));
  }

  /// For each triangle the number of the part that it is of: triangles across edges are together.
  std::vector<uint32_t> find_parts(uint32_t& count) const {
    UnionFind together(twin_.size() / 3);
    for (uint32_t h = 0; h < twin_.size(); ++h) {
      if (twin_[h] != kNone) together.join(h / 3, twin_[h] / 3);
    }
    std::vector<uint32_t> number(together.size(), kNone), part(together.size());
    count = 0;
    for (uint32_t t = 0; t < part.size(); ++t) {
      uint32_t& own = number[together.find(t)];
      if (own == kNone) own = count++;
      part[t] = own;
    }
    return part;
  }

  /// The loops around each part, the outer one first; each begins with its lowest vertex.
  [[nodiscard]] std::vector<std::vector<Loop>> loops(const std::vector<uint32_t>& part,
                                                     uint32_t count,
                                                     const glm::dvec3& normal) const {
    std::vector<std::vector<Loop>> result(count);
    std::vector<bool> is_seen(twin_.size(), false);
    for (uint32_t start = 0; start < twin_.size(); ++start) {
      if (twin_[start] != kNone || is_seen[start]) continue;
      Loop loop;
      for (uint32_t h = start; !is_seen[h]; h = following(h)) {
        is_seen[h] = true;
        loop.push_back(from(h));
      }
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      result[part[start / 3]].push_back(std::move(loop));
    }
    for (std::vector<Loop>& own : result) {
      std::stable_sort(own.begin(), own.end(), [&](const Loop& a, const Loop& b) {
        return area(a, normal) > area(b, normal);  // holes have less than none
      });
    }
    return result;
  }

 private:
  [[nodiscard]] uint32_t from(uint32_t half) const {
    return solid_.triangles[begin_ + half / 3][half % 3];
  }
  static uint32_t next(uint32_t half) { return half % 3 == 2 ? half - 2 : half + 1; }
  /// The half-edge of the rim that goes on from one of them, around the triangles at its end.
  [[nodiscard]] uint32_t following(uint32_t half) const {
    uint32_t h = next(half);
    while (twin_[h] != kNone) h = next(twin_[h]);
    return h;
  }
  [[nodiscard]] double area(const Loop& loop, const glm::dvec3& normal) const {
    const glm::dvec3& origin = solid_.positions[loop[0]];
    glm::dvec3 sum(0);
    for (size_t i = 1; i + 1 < loop.size(); ++i) {
      sum += glm::cross(solid_.positions[loop[i]] - origin, solid_.positions[loop[i + 1]] - origin);
    }
    return glm::dot(sum, normal);
  }

  const Solid& solid_;
  const size_t begin_;
  std::vector<uint32_t> twin_;
};

/// The arrays of faces, put together anew.
class FaceArrays {
 public:
  void add(const Solid::Face& face, const glm::dvec3& normal) {
    faces.push_back(face);
    faces.back().first_loop = static_cast<uint32_t>(loop_starts.size() - 1);
    faces.back().loop_count = 0;
    normals.push_back(normal);
  }
  void add_loop(std::span<const uint32_t> vertices) {
    loop_vertices.insert(loop_vertices.end(), vertices.begin(), vertices.end());
    loop_starts.push_back(static_cast<uint32_t>(loop_vertices.size()));
    ++faces.back().loop_count;
  }

  std::vector<Solid::Face> faces;
  std::vector<glm::dvec3> normals;
  std::vector<uint32_t> loop_starts{0}, loop_vertices;
};

/// Puts the triangles of one face, from `begin` on, in the order of their parts, and the number of
/// that into their place of a face.
void sort_by_parts(Solid& solid, size_t begin, const std::vector<uint32_t>& part) {
  std::vector<uint32_t> order(part.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t t, uint32_t u) { return part[t] < part[u]; });
  std::vector<std::array<uint32_t, 3>> sorted;
  for (const uint32_t t : order) {
    solid.triangle_face[begin + sorted.size()] = part[t];
    sorted.push_back(solid.triangles[begin + t]);
  }
  std::copy(sorted.begin(), sorted.end(),
            solid.triangles.begin() + static_cast<std::ptrdiff_t>(begin));
}

}  // namespace

void part_faces(Solid& solid) {
  FaceArrays made;
  size_t begin = 0;
  for (uint32_t f = 0; f < solid.faces.size(); ++f) {
    size_t end = begin;
    while (end < solid.triangles.size() && solid.triangle_face[end] == f) ++end;
    const Solid::Face& face = solid.faces[f];
    const auto first = static_cast<uint32_t>(made.faces.size());
    const uint32_t last_loop = face.first_loop + face.loop_count;
    const size_t corners = solid.loop_starts[last_loop] - solid.loop_starts[face.first_loop];
    const FaceTriangles triangles(solid, begin, end);
    if (triangles.rim_size() == corners) {
      made.add(face, solid.face_normals[f]);
      for (uint32_t l = face.first_loop; l < last_loop; ++l) {
        made.add_loop(
            std::span(solid.loop_vertices)
                .subspan(solid.loop_starts[l], solid.loop_starts[l + 1] - solid.loop_starts[l]));
      }
      std::fill(solid.triangle_face.begin() + static_cast<std::ptrdiff_t>(begin),
                solid.triangle_face.begin() + static_cast<std::ptrdiff_t>(end), first);
    } else {
      uint32_t count = 0;
      const std::vector<uint32_t> part = triangles.find_parts(count);
      for (const std::vector<Loop>& loops : triangles.loops(part, count, solid.face_normals[f])) {
        made.add(face, solid.face_normals[f]);
        for (const Loop& loop : loops) made.add_loop(loop);
      }
      sort_by_parts(solid, begin, part);
      for (size_t t = begin; t < end; ++t) solid.triangle_face[t] += first;
    }
    begin = end;
  }
  solid.faces = std::move(made.faces);
  solid.face_normals = std::move(made.normals);
  solid.loop_starts = std::move(made.loop_starts);
  solid.loop_vertices = std::move(made.loop_vertices);
}

}  // namespace csgrun

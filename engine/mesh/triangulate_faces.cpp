#include "engine/mesh/triangulate_faces.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/bsp/point_view.h"
#include "engine/mesh/improve_triangles.h"
#include "engine/mesh/insert_points.h"
#include "engine/mesh/plane_oracle.h"
#include "engine/mesh/triangulate.h"

namespace csgrun {
namespace {

/// So many corners are triangulated by one thread, if they are not of one face.
constexpr size_t kCornersPerPart = 4096;

class FaceTriangulator {
 public:
  FaceTriangulator(const std::vector<MergedFace>& faces, const CellGeometry& geometry,
                   const PlaneTable& planes, size_t in_order)
      : faces_(faces), points_(geometry), planes_(planes), in_order_(in_order) {}

  Status add(uint32_t f, TriangleSet& set) {
    const MergedFace& face = faces_[f];
    if (face.loops.size() == 1 && face.loops[0].size() == 3 && !face.contacts) {
      add_triangle({face.loops[0][0].from, face.loops[0][1].from, face.loops[0][2].from}, f, set);
      return std::monostate();
    }
    loops_.resize(face.loops.size());
    for (size_t l = 0; l < loops_.size(); ++l) {
      loops_[l].clear();
      for (const DirectedEdge& e : face.loops[l]) loops_[l].push_back(e.from);
    }
    for (const auto& [p, q] : face.slits()) loops_.push_back({p, q});
    const PlaneOracle oracle(points_, planes_, face.plane, in_order_);
    if (auto status = triangulator_.face(loops_, oracle, triangles_); !status) return status;
    if (!insert_points(face.points(), oracle, triangles_)) {
      return Error{ErrorCode::kInternal, "the boundary of a result is not closed (contacts)", {}};
    }
    improve_triangles(loops_, oracle, position_, triangles_);
    for (const auto& t : triangles_) add_triangle(t, f, set);
    return std::monostate();
  }

 private:
  static void add_triangle(std::array<uint32_t, 3> t, uint32_t face, TriangleSet& set) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    set.triangles.push_back(t);
    set.face.push_back(face);
  }

  const std::vector<MergedFace>& faces_;
  PointView points_;
  const PlaneTable& planes_;
  size_t in_order_;
  const RoundedPosition position_ = [this](uint32_t p) -> const std::array<double, 3>& {
    return points_.rounded(p);
  };
  Triangulator triangulator_;
  // Of the face at hand.
  std::vector<std::vector<uint32_t>> loops_;
  std::vector<std::array<uint32_t, 3>> triangles_;
};

/// How many triangles a face has: a slit counts as a hole of two corners.
size_t triangle_count(const MergedFace& face) {
  size_t corners = 2 * face.slits().size();
  for (const auto& loop : face.loops) corners += loop.size();
  return corners - 2 + 2 * (face.loops.size() - 1 + face.slits().size() + face.points().size());
}

}  // namespace

Result<TriangleSet> triangulate_faces(const std::vector<MergedFace>& faces,
                                      const CellGeometry& geometry, const PlaneTable& planes,
                                      size_t in_order) {
  const std::vector<size_t> starts = part_starts(faces.size(), kCornersPerPart, [&](size_t f) {
    size_t corners = 0;
    for (const auto& loop : faces[f].loops) corners += loop.size();
    return corners;
  });
  const size_t parts = starts.size() - 1;
  std::vector<TriangleSet> sets(parts);
  std::vector<std::optional<Error>> errors(parts);
  for_each_alone(parts, true, [&](size_t part) {
    size_t count = 0;
    for (size_t f = starts[part]; f < starts[part + 1]; ++f) count += triangle_count(faces[f]);
    sets[part].triangles.reserve(count);
    sets[part].face.reserve(count);
    FaceTriangulator triangulator(faces, geometry, planes, in_order);
    for (size_t f = starts[part]; f < starts[part + 1] && !errors[part]; ++f) {
      if (auto status = triangulator.add(static_cast<uint32_t>(f), sets[part]); !status) {
        errors[part] = status.error();
      }
    }
  });
  for (const auto& error : errors) {
    if (error) return *error;
  }
  if (parts == 1) return std::move(sets[0]);
  TriangleSet all;
  for (const TriangleSet& set : sets) {
    all.triangles.insert(all.triangles.end(), set.triangles.begin(), set.triangles.end());
    all.face.insert(all.face.end(), set.face.begin(), set.face.end());
  }
  return all;
}

}  // namespace csgrun

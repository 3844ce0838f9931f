#include "engine/csg/flat_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "engine/bsp/union_find.h"
#include "engine/csg/leaf_faces.h"
#include "engine/mesh/opposite_edges.h"

namespace csgrun {
namespace {

/// The plane of a face in doubles, for telling what is clearly not in it.
class RoughPlane {
 public:
  RoughPlane(const IVec3& a, const IVec3& b, const IVec3& c) : point_(a) {
    for (size_t k = 0; k < 3; ++k) {
      const size_t i = (k + 1) % 3, j = (k + 2) % 3;
      const double left = difference(b[i], a[i]) * difference(c[j], a[j]),
                   right = difference(b[j], a[j]) * difference(c[i], a[i]);
      normal_[k] = left - right;
      size_[k] = std::fabs(left) + std::fabs(right);
    }
  }
  [[nodiscard]] bool is_clearly_off(const IVec3& p) const {
    double sum = 0, size = 0;
    for (size_t k = 0; k < 3; ++k) {
      const double d = difference(p[k], point_[k]);
      sum += normal_[k] * d;
      size += size_[k] * std::fabs(d);
    }
    // Differences are exact; two roundings make a component, four more the sum.
    return std::fabs(sum) > 0x1p-48 * size;
  }

 private:
  /// REQUIRES: coordinates below 2^52.
  static double difference(int64_t a, int64_t b) { return static_cast<double>(a - b); }

  IVec3 point_;
  std::array<double, 3> normal_{}, size_{};
};

class FaceJoiner {
 public:
  explicit FaceJoiner(LeafGeometry& leaf)
      : leaf_(leaf), face_of_(leaf.corners.size()), joined_(leaf.face_count()) {
    for (uint32_t f = 0; f < leaf.face_count(); ++f) {
      std::fill(face_of_.begin() + leaf.face_starts[f], face_of_.begin() + leaf.face_starts[f + 1],
                f);
    }
  }

  void run() {
    if (!join_neighbours()) return;
    trace_loops();
    write();
  }

 private:
  [[nodiscard]] uint32_t next(uint32_t edge) const {
    const uint32_t face = face_of_[edge];
    return edge + 1 < leaf_.face_starts[face + 1] ? edge + 1 : leaf_.face_starts[face];
  }
  [[nodiscard]] const IVec3& at(uint32_t corner) const {
    return leaf_.vertices[leaf_.corners[corner]];
  }

  /// Whether any faces are to be one.
  bool join_neighbours() {
    bool any = false;
    for (uint32_t f = 0; f < leaf_.face_count(); ++f) {
      const uint32_t begin = leaf_.face_starts[f], end = leaf_.face_starts[f + 1];
      const RoughPlane rough(at(begin), at(begin + 1), at(begin + 2));
      for (uint32_t edge = begin; edge < end; ++edge) {
        const uint32_t back = leaf_.opposite[edge];
        if (back < edge || rough.is_clearly_off(at(next(next(back))))) continue;
        const uint32_t other = face_of_[back];
        if (have_equal_labels(f, other) && are_coplanar(f, other)) {
          joined_.join(f, other);
          any = true;
        }
      }
    }
    return any;
  }

  [[nodiscard]] bool have_equal_labels(uint32_t f, uint32_t g) const {
    return leaf_.facet[f] == leaf_.facet[g] && leaf_.surface[f] == leaf_.surface[g] &&
           leaf_.appearance[f] == leaf_.appearance[g];
  }

  [[nodiscard]] bool are_coplanar(uint32_t f, uint32_t g) const {
    CornerPlane plane;
    const uint32_t begin = leaf_.face_starts[f];
    return corner_plane(leaf_.vertices, &leaf_.corners[begin], leaf_.face_starts[f + 1] - begin,
                        plane) &&
           std::all_of(leaf_.corners.begin() + leaf_.face_starts[g],
                       leaf_.corners.begin() + leaf_.face_starts[g + 1],
                       [&](uint32_t v) { return plane.side(leaf_.vertices[v]) == 0; });
  }

  /// The loops of faces that stay, and of those that are joined.
  void trace_loops() {
    std::vector<uint32_t> rim(leaf_.face_count(), 0);  // edges around the joined faces
    std::vector<uint32_t> start(leaf_.face_count(), 0);
    for (uint32_t edge = 0; edge < leaf_.corners.size(); ++edge) {
      const uint32_t f = joined_.find(face_of_[edge]);
      if (joined_.find(face_of_[leaf_.opposite[edge]]) == f) continue;
      ++rim[f];
      start[f] = edge;
    }
    std::vector<uint8_t> is_one(leaf_.face_count(), 0);
    std::vector<uint32_t> loop;
    faces_.reserve(leaf_.face_count());
    starts_.reserve(leaf_.face_starts.size());
    corners_.reserve(leaf_.corners.size());
    for (uint32_t f = 0; f < leaf_.face_count(); ++f) {
      const uint32_t first = joined_.find(f);
      if (first == f && rim[f] > 0) is_one[f] = trace(f, start[f], loop) && loop.size() == rim[f];
      if (!is_one[first]) {
        loop.assign(leaf_.corners.begin() + leaf_.face_starts[f],
                    leaf_.corners.begin() + leaf_.face_starts[f + 1]);
      } else if (first != f) {
        continue;
      }
      faces_.push_back(f);
      corners_.insert(corners_.end(), loop.begin(), loop.end());
      starts_.push_back(static_cast<uint32_t>(corners_.size()));
    }
  }

  /// Around joined faces; whether that is convex.
  bool trace(uint32_t face, uint32_t start, std::vector<uint32_t>& loop) {
    loop.clear();
    uint32_t edge = start;
    do {
      loop.push_back(leaf_.corners[edge]);
      edge = next(edge);
      while (joined_.find(face_of_[leaf_.opposite[edge]]) == face) {
        edge = next(leaf_.opposite[edge]);
      }
    } while (edge != start);
    return is_convex_polygon(leaf_.vertices, loop);
  }

  /// Corners of two faces only go: their edge runs straight on there.
  void write() {
    constexpr uint32_t kNew = UINT32_MAX;
    std::vector<uint32_t> faces_at(leaf_.vertices.size(), 0), number(leaf_.vertices.size(), kNew);
    for (const uint32_t v : corners_) ++faces_at[v];
    LeafGeometry made;
    made.vertices.reserve(leaf_.vertices.size());
    made.corners.reserve(corners_.size());
    made.face_starts.reserve(starts_.size());
    std::vector<uint32_t> facet, surface, appearance;
    for (std::vector<uint32_t>* each : {&facet, &surface, &appearance}) {
      each->reserve(faces_.size());
    }
    for (size_t i = 0; i < faces_.size(); ++i) {
      for (uint32_t c = starts_[i]; c < starts_[i + 1]; ++c) {
        const uint32_t v = corners_[c];
        if (faces_at[v] == 2) continue;
        if (number[v] == kNew) {
          number[v] = static_cast<uint32_t>(made.vertices.size());
          made.vertices.push_back(leaf_.vertices[v]);
        }
        made.corners.push_back(number[v]);
      }
      made.face_starts.push_back(static_cast<uint32_t>(made.corners.size()));
      facet.push_back(leaf_.facet[faces_[i]]);
      surface.push_back(leaf_.surface[faces_[i]]);
      appearance.push_back(leaf_.appearance[faces_[i]]);
    }
    made.facet = std::move(facet);
    made.surface = std::move(surface);
    made.appearance = std::move(appearance);
    made.opposite = pair_edges(made).opposite;
    made.convex = leaf_.convex;
    made.has_single_fans = leaf_.has_single_fans;
    made.may_touch = leaf_.may_touch;
    leaf_ = std::move(made);
  }

  LeafGeometry& leaf_;
  std::vector<uint32_t> face_of_;  ///< per edge
  UnionFind joined_;
  std::vector<uint32_t> faces_, corners_, starts_{0};  ///< what is left: first face and loop
};

}  // namespace

void join_flat_faces(LeafGeometry& leaf) { FaceJoiner(leaf).run(); }

}  // namespace csgrun

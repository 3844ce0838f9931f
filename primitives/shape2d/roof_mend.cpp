#include "primitives/shape2d/roof_mend.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "primitives/solids/mesh_builder.h"

namespace csgrun {
namespace {

using FaceLoop = std::vector<uint32_t>;

class Mender {
 public:
  Mender(const PolygonMesh& mesh, size_t fixed_points, size_t fixed_faces, double width)
      : mesh_(mesh), fixed_points_(fixed_points), fixed_faces_(fixed_faces), width_(width) {
    for (size_t f = 0; f < mesh.face_count(); ++f) {
      std::vector<FaceLoop>& loops = faces_.emplace_back();
      for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
        const auto begin = mesh.corners.begin();
        loops.emplace_back(begin + mesh.loop_starts[l], begin + mesh.loop_starts[l + 1]);
      }
    }
  }

  PolygonMesh mended() {
    contract_edges();
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      for (const FaceLoop& loop : faces_[f]) {
        for (size_t i = 0; i < loop.size(); ++i) face_of_[{loop[i], after(loop, i)}] = f;
      }
    }
    for (size_t f = fixed_faces_; f < faces_.size(); ++f) drop_.push_back(static_cast<uint32_t>(f));
    // A corner may be handed back and forth where everything is thin; that ends unmended.
    budget_ = 4 * faces_.size();
    while (!drop_.empty()) {
      const uint32_t face = drop_.back();
      drop_.pop_back();
      drop_tails(face);
    }
    return made();
  }

 private:
  static uint32_t after(const FaceLoop& loop, size_t i) {
    return loop[i + 1 < loop.size() ? i + 1 : 0];
  }
  static uint32_t before(const FaceLoop& loop, size_t i) {
    return loop[i > 0 ? i - 1 : loop.size() - 1];
  }

  void contract_edges() {
    std::vector<uint32_t> into(mesh_.points.size());
    std::iota(into.begin(), into.end(), 0);
    const auto find = [&](uint32_t p) {
      while (into[p] != p) p = into[p] = into[into[p]];
      return p;
    };
    for (const std::vector<FaceLoop>& loops : faces_) {
      for (const FaceLoop& loop : loops) {
        for (size_t i = 0; i < loop.size(); ++i) {
          const auto [p, q] = std::minmax({find(loop[i]), find(after(loop, i))});
          const glm::dvec3 r = mesh_.points[p] - mesh_.points[q];
          if (q >= fixed_points_ && glm::dot(r, r) < width_ * width_) into[q] = p;
        }
      }
    }
    for (std::vector<FaceLoop>& loops : faces_) {
      for (FaceLoop& loop : loops) {
        for (uint32_t& p : loop) p = find(p);
        loop.erase(std::unique(loop.begin(), loop.end()), loop.end());
        while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
        if (loop.size() < 3) loop.clear();
      }
    }
  }

  /// Whether p is as good as on the segment from a to b.
  [[nodiscard]] bool is_on(uint32_t p, uint32_t a, uint32_t b) const {
    const glm::dvec3 d = mesh_.points[b] - mesh_.points[a], r = mesh_.points[p] - mesh_.points[a];
    const double part = glm::dot(r, d) / glm::dot(d, d);
    const glm::dvec3 off = r - part * d;
    return part >= 0 && part <= 1 && glm::dot(off, off) < width_ * width_;
  }

  /// Puts p between a and b in the face that goes from a to b.
  bool insert(uint32_t p, uint32_t a, uint32_t b) {
    const auto found = face_of_.find({a, b});
    if (found == face_of_.end() || found->second < fixed_faces_) return false;
    const uint32_t face = found->second;
    FaceLoop& loop = faces_[face][0];
    if (std::find(loop.begin(), loop.end(), p) != loop.end()) return false;
    for (size_t i = 0; i < loop.size(); ++i) {
      if (loop[i] != a || after(loop, i) != b) continue;
      loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, p);
      face_of_.erase(found);
      face_of_[{a, p}] = face;
      face_of_[{p, b}] = face;
      return true;
    }
    return false;
  }

  /// An edge that the face has no more; another may have it by now.
  void forget(uint32_t a, uint32_t b, uint32_t face) {
    const auto found = face_of_.find({a, b});
    if (found != face_of_.end() && found->second == face) face_of_.erase(found);
  }

  /// A corner where a face turns back on itself is the end of a tail.
  void drop_tails(uint32_t face) {
    FaceLoop& loop = faces_[face][0];
    for (size_t i = 0; loop.size() >= 3 && i < loop.size(); ++i) {
      const uint32_t a = before(loop, i), b = loop[i], c = after(loop, i);
      const glm::dvec3 in = mesh_.points[b] - mesh_.points[a],
                       out = mesh_.points[c] - mesh_.points[b];
      if (!(glm::dot(in, out) < 0)) continue;
      // The face on the other side of the longer edge gets the end of the shorter one.
      const bool on_out = is_on(a, b, c);
      if (!on_out && !is_on(c, a, b)) continue;
      // An edge from a to c that is there already must not be there twice; of a triangle it goes.
      if (loop.size() > 3 && (face_of_.count({a, c}) != 0 || face_of_.count({c, a}) != 0)) continue;
      if (budget_ == 0) return;
      --budget_;
      const std::pair<uint32_t, uint32_t> far = on_out ? std::pair{c, b} : std::pair{b, a};
      const auto neighbour = face_of_.find(far);
      if (neighbour == face_of_.end()) continue;
      const uint32_t other = neighbour->second;
      if (!insert(on_out ? a : c, far.first, far.second)) continue;
      forget(a, b, face);
      forget(b, c, face);
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      if (loop.size() < 3) {  // what was on its third side now borders on `other`
        forget(c, a, face);
        loop.clear();
      } else {
        face_of_[{a, c}] = face;
      }
      drop_.push_back(other);
      i = static_cast<size_t>(-1);  // from the start
    }
  }

  [[nodiscard]] PolygonMesh made() const {
    constexpr uint32_t kUnused = 0xffffffff;
    PolygonMesh mesh;
    mesh.kind = mesh_.kind;
    std::vector<uint32_t> number(mesh_.points.size(), kUnused);
    for (size_t f = 0; f < faces_.size(); ++f) {
      std::vector<FaceLoop> loops;
      for (const FaceLoop& loop : faces_[f]) {
        if (loop.size() < 3) continue;
        FaceLoop& numbered = loops.emplace_back();
        for (const uint32_t p : loop) {
          if (number[p] == kUnused) {
            number[p] = static_cast<uint32_t>(mesh.points.size());
            mesh.points.push_back(mesh_.points[p]);
          }
          numbered.push_back(number[p]);
        }
      }
      if (!loops.empty()) add_face_with_holes(mesh, loops, mesh_.surface[f]);
    }
    return mesh;
  }

  const PolygonMesh& mesh_;
  size_t fixed_points_, fixed_faces_;
  double width_;
  std::vector<std::vector<FaceLoop>> faces_;
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> face_of_;  ///< by directed edge
  std::vector<uint32_t> drop_;                                 ///< faces to look at
  size_t budget_ = 0;                                          ///< tails that may still be dropped
};

}  // namespace

void mend_thin_parts(PolygonMesh& mesh, size_t fixed_points, size_t fixed_faces, double width) {
  mesh = Mender(mesh, fixed_points, fixed_faces, width).mended();
}

}  // namespace csgrun

#include "engine/bsp/rim_faces.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>

#include "engine/base/parallel.h"
#include "engine/bsp/corner_walk.h"

namespace csgrun {
namespace {

class RimFaces {
 public:
  /// `is_free`: per vertex, what any of several finds out.
  RimFaces(const Job& job, const ContactTable& contacts, const CellGeometry& geometry,
           const TouchFinder& finder, std::vector<uint8_t>& is_free)
      : job_(job), contacts_(contacts), geometry_(geometry), finder_(finder), is_free_(is_free) {}

  /// Whether a polygon that is met is as good as untouched.
  bool is_rim(uint32_t polygon) {
    const JobPolygon& p = job_.polygons()[polygon];
    if (p.count != 3 || !job_.is_convex(p.operand)) return false;
    if (contacts_.is_in_flat_corner(polygon)) return false;
    const LeafGeometry& leaf = *job_.leaf(p.operand);
    // Facets that are kept may be merged with neighbours in their plane once they are touched.
    if (leaf.keeps_facets() || leaf.opposite.empty()) return false;
    for (const uint32_t i : contacts_.of(polygon)) {
      if (!ends_in_corners(contacts_[i], contacts_[i].p == polygon)) return false;
    }
    for (const uint32_t v : job_.corners(p)) {
      if (contacts_.touched()[v] && !is_free(v, p, leaf)) return false;
    }
    return true;
  }

 private:
  enum State : uint8_t { kUnknown = 0, kFree, kBound };

  /// Whether all that two polygons have in common is a corner or an edge of one of them.
  static bool ends_in_corners(const Contact& c, bool of_p) {
    const auto is_corner = [&](const Contact::End& end) {
      return end.on_p == of_p && end.vertex != kNone;
    };
    return !c.is_coplanar && is_corner(c.lower) && is_corner(c.upper);
  }

  bool is_free(uint32_t v, const JobPolygon& p, const LeafGeometry& leaf) {
    const std::atomic_ref<uint8_t> shared(is_free_[v]);
    uint8_t state = shared.load(std::memory_order_relaxed);
    if (state == kUnknown) {
      const bool is_beside_cuts =
          finder_.operand_beside_cuts(geometry_.made_vertex_point(v)) == p.operand;
      state = is_beside_cuts && !has_straight_edges(v, p, leaf) ? kFree : kBound;
      shared.store(state, std::memory_order_relaxed);
    }
    return state == kFree;
  }

  /// Whether two edges of the leaf at a corner of a face lead straight on; also where there are too
  /// many to compare.
  bool has_straight_edges(uint32_t v, const JobPolygon& p, const LeafGeometry& leaf) {
    if (walked_ != p.operand) {
      walk_ = std::make_unique<CornerWalk>(leaf);
      walked_ = p.operand;
    }
    const uint32_t local = v - job_.vertex_start(p.operand);
    uint32_t corner = leaf.face_starts[p.face];
    while (leaf.corners[corner] != local) ++corner;
    std::array<IVec3, 16> edges;
    size_t count = 0;
    bool are_few = true;
    walk_->each_in_fan(corner, [&](uint32_t c) {
      are_few = are_few && count < edges.size();
      if (!are_few) return;
      const IVec3 &from = leaf.vertices[local], &to = leaf.vertices[leaf.corners[walk_->before(c)]];
      for (size_t k = 0; k < 3; ++k) edges[count][k] = to[k] - from[k];
      ++count;
    });
    if (!are_few) return true;
    for (size_t i = 0; i < count; ++i) {
      for (size_t j = i + 1; j < count; ++j) {
        if (are_opposite(edges[i], edges[j])) return true;
      }
    }
    return false;
  }

  static bool are_opposite(const IVec3& a, const IVec3& b) {
    for (size_t k = 0; k < 3; ++k) {
      if ((a[k] > 0 && b[k] > 0) || (a[k] < 0 && b[k] < 0)) return false;
    }
    const auto product = [](int64_t x, int64_t y) { return static_cast<Int128>(x) * y; };
    for (size_t k = 0; k < 3; ++k) {
      const size_t i = (k + 1) % 3, j = (k + 2) % 3;
      if (product(a[i], b[j]) != product(a[j], b[i])) return false;
    }
    return true;
  }

  const Job& job_;
  const ContactTable& contacts_;
  const CellGeometry& geometry_;
  const TouchFinder& finder_;
  std::vector<uint8_t>& is_free_;  ///< per vertex, a State
  std::unique_ptr<CornerWalk> walk_;
  uint32_t walked_ = kNone;  ///< the operand that it is on
};

}  // namespace

void release_rims(const Job& job, const ContactTable& contacts, const CellGeometry& geometry,
                  const TouchFinder& finder, std::vector<WholePolygon>& whole) {
  if (!finder.has_examined()) return;
  constexpr size_t kPolygonsPerPart = 2048;
  std::vector<uint8_t> is_free(job.vertex_count(), 0);
  for_each_part(whole.size(), kPolygonsPerPart, [&](size_t, size_t begin, size_t end) {
    RimFaces faces(job, contacts, geometry, finder, is_free);
    for (size_t i = begin; i < end; ++i) {
      if (whole[i].is_met && faces.is_rim(whole[i].polygon)) whole[i].is_met = false;
    }
  });
}

}  // namespace csgrun

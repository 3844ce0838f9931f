#include "engine/bsp/kept_loops.h"

#include <atomic>
#include <span>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"

namespace csgrun {
namespace {

/// So many cut faces, and loops of them, are looked at by one thread.
constexpr size_t kCutFacesPerPart = 2048, kLoopsPerPart = 4096;

class LoopEmitter {
 public:
  LoopEmitter(Job& job, const CellGeometry& geometry, const CutFaces& cut, const PatchFates& fates)
      : job_(job), geometry_(geometry), cut_(cut), fates_(fates) {}

  FragmentSet run() {
    list_kept();
    make_edge_planes();
    list_pieces();
    number_points();
    out_.corner_plane.resize(out_.corner_point.size());
    each_kept([&](size_t i) { fill(kept_[i], out_.pieces[i]); });
    return std::move(out_);
  }

 private:
  struct Kept {
    const CutLoops::Loop* loop;
    uint32_t polygon;
    bool is_flipped;
  };

  /// Calls visit(loop, polygon, fate) for the loops of faces [begin, end) that are not dropped.
  template <class Visit>
  void each_loop(size_t begin, size_t end, Visit&& visit) const {
    for (size_t f = begin; f < end; ++f) {
      const CutFaces::Face& cut = cut_.faces[f];
      for (uint32_t l = cut.first_loop; l < cut.end_loop; ++l) {
        const PatchFate fate = fates_.of_loop(l);
        if (fate != PatchFate::kDrop) visit(cut_.loops.loops[l], cut.polygon, fate);
      }
    }
  }

  /// Calls visit(i) for all that are kept, in any order and at the same time.
  template <class Visit>
  void each_kept(Visit&& visit) const {
    for_each_part(kept_.size(), kLoopsPerPart, [&](size_t, size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) visit(i);
    });
  }

  void list_kept() {
    const auto list = [&](size_t begin, size_t end, std::vector<Kept>& out) {
      each_loop(begin, end, [&](const CutLoops::Loop& loop, uint32_t polygon, PatchFate fate) {
        if (!loop.is_rim) out.push_back({&loop, polygon, fate == PatchFate::kFlip});
      });
    };
    kept_ = list_in_parts<Kept>(cut_.faces.size(), kCutFacesPerPart, list);
  }

  void make_edge_planes() {
    const auto list = [&](size_t begin, size_t end, std::vector<PolygonEdge>& edges) {
      each_loop(begin, end, [&](const CutLoops::Loop& loop, uint32_t polygon, PatchFate) {
        for (const uint32_t plane : cut_.loops.planes(loop)) {
          if (plane & CutLoops::kOwnEdge) edges.push_back({polygon, plane & ~CutLoops::kOwnEdge});
        }
      });
    };
    job_.ensure_edges(list_in_parts<PolygonEdge>(cut_.faces.size(), kCutFacesPerPart, list));
  }

  void list_pieces() {
    out_.pieces.reserve(kept_.size());
    uint32_t corners = 0;
    for (const Kept& k : kept_) {
      const uint32_t count = k.loop->corner_count;
      out_.pieces.push_back(
          {job_.polygons()[k.polygon].support, k.polygon, corners, count, k.loop->is_loose});
      corners += count;
    }
    out_.corner_point.resize(corners);
  }

  /// Lists the points of the loops, in the order of the geometry.
  void number_points() {
    std::vector<uint8_t> is_used(geometry_.point_count(), 0);
    each_kept([&](size_t i) {
      for (const uint32_t p : cut_.loops.points(*kept_[i].loop)) {
        std::atomic_ref(is_used[p]).store(1, std::memory_order_relaxed);
      }
    });
    const auto used = numbers_where(is_used.size(), [&](uint32_t p) { return is_used[p] != 0; });
    number_.resize(geometry_.point_count());
    out_.points.resize(used.size());
    for_each_range(used.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const auto& s = geometry_.point(used[i]);
        out_.points[i] = {s.rounded, s.planes, s.vertex};
        number_[used[i]] = static_cast<uint32_t>(i);
      }
    });
  }

  /// Sets the corners of a piece, and turns it over.
  void fill(const Kept& kept, FragmentSet::Piece& piece) {
    const std::span<const uint32_t> points = cut_.loops.points(*kept.loop),
                                    planes = cut_.loops.planes(*kept.loop);
    const std::span<const uint32_t> own = job_.edge_planes(job_.polygons()[kept.polygon]);
    for (uint32_t c = 0; c < piece.count; ++c) {
      const uint32_t plane = planes[c];
      out_.corner_point[piece.first + c] = number_[points[c]];
      out_.corner_plane[piece.first + c] =
          plane & CutLoops::kOwnEdge ? own[plane & ~CutLoops::kOwnEdge] : plane;
    }
    if (kept.is_flipped) out_.flip(piece);
  }

  Job& job_;
  const CellGeometry& geometry_;
  const CutFaces& cut_;
  const PatchFates& fates_;
  std::vector<Kept> kept_;
  RawVector<uint32_t> number_;  ///< of the geometry's points in the result
  FragmentSet out_;
};

}  // namespace

FragmentSet emit_loops(Job& job, const CellGeometry& geometry, const CutFaces& cut,
                       const PatchFates& fates) {
  return LoopEmitter(job, geometry, cut, fates).run();
}

}  // namespace csgrun

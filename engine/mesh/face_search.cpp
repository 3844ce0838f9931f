#include "engine/mesh/face_search.h"

#include <algorithm>
#include <numeric>

namespace csgrun {
namespace {

/// All edges of a face are looked at where there are so many at most.
constexpr size_t kFew = 16;

std::vector<DirectedEdge> edges_of(const MergedFace& face) {
  std::vector<DirectedEdge> edges;
  for (const auto& loop : face.loops) edges.insert(edges.end(), loop.begin(), loop.end());
  return edges;
}

std::vector<Box> boxes_of(std::span<const DirectedEdge> edges, const CellGeometry& geometry) {
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (const DirectedEdge& e : edges) boxes.push_back(box_of(e, geometry));
  return boxes;
}

/// Whether two edges have the same ends.
bool are_alike(const DirectedEdge& e, const DirectedEdge& r) {
  return (r.from == e.from && r.to == e.to) || (r.from == e.to && r.to == e.from);
}

}  // namespace

Box box_of(const DirectedEdge& e, const CellGeometry& geometry) {
  const auto &p = geometry.point(e.from).rounded, &q = geometry.point(e.to).rounded;
  Box box{p, p};
  box.include({q, q});
  return box;
}

FaceSearch::Large::Large(const MergedFace& face, const CellGeometry& geometry)
    : edges(edges_of(face)),
      by_start(edges.size()),
      boxes(boxes_of(edges, geometry)),
      around(boxes[0]),
      tree(boxes) {
  for (const Box& box : boxes) around.include(box);
  for (const auto& loop : face.loops) {
    const auto first = static_cast<uint32_t>(before.size());
    const auto count = static_cast<uint32_t>(loop.size());
    for (uint32_t i = 0; i < count; ++i) before.push_back(first + (i + count - 1) % count);
  }
  std::iota(by_start.begin(), by_start.end(), 0);
  std::sort(by_start.begin(), by_start.end(), [&](uint32_t a, uint32_t b) {
    return edges[a].from != edges[b].from ? edges[a].from < edges[b].from : a < b;
  });
}

std::span<const uint32_t> FaceSearch::Large::starting_at(uint32_t point) const {
  const auto first = std::lower_bound(by_start.begin(), by_start.end(), point,
                                      [&](uint32_t e, uint32_t p) { return edges[e].from < p; });
  auto last = first;
  while (last != by_start.end() && edges[*last].from == point) ++last;
  return {first, last};
}

const FaceSearch::Large* FaceSearch::large(uint32_t face) {
  if (!large_[face]) {
    size_t count = 0;
    for (const auto& loop : faces_[face].loops) count += loop.size();
    if (count <= kFew) return nullptr;
    large_[face] = std::make_unique<Large>(faces_[face], geometry_);
  }
  return large_[face].get();
}

void FaceSearch::forget() {
  for (auto& large : large_) large.reset();
}

int FaceSearch::locate(uint32_t face, uint32_t p) {
  FaceLocator locator(faces_[face].plane, points_, planes_);
  const Large* const many = large(face);
  if (!many) return locator.locate(faces_[face].loops, p);
  // A ray along the shorter side of the face has few edges beside it, and meets no others.
  const auto& at = geometry_.point(p).rounded;
  const auto width = [&](int axis) { return many->around.hi[axis] - many->around.lo[axis]; };
  if (const auto [first, second] = locator.axes(); width(second) < width(first)) {
    locator.swap_axes();
  }
  const auto [u, v] = locator.axes();
  const int w = 3 - u - v;
  Box band{at, at};
  band.lo[u] = many->around.lo[u];
  band.lo[w] = many->around.lo[w];
  band.hi[w] = many->around.hi[w];
  band_[0].clear();
  many->tree.visit_all(band, [&](uint32_t e) { band_[0].push_back(many->edges[e]); });
  return locator.locate(band_, p);
}

bool FaceSearch::runs_inside(uint32_t face, const DirectedEdge& e) {
  if (is_rim(face, e)) return false;
  const int from = locate(face, e.from);
  if (from != 0) return from > 0;
  const int to = locate(face, e.to);
  if (to != 0) return to > 0;
  return starts_inside(face, e);
}

bool FaceSearch::is_rim(uint32_t face, const DirectedEdge& e) {
  if (const Large* const many = large(face)) {
    const auto is_one = [&](uint32_t point) {
      const auto starting = many->starting_at(point);
      return std::any_of(starting.begin(), starting.end(),
                         [&](uint32_t r) { return are_alike(e, many->edges[r]); });
    };
    return is_one(e.from) || is_one(e.to);
  }
  const auto& loops = faces_[face].loops;
  return std::any_of(loops.begin(), loops.end(), [&](const auto& loop) {
    return std::any_of(loop.begin(), loop.end(),
                       [&](const DirectedEdge& r) { return are_alike(e, r); });
  });
}

bool FaceSearch::starts_inside(uint32_t face, const DirectedEdge& e) {
  FaceLocator locator(faces_[face].plane, points_, planes_);
  const Large* const many = large(face);
  if (!many) return locator.starts_inside(faces_[face].loops, e);
  const auto starting = many->starting_at(e.from);
  return std::any_of(starting.begin(), starting.end(), [&](uint32_t leaving) {
    return locator.is_in_wedge(many->edges[many->before[leaving]], many->edges[leaving], e);
  });
}

void FaceSearch::find(uint32_t face, const Box& box, std::vector<DirectedEdge>& found) {
  if (const Large* const many = large(face)) {
    met_.clear();
    many->tree.visit_all(box, [&](uint32_t e) { met_.push_back(e); });
    std::sort(met_.begin(), met_.end());
    for (const uint32_t e : met_) found.push_back(many->edges[e]);
    return;
  }
  for (const auto& loop : faces_[face].loops) {
    for (const DirectedEdge& e : loop) {
      if (box_of(e, geometry_).overlaps(box)) found.push_back(e);
    }
  }
}

}  // namespace csgrun

#include "engine/bsp/region_parts.h"

namespace csgrun {

PieceStore::Parts RegionParts::of(uint32_t region) {
  if (!store_.region(region).parts.were_made()) make(region);
  return store_.region(region).parts;
}

uint32_t RegionParts::point_of(uint32_t stored) {
  uint32_t& number = store_.scratch()[stored];
  if (number == kNone) {
    number = geometry_.add_point(store_.point_planes(stored), store_.rounded(stored),
                                 store_.is_on_grid(stored));
    stored_.push_back(stored);
  }
  return number;
}

void RegionParts::make(uint32_t region) {
  geometry_.clear();
  stored_.clear();
  const auto corners = store_.corners(region), edges = store_.edges(region);
  std::vector<BoundaryEdge> boundary;
  boundary.reserve(corners.size());
  store_.each_loop(region, [&](uint32_t begin, uint32_t end) {
    for (uint32_t i = begin; i < end; ++i) {
      boundary.push_back(
          {point_of(corners[i]), point_of(corners[i + 1 < end ? i + 1 : begin]), edges[i]});
    }
  });
  PieceStore::Piece part = store_.piece(region);
  part.region = kNone;
  const PieceStore::Region known = store_.region(region);
  std::vector<uint32_t> cell_points, cell_edges;
  cell_points.reserve(known.cell_count);
  cell_edges.reserve(known.cell_count);
  for (uint32_t i = known.first_cell; i < known.first_cell + known.cell_count; ++i) {
    cell_points.push_back(point_of(store_.corners()[i]));
    cell_edges.push_back(store_.edges()[i]);
  }
  for (const uint32_t p : stored_) store_.scratch()[p] = kNone;
  fragments_.clear();
  convexify_within(geometry_, store_.planes,
                   geometry_.make_fragment(part.support, cell_points, cell_edges), boundary, wall_,
                   fragments_);
  stored_.resize(geometry_.point_count(), kNone);
  const uint32_t first_part = store_.piece_count();
  for (const Fragment& f : fragments_) {
    part.first = static_cast<uint32_t>(store_.corners().size());
    part.count = f.count;
    for (uint32_t i = 0; i < f.count; ++i) {
      const uint32_t p = geometry_.corners(f)[i];
      const auto& made = geometry_.point(p);
      if (stored_[p] == kNone) stored_[p] = store_.add_point(made.planes, made.rounded);
      store_.corners().push_back(stored_[p]);
      store_.edges().push_back(geometry_.edges(f)[i]);
    }
    store_.add_piece(part);
  }
  store_.region(region).parts = {first_part, store_.piece_count() - first_part};
}

}  // namespace csgrun

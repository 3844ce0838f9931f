#include "engine/bsp/vertex_signs.h"

#include "engine/bsp/piece_store.h"

namespace csgrun {

VertexSigns::VertexSigns(const Job& job, bool whole_results) : errors_(job.operand_count(), 0) {
  for (uint32_t o = 0; o < job.operand_count(); ++o) {
    const PieceOperand* const whole = whole_results ? job.pieces(o) : nullptr;
    if (!whole && job.has_grid_vertices(o)) continue;
    double largest = 0;
    if (whole) {
      const PieceBox box = whole->pieces.box();
      for (size_t k = 0; k < 3; ++k) {
        largest = std::max({largest, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
      }
    }
    for (uint32_t v = job.vertex_start(o); v < job.vertex_start(o + 1); ++v) {
      for (const double c : job.rounded(v)) largest = std::max(largest, std::fabs(c));
    }
    errors_[o] = largest * 0x1p-53;  // rounded correctly
  }
}

}  // namespace csgrun

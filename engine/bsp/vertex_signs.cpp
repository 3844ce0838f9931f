#include "engine/bsp/vertex_signs.h"

#include "engine/bsp/piece_store.h"

namespace csgrun {

VertexSigns::VertexSigns(const Job& job) : errors_(job.operand_count(), 0) {
  for (uint32_t o = 0; o < job.operand_count(); ++o) {
    if (job.has_grid_vertices(o)) continue;
    double largest = 0;
    if (const PieceOperand* all = job.pieces(o)) {  // rays meet others than the job has
      const PieceBox box = all->pieces.box();
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

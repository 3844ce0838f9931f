#include "engine/bsp/kernel.h"

#include <utility>

#include "engine/bsp/assemble.h"
#include "engine/bsp/evaluate_boxes.h"
#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/untouched.h"

namespace csgrun {

Result<std::shared_ptr<const BoundaryMesh>> evaluate_boolean(const std::vector<Operand>& operands,
                                                             const Expression& expression,
                                                             const GridBox& region,
                                                             const KernelOptions& options,
                                                             EvaluateStats& stats) {
  if (options.whole_faces && !options.literal_cells) {
    if (auto boxes = evaluate_boxes(operands, expression, options, stats)) {
      if (!*boxes) return boxes->error();
      keep_few((**boxes)->touches);
      return std::shared_ptr<const BoundaryMesh>(std::move(**boxes));
    }
  }
  Job job(operands);
  auto evaluated = evaluate_job(job, operands, expression, region, options, stats);
  if (!evaluated) return evaluated.error();
  std::vector<UntouchedPart> parts;
  if (options.name_untouched) parts = take_untouched(job, operands, evaluated->whole);
  return assemble(job, evaluated->sets, evaluated->whole, std::move(evaluated->touching),
                  std::move(parts));
}

}  // namespace csgrun

#include "engine/bsp/kernel.h"

#include <algorithm>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/bsp/assemble.h"
#include "engine/bsp/evaluate_boxes.h"
#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/touch_list.h"
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
  using Outcome = Result<std::shared_ptr<const BoundaryMesh>>;
  size_t faces = 0;
  for (const Operand& operand : operands) faces += operand.leaf ? operand.leaf->face_count() : 0;
  const auto evaluate = [&]() -> Outcome {
    Job job(operands);
    auto evaluated = evaluate_job(job, operands, expression, region, options, stats);
    if (!evaluated) return evaluated.error();
    std::vector<UntouchedPart> parts;
    if (options.name_untouched) parts = take_untouched(job, operands, evaluated->whole);
    return assemble(job, evaluated->sets, evaluated->whole, std::move(evaluated->touching),
                    std::move(parts));
  };
  return faces > kFewForThreads ? with_threads(std::max(1u, options.threads), evaluate)
                                : evaluate();
}

}  // namespace csgrun

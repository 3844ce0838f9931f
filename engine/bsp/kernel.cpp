#include "engine/bsp/kernel.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/bsp/assemble.h"
#include "engine/bsp/evaluate_boxes.h"
#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/live_faces.h"
#include "engine/bsp/near_faces.h"
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
  if (!std::all_of(operands.begin(), operands.end(), can_stand_named)) {
    return evaluate_boolean(with_standing_parts(operands), expression, region, options, stats);
  }
  using Outcome = Result<std::shared_ptr<const BoundaryMesh>>;
  size_t faces = 0;
  for (const Operand& operand : operands) faces += operand.leaf ? operand.leaf->face_count() : 0;
  const auto assembled = [&](Job& job, EvaluatedJob&& evaluated) {
    std::vector<UntouchedPart> parts;
    if (options.name_untouched) {
      parts = take_untouched(job, operands, evaluated.far, evaluated.whole);
    }
    return assemble(job, evaluated.sets, evaluated.whole, std::move(evaluated.touching),
                    std::move(parts));
  };
  // With the faces that matter alone, if that does.
  const auto evaluate_some = [&](const auto& some) -> std::optional<Outcome> {
    if (!some) return std::nullopt;
    Job job(operands, *some);
    EvaluateStats own = stats;
    auto evaluated = evaluate_job(job, operands, expression, region, options, own);
    if (evaluated && evaluated->needs_all_faces) return std::nullopt;
    stats = own;
    if (!evaluated) return evaluated.error();
    return assembled(job, std::move(*evaluated));
  };
  const auto evaluate = [&]() -> Outcome {
    if (options.whole_faces && !options.literal_cells && faces >= options.faces_for_near) {
      if (options.name_untouched) {
        const auto near = find_near_faces(operands, options.cell_limit);
        if (auto outcome = evaluate_some(near)) return *std::move(outcome);
      }
      if (auto outcome = evaluate_some(find_live_faces(operands, expression))) {
        return *std::move(outcome);
      }
    }
    Job job(operands);
    auto evaluated = evaluate_job(job, operands, expression, region, options, stats);
    if (!evaluated) return evaluated.error();
    return assembled(job, std::move(*evaluated));
  };
  return faces > kFewForThreads ? with_threads(std::max(1u, options.threads), evaluate)
                                : evaluate();
}

}  // namespace csgrun

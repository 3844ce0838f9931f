#include "engine/bsp/kernel.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/parallel.h"
#include "engine/bsp/apart_operands.h"
#include "engine/bsp/assemble.h"
#include "engine/bsp/evaluate_boxes.h"
#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/live_faces.h"
#include "engine/bsp/near_faces.h"
#include "engine/bsp/operand_groups.h"
#include "engine/bsp/side_by_side.h"
#include "engine/bsp/touch_list.h"
#include "engine/bsp/untouched.h"
#include "engine/exact/widths.h"

namespace csgrun {
namespace {

using Outcome = Result<std::shared_ptr<const BoundaryMesh>>;

/// Around each of a job's operands.
std::vector<GridBox> boxes_of_operands(const Job& job) {
  std::vector<GridBox> boxes;
  for (size_t o = 0; o < job.operand_count(); ++o) {
    const PolygonBox& box = job.operand_box(o);
    GridBox& wide = boxes.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      wide.lo[k] = int64_t{box.lo[k]} - 1;
      wide.hi[k] = int64_t{box.hi[k]} + 1;
    }
  }
  return boxes;
}

bool is_on_grid(const GridBox& box) {
  constexpr int64_t kLimit = int64_t{1} << widths::kGrid;
  const auto is_far = [](int64_t x) { return x <= -kLimit || x >= kLimit; };
  return box.empty() || !(std::any_of(box.lo.begin(), box.lo.end(), is_far) ||
                          std::any_of(box.hi.begin(), box.hi.end(), is_far));
}

/// How a job may stand in groups, if it may: where what a group leaves is off the grid, it could
/// not be an operand.
std::optional<GroupWay> way_of_groups(const Job& job, const Expression& expression,
                                      const KernelOptions& options) {
  if (!options.may_group || !can_be_grouped(expression)) return std::nullopt;
  const std::vector<GridBox> boxes = boxes_of_operands(job);
  const auto are_on_grid = [&](GroupWay way) {
    const auto groups = boxes_of_groups(expression, way, boxes);
    return std::all_of(groups.begin(), groups.end(), is_on_grid);
  };
  if (are_on_grid(GroupWay::kAlone)) return GroupWay::kAlone;
  if (are_taken_away(expression) && are_on_grid(GroupWay::kWithFirst)) return GroupWay::kWithFirst;
  return std::nullopt;
}

/// A job that is crowded, in groups. REQUIRES: there is a way.
Outcome evaluate_crowded(const Job& job, const Expression& expression, const GridBox& region,
                         const KernelOptions& options, EvaluateStats& stats) {
  KernelOptions of_crowd = options;
  of_crowd.is_of_crowd = true;
  KernelOptions of_group = is_one_group(expression) ? options : of_crowd;
  of_group.progress = nullptr;
  const auto grouped = evaluate_groups(
      job.operands(), expression, *way_of_groups(job, expression, options), boxes_of_operands(job),
      [&](const std::vector<Operand>& operands, const Expression& part, const GridBox& around) {
        return evaluate_boolean(operands, part, around, of_group, stats);
      });
  if (!grouped) return grouped.error();
  return evaluate_boolean(grouped->operands, grouped->expression, region, of_crowd, stats);
}

/// What is left of a job, and beside it what stands apart.
Outcome beside_the_rest(ApartOperands apart, const GridBox& region, const KernelOptions& options,
                        EvaluateStats& stats) {
  std::vector<Operand> operands = std::move(apart.kept);
  KernelOptions of_repeated = options;
  of_repeated.progress = nullptr;
  for (const ApartOperands::Repeated& repeated : apart.repeated) {
    auto one =
        evaluate_boolean(repeated.operands, repeated.expression, repeated.box, of_repeated, stats);
    if (!one) return one;
    for (const ApartOperands::Repeated::Place& place : repeated.places) {
      Operand& operand = operands.emplace_back();
      operand.boundary = *one;
      operand.translation = place.moved;
      operand.first_source = place.more_sources;
    }
  }
  if (!apart.others.empty()) {
    auto rest = evaluate_boolean(apart.others, apart.expression, region, options, stats);
    if (!rest) return rest;
    operands.emplace_back().boundary = *std::move(rest);
  }
  auto result = side_by_side(operands);
  return options.name_untouched ? result : expanded(std::move(result));
}

}  // namespace

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
  if (options.whole_faces && !options.literal_cells) {
    if (auto apart = find_apart(operands, expression)) {
      return beside_the_rest(*std::move(apart), region, options, stats);
    }
  }
  if (!std::all_of(operands.begin(), operands.end(), can_stand_named)) {
    return evaluate_boolean(with_standing_parts(operands), expression, region, options, stats);
  }
  const auto evaluate_alone = [&](Job& job, EvaluateStats& own) {
    KernelOptions alone = options;
    alone.stop_when_crowded = way_of_groups(job, expression, options).has_value();
    return evaluate_job(job, operands, expression, region, alone, own);
  };
  size_t faces = 0;
  for (const Operand& operand : operands) faces += operand.leaf ? operand.leaf->face_count() : 0;
  const auto assembled = [&](Job& job, EvaluatedJob&& evaluated) {
    std::vector<UntouchedPart> parts;
    if (options.name_untouched) {
      parts = take_untouched(job, operands, evaluated.far, evaluated.whole);
    }
    return assemble(job, std::move(evaluated.sets), std::move(evaluated.whole),
                    std::move(evaluated.touching), std::move(parts));
  };
  // With the faces that matter alone, if that does.
  const auto evaluate_some = [&](const auto& some) -> std::optional<Outcome> {
    if (!some) return std::nullopt;
    Job job(operands, *some);
    EvaluateStats own = stats;
    auto evaluated = evaluate_alone(job, own);
    if (evaluated && evaluated->is_crowded) {
      return evaluate_crowded(job, expression, region, options, stats);
    }
    if (evaluated && evaluated->needs_all_faces) return std::nullopt;
    stats = own;
    if (!evaluated) return evaluated.error();
    return assembled(job, std::move(*evaluated));
  };
  const auto evaluate = [&]() -> Outcome {
    expect_faces(faces);
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
    auto evaluated = evaluate_alone(job, stats);
    if (!evaluated) return evaluated.error();
    if (evaluated->is_crowded) {
      return evaluate_crowded(job, expression, region, options, stats);
    }
    return assembled(job, std::move(*evaluated));
  };
  return faces > kFewForThreads ? with_threads(std::max(1u, options.threads), evaluate)
                                : evaluate();
}

}  // namespace csgrun

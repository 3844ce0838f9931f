#include "engine/bsp/result_pieces.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/bsp/evaluate_job.h"
#include "engine/bsp/piece_writer.h"
#include "engine/bsp/pruned_expression.h"
#include "engine/bsp/untouched.h"
#include "engine/bsp/whole_faces.h"

namespace csgrun {
namespace {

Error not_closed() { return {ErrorCode::kInternal, "the pieces of a face do not close up", {}}; }

/// The expression with other numbers for the operands.
template <class Number>
Expression renumbered(Expression expression, Number&& number) {
  for (Expression::Node& node : expression.nodes) {
    if (node.is_operand) node.operand = number(node.operand);
  }
  return expression;
}

/// Bytes of the store and the tree for pieces and points that are new.
size_t bytes_of(size_t pieces, size_t points) {
  constexpr size_t kPiece = 300, kPoint = 250;  // with their planes and their share of nodes
  return sizeof(ResultPieces) + pieces * kPiece + points * kPoint;
}

enum class Outside : uint8_t { kKept, kDropped, kTurned };

/// What becomes of an operand where it is outside all others.
Outside fate_outside(const Expression& expression, uint32_t operand) {
  std::vector<PrunedExpression::Boundary> scratch;
  const auto boundary = PrunedExpression(expression)
                            .boundary([](uint32_t) { return false; },
                                      [&](uint32_t o) { return o == operand; }, scratch);
  if (boundary.operand != operand) return Outside::kDropped;
  return boundary.front ? Outside::kTurned : Outside::kKept;
}

}  // namespace

void start_version(ResultPieces& version, const std::vector<uint32_t>& pieces) {
  const PieceStore& store = *version.store;
  version.bytes = bytes_of(store.piece_count(), store.point_count());
  version.tree =
      PieceTree().changed({}, pieces, [&](uint32_t p) -> const PieceBox& { return store.box(p); });
}

Result<PiecesPtr> evaluate_pieces(const std::vector<Operand>& given, const Expression& expression,
                                  const GridBox& region, const KernelOptions& options,
                                  EvaluateStats& stats) {
  const std::vector<Operand> operands = without_parts(given);
  auto result = std::make_shared<ResultPieces>();
  result->store = std::make_shared<PieceStore>();
  PieceStore& store = *result->store;
  Job job(operands, &store.planes);
  auto evaluated = evaluate_job(job, operands, expression, region, options, stats);
  if (!evaluated) return evaluated.error();
  PieceWriter writer(job, operands, store);
  if (!writer.add_operands()) return PiecesPtr();
  writer.add_whole(evaluated->whole, evaluated->far);
  if (!writer.add_cut(evaluated->sets)) return not_closed();
  result->touches_anywhere = evaluated->touching.anywhere;
  result->touches = TouchList().with(std::move(evaluated->touching.boxes));
  start_version(*result, writer.added);
  return PiecesPtr(std::move(result));
}

Result<PiecesPtr> change_pieces(const ResultPieces& version, const std::vector<Operand>& others,
                                const Expression& expression, const GridBox& region,
                                const KernelOptions& options, EvaluateStats& stats) {
  const auto own = static_cast<uint32_t>(others.size());
  const Expression own_last =
      renumbered(expression, [&](uint32_t o) { return o == 0 ? own : o - 1; });
  const Outside outside = fate_outside(own_last, own);
  if (outside == Outside::kTurned) return PiecesPtr();
  std::vector<Operand> operands = without_parts(others);
  for (Operand& o : operands) o.first_source -= version.first_source;
  operands.emplace_back();
  operands.back().pieces =
      std::make_shared<PieceOperand>(PieceOperand{version.store, version.tree});
  PieceStore& store = *version.store;
  const size_t pieces_before = store.piece_count(), points_before = store.point_count();
  Job job(operands, &store.planes);
  auto faces = evaluate_whole_faces(job, own_last, options, stats);
  if (!faces) return faces.error();
  if (faces->any_general) {
    // Cells need closed surfaces: all of it.
    auto boundary = assemble_pieces(version, false);
    if (!boundary) return boundary.error();
    operands.assign(1, {});
    operands[0].boundary = *boundary;
    operands.insert(operands.end(), others.begin(), others.end());
    return evaluate_pieces(operands, expression, region, options, stats);
  }

  PieceWriter writer(job, operands, store);
  if (!writer.add_operands()) return PiecesPtr();
  const uint32_t first = job.polygon_start(own);
  const auto polygons = static_cast<uint32_t>(job.polygons().size());
  std::vector<uint8_t> is_kept(polygons - first, 0);
  std::erase_if(faces->whole, [&](const WholePolygon& w) {
    if (w.polygon < first || w.flip) return false;
    is_kept[w.polygon - first] = 1;
    if (w.is_met) store.set_met(job.piece(w.polygon));
    return true;
  });
  writer.add_whole(faces->whole, faces->far);
  std::vector<FragmentSet> cut;
  cut.push_back(std::move(faces->cut));
  if (!writer.add_cut(cut)) return not_closed();

  auto result = std::make_shared<ResultPieces>();
  result->store = version.store;
  result->first_source = version.first_source;
  result->bytes =
      bytes_of(store.piece_count() - pieces_before, store.point_count() - points_before);
  Touching more = touching_before(others);
  result->touches_anywhere = version.touches_anywhere || more.anywhere;
  result->touches = version.touches.with(std::move(more.boxes)).with(std::move(faces->touching));
  const auto box_of = [&](uint32_t p) -> const PieceBox& { return store.box(p); };
  if (outside == Outside::kDropped) {
    for (uint32_t p = first; p < polygons; ++p) {
      if (is_kept[p - first]) writer.added.push_back(job.piece(p));
    }
    result->tree = PieceTree().changed({}, writer.added, box_of);
    return PiecesPtr(std::move(result));
  }
  // Gone are the pieces of the job that were not kept, and regions and groups with such parts.
  std::vector<uint32_t> lost, gone;
  lost.reserve(is_kept.size());
  gone.reserve(is_kept.size());
  for (uint32_t p = first; p < polygons; ++p) {
    if (is_kept[p - first]) continue;
    lost.push_back(job.piece(p));
    gone.push_back(job.version_piece(p));
  }
  std::sort(lost.begin(), lost.end());
  std::sort(gone.begin(), gone.end());
  gone.erase(std::unique(gone.begin(), gone.end()), gone.end());
  for (const uint32_t p : gone) {
    const auto [first_part, part_count] = store.parts(p);
    for (uint32_t part = first_part; part < first_part + part_count; ++part) {
      if (!std::binary_search(lost.begin(), lost.end(), part)) writer.added.push_back(part);
    }
  }
  result->tree = version.tree.changed(
      gone, writer.added, box_of, [&](const PieceBox& box) { return job.others_may_meet(box); });
  assert(result->tree.size() == version.tree.size() - gone.size() + writer.added.size());
  return PiecesPtr(std::move(result));
}

}  // namespace csgrun

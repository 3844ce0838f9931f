#include "engine/csg/scene_jobs.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/base/timer.h"
#include "engine/bsp/boundary_pieces.h"
#include "engine/bsp/untouched.h"
#include "engine/csg/grid.h"
#include "engine/mesh/face_normal.h"

namespace csgrun {
namespace {

/// What a materialised result that is only moved, and painted as a whole, is in the world: that
/// needs no job. Nothing if it is more than moved; faces of several colours may become one by
/// painting.
BoundaryPtr moved_and_painted(const Operand& operand) {
  if (!operand.boundary || !operand.frame.is_identity || operand.first_source != 0) return nullptr;
  const std::optional<uint32_t> only = only_appearance(*operand.boundary);
  const bool is_painted = operand.appearance && only != operand.appearance;
  if (!is_painted && operand.translation == IVec3{0, 0, 0}) return operand.boundary;
  if (is_painted && !only) return nullptr;
  auto moved = std::make_shared<BoundaryMesh>(translated(*operand.boundary, operand.translation));
  if (is_painted) {
    for (auto& face : moved->faces) face.label.appearance = *operand.appearance;
    for (UntouchedPart& part : moved->parts) part.appearance = operand.appearance;
  }
  return moved;
}

/// Whether a result in pieces has so many faces at least. O(count).
bool has_faces(const ResultPieces& pieces, size_t count) {
  if (pieces.tree.size() >= count) return true;
  size_t found = 0;
  const PieceStore& store = *pieces.store;
  pieces.tree.each([&](const PieceBox&) { return found < count; },
                   [&](uint32_t piece) {
                     found += store.is_group(piece) ? store.group_faces(piece).size() : 1;
                   });
  return found >= count;
}

/// Where a result can be. A box around it may reach to where no leaf can be seen from it, and there
/// is nothing there: all that can be seen fits the grid (scene_reach), with a bit to spare.
GridBox on_grid(GridBox box) {
  for (size_t k = 0; k < 3; ++k) {
    box.lo[k] = std::clamp(box.lo[k], -2 * kGridLimit, 2 * kGridLimit);
    box.hi[k] = std::clamp(box.hi[k], -2 * kGridLimit, 2 * kGridLimit);
  }
  return box;
}

}  // namespace

/// Results that would have far planes stay in their parent's job, which clips them.
bool SceneJobs::may_keep(const Subtree& subtree) {
  return !subtree.is_far && fits_grid(subtree.box);
}

/// What is known stays so until the end of the run, whatever the cache drops meanwhile.
bool SceneJobs::is_known(const Key& key) {
  if (results_.contains(key)) return true;
  const StoredBoundary* const known = cache_.find(key);
  if (known != nullptr) results_.emplace(key, Kept{*known, false});
  return known != nullptr;
}

/// Also where it would not be kept: there a leaf may be far that was near where it was evaluated.
bool SceneJobs::may_use_known(const Subtree& subtree) {
  return fits_grid(subtree.box) && is_known(subtree.id.key);
}

void SceneJobs::find_operators(const std::vector<uint32_t>& roots) {
  std::vector<uint32_t> stack(roots);
  while (!stack.empty()) {
    const uint32_t node = stack.back();
    stack.pop_back();
    if (!is_operator(node)) continue;
    const auto [found, is_new] = operators_.try_emplace(scene_.nodes[node].subtree.id.key, node);
    if (!is_new) {
      // Where it can be kept, it can be used elsewhere.
      const auto is_kept = [&](uint32_t n) { return may_keep(scene_.nodes[n].subtree); };
      if (is_kept(node) && !is_kept(found->second)) found->second = node;
      continue;
    }
    if (is_known(scene_.nodes[node].subtree.id.key)) continue;
    // In their order: of several places of one solid the first is where it is evaluated.
    const OperandList list = scene_.operands(node);
    for (size_t i = list.operands.size(); i-- > 0;) {
      if (is_operator(list.operands[i])) stack.push_back(list.operands[i]);
    }
  }
}

/// How many operands of a list, less than all, are a subtree that is known or stands elsewhere; 0
/// when none are.
size_t SceneJobs::shared_prefix(const OperandList& list) {
  for (size_t count = list.operands.size() - 1; count >= 2; --count) {
    const Subtree& value = *list.values[count - 1];
    if (!may_keep(value)) continue;
    if (is_known(value.id.key) || operators_.contains(value.id.key)) return count;
  }
  return 0;
}

/// What a list ends with, if that is known and stands as it was evaluated, and nothing that it
/// begins with is.
KnownTails::Tail SceneJobs::known_tail(uint32_t node, const OperandList& list) {
  if (!may_be_in_pieces() || shared_prefix(list) > 0) return {};
  const KnownTails::Tail tail = tails_.find(scene_, node, list);
  if (tail.first == 0 || !may_keep(tail.value) || !is_known(tail.value.id.key)) return {};
  return tail;
}

/// Counts how often each operator is used in the jobs, if each becomes a result of its own. Returns
/// one node of each, in an order in which they can be evaluated.
std::vector<uint32_t> SceneJobs::count_uses(const std::vector<uint32_t>& roots) {
  std::vector<uint32_t> order;
  struct Visit {
    uint32_t node;
    bool is_done;
  };
  std::vector<Visit> stack;
  std::unordered_set<Key, KeyHash> opened;
  // What waits on the stack may be wanted again above it, and then comes first.
  const auto want = [&](const Key& key) {
    ++uses_[key];
    if (!opened.contains(key) && !is_known(key)) stack.push_back({operators_.at(key), false});
  };
  for (uint32_t root : roots) {
    if (!is_operator(root)) continue;
    want(scene_.nodes[root].subtree.id.key);
    while (!stack.empty()) {
      Visit& top = stack.back();
      if (top.is_done) {
        order.push_back(top.node);
        stack.pop_back();
        continue;
      }
      if (!opened.insert(scene_.nodes[top.node].subtree.id.key).second) {
        stack.pop_back();
        continue;
      }
      top.is_done = true;
      const uint32_t node = top.node;
      const OperandList list = scene_.operands(node);
      const size_t prefix = shared_prefix(list);
      const size_t tail = known_tail(node, list).first;
      for (size_t i = tail > 0 ? tail : list.operands.size(); i-- > prefix;) {
        const uint32_t operand = list.operands[i];
        note_user(operand, node);
        if (!is_operator(operand)) continue;
        const Identity& value = scene_.nodes[operand].subtree.id;
        want(value.key);
        if (is_known(value.key)) {
          note_cut_from(operand, value, i == 0 && cuts_its_first(node) ? node : operand);
        }
      }
      if (prefix > 0 && is_known(list.values[prefix - 1]->id.key)) {
        note_cut_from(node, list.values[prefix - 1]->id, node);
      }
      if (prefix > 0) {
        const Key& key = list.values[prefix - 1]->id.key;
        if (operators_.contains(key)) want(key);
      }
    }
  }
  return order;
}

/// Notes that a solid is an operand of an operator.
void SceneJobs::note_user(uint32_t operand, uint32_t user) {
  const Identity& id = scene_.nodes[operand].subtree.id;
  const auto [first, is_first] = first_users_.try_emplace(id, User{user, id});
  if (!is_first && first->second.user != user) {
    note_overlap(first->second.user, user, is_operator(operand));
  }
}

/// Notes what a known value in an operator, or that operator, was cut from. Nobody opens what is
/// known, but the surface of that is there, as it is in other values that were cut from it.
void SceneJobs::note_cut_from(uint32_t node, const Identity& value, uint32_t user) {
  while (cuts_its_first(node)) {
    node = scene_.nodes[node].first;
    const Identity& id = scene_.nodes[node].subtree.id;
    if (id == value) continue;
    const auto [first, is_first] = first_users_.try_emplace(id, User{user, value});
    if (is_first || first->second.user == user || first->second.value == value) continue;
    note_overlap(first->second.user, user, is_operator(node));
  }
}

/// Notes that two operators have surface of one solid, in one place. Boxes do not mind that.
void SceneJobs::note_overlap(uint32_t a, uint32_t b, bool in_operator) {
  for (const uint32_t node : {a, b}) {
    if (in_operator || !scene_.nodes[node].subtree.is_of_boxes) overlapping_.insert(node);
  }
}

Status SceneJobs::run(const std::vector<uint32_t>& roots) {
  for (const SceneNode& node : scene_.nodes) {
    if (node.kind == SceneNode::Kind::kKnown) hold(node.subtree.id.key);
  }
  find_operators(roots);
  const std::vector<uint32_t> order = count_uses(roots);
  std::unordered_set<Key, KeyHash> own_keys;
  for (uint32_t root : roots) own_keys.insert(scene_.nodes[root].subtree.id.key);
  for (uint32_t node : order) {
    if (!is_hull(node)) continue;
    own_keys.insert(scene_.nodes[node].subtree.id.key);
    own_keys.insert(scene_.nodes[scene_.nodes[node].first].subtree.id.key);
  }
  std::vector<uint32_t> kept;
  for (uint32_t node : order) {
    const Subtree& subtree = scene_.nodes[node].subtree;
    if (!may_keep(subtree)) {
      // With flatten off its prefixes are still results of their own.
      if (!options_.flatten) kept.push_back(node);
      continue;
    }
    if (!options_.flatten || uses_[subtree.id.key] > 1 || own_keys.contains(subtree.id.key) ||
        overlapping_.contains(node)) {
      kept.push_back(node);
    }
  }
  jobs_total_ = kept.size() + roots.size();
  for (uint32_t node : kept) {
    if (Status status = evaluate(node); !status) return status;
  }
  return std::monostate{};
}

/// Evaluates an operator and keeps its value. With flatten off, one operand after another.
Status SceneJobs::evaluate(uint32_t node) {
  if (is_hull(node)) return evaluate_hull(node);
  const OperandList list = scene_.operands(node);
  const size_t all = list.operands.size();
  for (size_t count = options_.flatten ? all : 2; count <= all; ++count) {
    const Subtree& subtree = *list.values[count - 1];
    if (!may_keep(subtree) || is_known(subtree.id.key)) continue;
    const Timer timer;
    auto parts = build(node, count, subtree.id.frame, subtree.is_of_one_frame);
    if (parts && parts->is_too_far) parts = build(node, count, subtree.id.frame);
    if (!parts) return parts.error();
    stats_.nodes_evaluated += parts->operators;
    const Subtree here = subtree.moved(parts->moved);
    auto stored = run_kept_job(*std::move(parts), here);
    if (!stored) return stored.error();
    keep(subtree, *std::move(stored), timer.seconds());
  }
  ++jobs_done_;
  return std::monostate{};
}

/// The hull in the axes of its solid's frame. All that a hull stands on fits the grid and is kept.
Status SceneJobs::evaluate_hull(uint32_t node) {
  const Subtree& subtree = scene_.nodes[node].subtree;
  if (is_known(subtree.id.key)) return std::monostate{};
  const Timer timer;
  const SceneNode& solid = scene_.nodes[scene_.nodes[node].first];
  auto surface = solid.kind == SceneNode::Kind::kLeaf
                     ? Result<Operand>(place_leaf(solid, subtree.id.frame))
                     : place(solid.subtree, subtree.id.frame);
  if (!surface) return surface.error();
  auto boundary = resolve_surface(*surface, {}, InsideRule::kOuterHull,
                                  kernel_options(options_, threads_), stats_);
  if (!boundary) return boundary.error();
  ++stats_.nodes_evaluated;
  keep(subtree, {*boundary, nullptr, subtree.id}, timer.seconds());
  ++jobs_done_;
  return std::monostate{};
}

void SceneJobs::keep(const Subtree& subtree, StoredBoundary stored, double seconds) {
  const size_t bytes = stored.boundary ? memory_bytes(*stored.boundary) : stored.pieces->bytes;
  cache_.put(subtree.id.key, stored, bytes);
  cache_.write(subtree.id.key, stored, seconds);
  results_[subtree.id.key] = {std::move(stored), true, seconds};
}

KernelOptions kernel_options(const EvaluateOptions& options, unsigned threads) {
  KernelOptions result;
  result.threads = threads;
  result.cell_limit = options.cell_limit;
  result.octree_shift = options.octree_shift;
  result.literal_cells = options.literal_cells;
  result.whole_faces = options.whole_faces;
  result.cancel = options.cancel;
  return result;
}

/// Pieces are worth their while where all others are small beside them: a face of a result that is
/// added is several times the work there that it is in a job of all. Of leaves only what is near
/// becomes polygons, but asking where all others are takes long if there are many.
Status SceneJobs::take_as_whole_if_less_work(Parts& parts) {
  size_t of_results = 0, of_leaves = 0;
  for (const Operand& operand : parts.operands) {
    if (operand.leaf) of_leaves += operand.leaf->face_count();
    if (operand.boundary) of_results += face_count(*operand.boundary);
  }
  constexpr size_t kTimesResults = 2, kPartOfLeaves = 4;
  const size_t work = kTimesResults * of_results + of_leaves / kPartOfLeaves;
  if (has_faces(*parts.in_pieces, work)) return std::monostate{};
  Operand& first = parts.operands[parts.pieces_at];
  const Key& key = parts.keys[parts.pieces_at];
  auto boundary = boundary_of(key);
  if (!boundary) return boundary.error();
  first.boundary = *boundary;
  parts.in_pieces = nullptr;
  return std::monostate{};
}

/// A result that goes on from another one, which somebody looked at, is kept in pieces: it is
/// likely to be gone on from, too.
Result<StoredBoundary> SceneJobs::run_kept_job(Parts parts, const Subtree& subtree) {
  if (parts.in_pieces) {
    // Alone if all others were there before (OpenOperator::repeats).
    if (parts.operands.size() == 1) return StoredBoundary{nullptr, parts.in_pieces, subtree.id};
    if (Status status = take_as_whole_if_less_work(parts); !status) return status.error();
  }
  if (parts.in_pieces) {
    spell_out(parts);
    const uint32_t at = parts.pieces_at;
    ResultPieces version = *parts.in_pieces;
    version.first_source += parts.operands[at].first_source;
    std::vector<Operand> others = parts.operands;
    others.erase(others.begin() + at);
    Expression expression = parts.expression;
    for (Expression::Node& node : expression.nodes) {
      if (node.is_operand && node.operand <= at) {
        node.operand = node.operand == at ? 0 : node.operand + 1;
      }
    }
    auto pieces = change_pieces(version, others, expression, subtree.box, job_options(), stats_);
    if (!pieces) return pieces.error();
    if (*pieces) return StoredBoundary{nullptr, *pieces, subtree.id};
  }
  auto boundary = run_job(std::move(parts), subtree.box);
  if (!boundary) return boundary.error();
  return StoredBoundary{*boundary, nullptr, subtree.id};
}

/// The boundary of a key with all faces spelled out, which is kept beside it.
BoundaryPtr SceneJobs::spelled(const Key& of, const BoundaryPtr& boundary) {
  const Key key = KeyBuilder("spelled").numbers(of).key();
  if (const StoredBoundary* const known = cache_.find(key)) return known->boundary;
  const BoundaryPtr made = expanded(boundary);
  cache_.put(key, {made, nullptr, {}}, memory_bytes(*made));
  return made;
}

/// Operands of a job in pieces, as it has them: for a chain of operations once.
void SceneJobs::spell_out(Parts& parts) {
  for (size_t i = 0; i < parts.operands.size(); ++i) {
    BoundaryPtr& boundary = parts.operands[i].boundary;
    if (boundary && !boundary->parts.empty()) boundary = spelled(parts.keys[i], boundary);
  }
}

KernelOptions SceneJobs::job_options() {
  KernelOptions options = kernel_options(options_, threads_);
  options.name_untouched = true;
  if (options_.progress) {
    // Each job is a thousand units of work, as their sizes are not known beforehand.
    options.progress = [this](uint64_t done, uint64_t total) {
      const uint64_t part = total > 0 ? 1000 * std::min(done, total) / total : 0;
      options_.progress(1000 * jobs_done_ + part, 1000 * std::max(jobs_total_, jobs_done_ + 1));
    };
  }
  return options;
}

Result<BoundaryPtr> SceneJobs::run_job(Parts parts, const GridBox& region) {
  if (parts.in_pieces) {
    auto boundary = assemble_pieces(*parts.in_pieces, false);
    if (!boundary) return boundary.error();
    parts.operands[parts.pieces_at].boundary = *boundary;
  }
  return evaluate_boolean(parts.operands, parts.expression, region, job_options(), stats_);
}

bool SceneJobs::is_only_moved(const Subtree& subtree, const StoredBoundary& stored) {
  const Identity& id = subtree.id;
  return stored.id.permutation == id.permutation && stored.id.frame == id.frame &&
         stored.id.paint == id.paint;
}

bool SceneJobs::stands_as_stored(const Subtree& subtree, const StoredBoundary& stored) {
  return is_only_moved(subtree, stored) && stored.id.origin == subtree.id.origin;
}

SceneJobs::MovedPieces SceneJobs::pieces(uint32_t root) {
  const Subtree& subtree = scene_.nodes[root].subtree;
  if (!is_operator(root) || !may_keep(subtree) || subtree.id.frame != 0) return {};
  const StoredBoundary& stored = use(subtree.id.key);
  if (!stored.pieces || !is_only_moved(subtree, stored)) return {};
  return {stored.pieces, difference(subtree.id.origin, stored.id.origin)};
}

Result<BoundaryPtr> SceneJobs::world_boundary(uint32_t root) {
  const SceneNode& node = scene_.nodes[root];
  const Subtree& subtree = node.subtree;
  Parts parts;
  if (node.kind == SceneNode::Kind::kLeaf) {
    Operand leaf = place_leaf(node, 0);
    if (BoundaryPtr boundary = moved_and_painted(leaf)) {
      ++jobs_done_;
      return boundary;
    }
    put(parts, std::move(leaf), subtree);
  } else if (!may_keep(subtree) && !may_use_known(subtree)) {
    auto built = build(root, scene_.operands(root).operands.size(), 0);
    if (!built) return built.error();
    parts = *std::move(built);
    stats_.nodes_evaluated += parts.operators;
  } else {
    const StoredBoundary& stored = use(subtree.id.key);
    const Identity& id = subtree.id;
    if (id.frame == 0 && stands_as_stored(subtree, stored)) {
      ++jobs_done_;
      return boundary_of(id.key);
    }
    results_.at(id.key).is_fresh = true;  // what is placed below is the same use
    auto operand = place_as_kept(subtree, 0);
    if (!operand) return operand.error();
    if (BoundaryPtr boundary = moved_and_painted(*operand)) {
      ++jobs_done_;
      return boundary;
    }
    if (!can_stand_named(*operand)) operand->boundary = spelled(id.key, operand->boundary);
    put(parts, *std::move(operand), subtree);
  }
  auto boundary = run_job(std::move(parts), on_grid(subtree.world));
  ++jobs_done_;
  return boundary;
}

const StoredBoundary& SceneJobs::use(const Key& key) {
  Kept& kept = hold(key);
  if (!kept.is_fresh) {
    ++(cache_.take_was_read(key) ? stats_.nodes_from_disk : stats_.nodes_from_memory);
  }
  kept.is_fresh = false;
  return kept.stored;
}

/// REQUIRES: it is known.
SceneJobs::Kept& SceneJobs::hold(const Key& key) {
  const bool known = is_known(key);
  assert(known);
  (void)known;
  return results_.at(key);
}

bool SceneJobs::may_be_in_pieces() const { return options_.whole_faces && !options_.literal_cells; }

/// The same in pieces.
PiecesPtr SceneJobs::pieces_of_result(const Key& key) {
  StoredBoundary& kept = results_.at(key).stored;
  if (!kept.pieces) {
    kept.pieces = pieces_of(kept.boundary);
    cache_.put(key, kept, memory_bytes(*kept.boundary) + kept.pieces->bytes);
  }
  return kept.pieces;
}

/// The boundary of a result that is in use.
Result<BoundaryPtr> SceneJobs::boundary_of(const Key& key) {
  Kept& result = results_.at(key);
  StoredBoundary& kept = result.stored;
  if (!kept.boundary) {
    const Timer timer;
    auto boundary = assemble_pieces(*kept.pieces, true);
    if (!boundary) return boundary.error();
    kept.boundary = *boundary;
    cache_.put(key, kept, memory_bytes(*kept.boundary) + kept.pieces->bytes);
    cache_.write(key, kept, result.seconds + timer.seconds());
  }
  return kept.boundary;
}

}  // namespace csgrun

// Trees without constructions: hulls, Minkowski sums and what else is made of evaluated solids
// become leaves, transforms and unions.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <csgrun/engine/csg_tree.h>

#include "engine/csg/evaluated_parts.h"
#include "engine/csg/far_summands.h"
#include "engine/csg/warnings.h"

namespace csgrun {

/// Remembers what it has made, so that a tree that grew costs what is new of it.
///
/// A construction commutes with the transforms above it, as a Boolean does, so these are carried
/// down to it, and their scaling into its operands; what turns and moves is left above what is made
/// of them. So nothing is rounded for a construction and scaled then. And a Minkowski sum is many
/// pieces that fit together as they are on the grid: it is moved by whole steps only, and made on a
/// grid that is no finer than the one on which it is used, which then has all its points.
class Constructions {
 public:
  Constructions(EvaluateParts evaluate, Warnings& warnings)
      : evaluate_(std::move(evaluate)), warnings_(warnings) {}

  struct Expanded {
    NodePtr node;
    /// The finest step, in mm, on which something was made of evaluated solids; infinite if nothing
    /// was. On a grid that is coarser it must be made anew.
    double finest_mm;
  };
  /// The same solid without constructions; the tree itself if it has none. Innermost ones come
  /// first; their operands are evaluated, on steps that are not below `least`, if there is one.
  /// Uses constant stack. Errors: those of the evaluation, kInvalidArgument and kLimit, at the
  /// construction's line.
  Result<Expanded> expand(const NodePtr& tree, const GridStep& least);
  /// Notes for the user about a tree that is used as it was expanded last with this step.
  void tell(const NodePtr& tree, const GridStep& least);
  void clear();

 private:
  /// What was made of a node under the transforms above it.
  struct Place {
    const Node* node;
    Affine map;
    GridStep least;
    bool operator==(const Place&) const = default;
  };
  struct PlaceHash {
    size_t operator()(const Place& place) const;
  };
  struct Made {
    NodePtr node;
    double finest_mm;
    std::string note;
    SourceRef where;           ///< of the note
    std::vector<Made*> below;  ///< that it was made of
    bool is_told = false;
  };
  struct Task;

  /// What children are to be made under.
  struct Below {
    Affine map;
    GridStep least;
  };
  /// Whether something was made, or else the least step on which its operands must be made again:
  /// that on which they were evaluated together is coarser than one on which they were made.
  struct Outcome {
    std::optional<GridStep> again;
  };

  Result<bool> advance(std::vector<Task>& stack);
  [[nodiscard]] Result<Below> below(const Task& task) const;
  Result<Outcome> make(const Task& task, std::vector<NodePtr> children, Made& made);
  Result<Outcome> make_hull(const Task& task, const std::vector<NodePtr>& operands, Made& made);
  Result<Outcome> make_sum(const Task& task, const std::vector<NodePtr>& operands, Made& made);
  Result<Outcome> measure(const Task& task, const NodePtr& operand, double finest_mm);

  EvaluateParts evaluate_;
  Warnings& warnings_;
  FarSummands summands_;
  std::unordered_map<Place, Made, PlaceHash> made_;
  std::unordered_map<const Node*, std::optional<Affine>> resizing_;  ///< nothing: it is empty
  std::vector<NodePtr> alive_;  ///< keys of the maps stay valid
};

}  // namespace csgrun

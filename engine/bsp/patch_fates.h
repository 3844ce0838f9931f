// What becomes of polygons and of parts of cut ones: they are joined to patches that no other
// operand's surface divides, and each patch is asked about once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/base/raw_vector.h"
#include "engine/bsp/contact_table.h"
#include "engine/bsp/cut_faces.h"
#include "engine/bsp/patch_facts.h"
#include "engine/bsp/patch_labels.h"
#include "engine/bsp/union_find.h"

namespace csgrun {

/// A corner of a polygon that is on no other operand's surface, or kNone. There is none where
/// something coplanar meets the polygon.
uint32_t untouched_corner(const Job& job, const ContactTable& contacts, uint32_t polygon);

class PatchFates {
 public:
  /// Patches with a corner of a polygon that is plainly covered are dropped unasked.
  /// `cut` are the polygons that were cut; `is_cut` says it of each, also of those that were cut
  /// into nothing or left. All are kept by reference.
  PatchFates(const Job& job, const Expression& expression, const PlainlyCovered& plainly,
             const KernelOptions& options, const ContactTable& contacts, const CutFaces& cut,
             const CellGeometry& geometry, const std::vector<uint8_t>& is_cut);

  /// Finds what becomes of everything. False if what bounds a patch contradicts itself. Parallel.
  [[nodiscard]] bool find();

  /// That of a face of an operand that the job does not have: see Job::near_faces.
  [[nodiscard]] PatchFate of_far_face(size_t operand, uint32_t face) const {
    return static_cast<PatchFate>(patch_fates_[patches_.root(vertex_of_far_face(operand, face))]);
  }
  [[nodiscard]] PatchFate of_loop(uint32_t loop) const { return fate_of_loop_[loop]; }
  /// That of a polygon that was not cut; kDrop for the others.
  [[nodiscard]] PatchFate of_polygon(uint32_t polygon) const {
    const uint32_t vertex = vertex_of_polygon_[polygon];
    return vertex == kNone ? PatchFate::kDrop
                           : static_cast<PatchFate>(patch_fates_[patches_.root(vertex)]);
  }
  /// From now on nothing is left of the loops of a polygon.
  void drop_loops(const CutFaces::Face& cut) {
    std::fill(fate_of_loop_.begin() + cut.first_loop, fate_of_loop_.begin() + cut.end_loop,
              PatchFate::kDrop);
  }

 private:
  /// A patch, by the vertex that stands for it, or a loop that passes no vertex.
  struct Question {
    uint32_t own;  ///< operand
    uint32_t patch, loop;
  };

  void join_patches();
  void join_far_faces(size_t operand);
  void join_loops(const CutFaces::Face& face);
  bool gather_facts();
  using ByOperand = std::vector<std::pair<uint32_t, uint32_t>>;  ///< operands and contacts
  /// `by_operand`: working memory.
  void add_rim_facts(uint32_t polygon, ByOperand& by_operand, PatchFacts& facts) const;
  void drop_covered();
  void join_bare_loops();
  [[nodiscard]] bool stands_alone(uint32_t loop) const {
    return bare_loops_.size() == 0 || bare_loops_.root(loop) == loop;
  }
  void ask_about_loops();
  void ask_about_whole();
  void ask_about_far_faces();
  [[nodiscard]] uint32_t vertex_of_far_face(size_t operand, uint32_t face) const {
    const LeafGeometry& leaf = *job_.leaf(operand);
    return job_.vertex_start(operand) + leaf.corners[leaf.face_starts[face]];
  }
  void ask(uint32_t patch, uint32_t own);
  void answer();
  void answer_for_bare_loops();
  void answer(const Question& q, PatchLabels& labels);
  PatchFate fate_of_loop(const CutLoops::Loop& loop, uint32_t own, PatchLabels& labels) const;
  PatchFate fate_at_edge(const CutLoops::Loop& loop, uint32_t edge, uint32_t own,
                         PatchLabels& labels) const;

  static constexpr uint8_t kUnasked = 0xff, kAsked = 0xfe;

  const Job& job_;
  const PlainlyCovered& plainly_;
  const KernelOptions& options_;
  const ContactTable& contacts_;
  const CutFaces& cut_;
  const CellGeometry& geometry_;
  const std::vector<uint8_t>& is_cut_;
  PatchLabels labels_;
  UnionFind patches_;  ///< of vertices
  UnionFind
      bare_loops_;  ///< loops, of which one tells what becomes of all; empty: each stands alone
  PatchFacts facts_;
  RawVector<uint32_t> vertex_of_polygon_;  ///< an untouched one; kNone: it was cut
  std::vector<uint8_t> patch_fates_;       ///< per vertex that stands for a patch: a PatchFate
  std::vector<PatchFate> fate_of_loop_;
  std::vector<Question> questions_;
};

}  // namespace csgrun

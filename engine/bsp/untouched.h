// Triangles of leaves that no operation came near: named, not copied.
//
// A face of a leaf is untouched in a result when nothing met it, no other face is merged with it,
// and the faces at each of its corners form one fan. Nothing else passes a corner then, so what is
// there of its neighbours, cut or not, is one fan too; nothing of the face can be broken or joined
// with anything else. It is not merged when no neighbour lies in its plane (and the leaf is convex
// or keeps facets, so that what lies there elsewhere is another face), or when it is a facet that
// is kept, as all faces at its corners are.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/bsp/assemble.h"
#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/job.h"
#include "engine/bsp/near_faces.h"

namespace csgrun {

/// What became of a face, as far as its boundary goes.
enum class FaceFate : uint8_t {
  kMixed,    ///< none of it is left, or not all, or something met it
  kKept,     ///< all of it
  kFlipped,  ///< all of it, turned over
};

/// The untouched triangles of a leaf, of each side that has some. `fate` is that of `faces`, which
/// ascend (null: all of the leaf), and `taken` is set where one is untouched; all of `far` are,
/// which are not among these. For which leaves and faces, see take_untouched. The parts lack what a
/// job knows. O(faces).
std::vector<UntouchedPart> untouched_parts(const Operand& operand,
                                           const std::vector<uint32_t>* faces, const FaceFate* fate,
                                           const FarFaces& far, uint8_t* taken);

/// Tells a part of operand `o`, a leaf, what the job knows of its vertices.
void place_in_job(UntouchedPart& part, const Job& job, size_t o);

/// Takes the untouched triangles of the operands out of `whole`, and all of `far` (see WholeFaces);
/// their corners that other faces have too are named by the job's vertices in
/// UntouchedPart::shared. A leaf counts if its frame does not mirror, it touches itself nowhere,
/// and its edges are paired; a face if it is a triangle. Of a leaf that may touch itself faces
/// count only `if_all_around_are`, if it is known that no face in `whole` meets others but in
/// corners and edges that both have: faces that are cut may cross one another in a corner of
/// theirs, so that others there are several fans. O(faces of such leaves).
std::vector<UntouchedPart> take_untouched(const Job& job, const std::vector<Operand>& operands,
                                          const std::vector<FarFaces>& far,
                                          std::vector<WholePolygon>& whole,
                                          bool if_all_around_are = false);

/// The same boundary with all faces spelled out; the mesh itself if they are.
std::shared_ptr<const BoundaryMesh> expanded(std::shared_ptr<const BoundaryMesh> mesh);

/// Whether a job takes an operand as it is: a boundary has few parts, or none, of triangles on the
/// grid that are facets of their own.
bool can_stand_named(const Operand& operand);
/// The operands, with the boundaries spelled out that cannot, or all of them.
std::vector<Operand> with_standing_parts(std::vector<Operand> operands);
std::vector<Operand> without_parts(std::vector<Operand> operands);

}  // namespace csgrun

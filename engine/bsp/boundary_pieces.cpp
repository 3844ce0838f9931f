#include "engine/bsp/boundary_pieces.h"

#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/bsp/piece_writer.h"
#include "engine/bsp/some_faces.h"
#include "engine/bsp/untouched.h"

namespace csgrun {
namespace {

/// The same without the faces that it names, some corners of which its points then are.
std::shared_ptr<const BoundaryMesh> spelled_part(const BoundaryMesh& mesh) {
  auto own = std::make_shared<BoundaryMesh>();
  own->planes = mesh.planes;
  own->point_planes = mesh.point_planes;
  own->point_rounded = mesh.point_rounded;
  own->faces = mesh.faces;
  own->loop_starts = mesh.loop_starts;
  own->corners = mesh.corners;
  return own;
}

Operand leaf_of(const UntouchedPart& part) {
  Operand operand;
  operand.leaf = part.leaf;
  operand.translation = part.translation;
  operand.frame = part.map.frame();
  operand.first_source = part.source;
  operand.appearance = part.appearance;
  return operand;
}

/// What is spelled out first, then the leaves of the parts.
class BoundaryPieces {
 public:
  explicit BoundaryPieces(const BoundaryMesh& mesh) : mesh_(mesh) {
    operands_.emplace_back().boundary = spelled_part(mesh);
    // Of one leaf of the tree there may be two, what is kept and what is turned over.
    std::unordered_map<uint32_t, uint32_t> operand_of_source;
    for (const UntouchedPart& part : mesh.parts) {
      const auto [known, is_new] =
          operand_of_source.try_emplace(part.source, static_cast<uint32_t>(operands_.size()));
      if (is_new) operands_.push_back(leaf_of(part));
      operand_of_.push_back(known->second);
    }
  }

  /// Null if a leaf cannot be in pieces.
  PiecesPtr run() {
    auto result = std::make_shared<ResultPieces>();
    result->store = std::make_shared<PieceStore>();
    PieceStore& store = *result->store;
    // Vertices of all operands, and the polygons of what is spelled out.
    SomeFaces none;
    none.is_partial.assign(operands_.size(), 1);
    none.is_partial[0] = 0;
    none.faces.resize(operands_.size());
    Job job(operands_, store.planes, none);
    PieceWriter writer(job, operands_, store);
    if (!writer.add_operands()) return nullptr;
    std::vector<FarFaces> named(operands_.size());
    for (size_t k = 0; k < mesh_.parts.size(); ++k) {
      const UntouchedPart& part = mesh_.parts[k];
      for (const UntouchedPart::Shared& s : part.shared) {
        writer.set_same(job.vertex_start(0) + s.point, job.vertex_start(operand_of_[k]) + s.vertex);
      }
      auto& faces = part.flipped ? named[operand_of_[k]].flipped : named[operand_of_[k]].kept;
      faces.insert(faces.end(), part.faces.begin(), part.faces.end());
    }
    std::vector<WholePolygon> spelled;
    for (uint32_t p = 0; p < job.polygons().size(); ++p) spelled.push_back({p, false});
    writer.add_whole(spelled, named);
    result->touches_anywhere = mesh_.may_touch && mesh_.touches.empty();
    if (mesh_.may_touch) result->touches = TouchList().with(mesh_.touches);
    start_version(*result, writer.added);
    return result;
  }

 private:
  const BoundaryMesh& mesh_;
  std::vector<Operand> operands_;
  std::vector<uint32_t> operand_of_;  ///< per part
};

}  // namespace

PiecesPtr pieces_of(const std::shared_ptr<const BoundaryMesh>& boundary) {
  if (PiecesPtr pieces = BoundaryPieces(*boundary).run()) return pieces;
  return BoundaryPieces(*expanded(boundary)).run();
}

}  // namespace csgrun

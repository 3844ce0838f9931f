#include "engine/bsp/side_by_side.h"

#include <utility>

#include "engine/bsp/canonical_order.h"
#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/touch_list.h"

namespace csgrun {
namespace {

/// Puts boundaries into one.
class Gatherer {
 public:
  Gatherer() : geometry_(planes_, nullptr) {}

  void add(const Operand& operand) {
    const BoundaryMesh& mesh = *operand.boundary;
    const IVec3& t = operand.translation;
    std::vector<PlaneId> plane_of;
    plane_of.reserve(mesh.planes.size());
    for (const Plane& plane : mesh.planes) {
      plane_of.push_back(planes_.intern_stored(translate_plane(plane, t)));
    }
    const auto first_point = static_cast<uint32_t>(geometry_.point_count());
    for (uint32_t p = 0; p < mesh.point_planes.size(); ++p) {
      const auto& named = mesh.point_planes[p];
      geometry_.add_point(
          {plane_of[named[0]].index(), plane_of[named[1]].index(), plane_of[named[2]].index()},
          rounded_when_moved(mesh, p, t));
    }
    for (const BoundaryMesh::Face& face : mesh.faces) {
      FaceLabel label = face.label;
      label.source += operand.first_source;
      if (operand.appearance) label.appearance = *operand.appearance;
      draft_.begin_face(PlaneId(plane_of[face.plane.index()].index(), face.plane.flipped()), label,
                        face.whole, face.complete);
      for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
        const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
        for (uint32_t c = begin; c < end; ++c) {
          draft_.edges.push_back({first_point + mesh.corners[c].point,
                                  first_point + mesh.corners[c + 1 < end ? c + 1 : begin].point,
                                  plane_of[mesh.corners[c].edge_plane].index()});
        }
        draft_.end_loop();
      }
    }
    for (UntouchedPart part : mesh.parts) {
      for (size_t k = 0; k < 3; ++k) part.translation[k] += t[k];
      part.source += operand.first_source;
      if (operand.appearance) part.appearance = operand.appearance;
      for (UntouchedPart::Shared& shared : part.shared) shared.point += first_point;
      parts_.push_back(std::move(part));
    }
    if (mesh.may_touch && mesh.touches.empty()) touches_anywhere_ = true;
    for (const GridBox& box : mesh.touches) touches_.push_back(box.moved(t));
  }

  BoundaryMesh finish() {
    std::vector<uint32_t> number;
    BoundaryMesh result = canonical(geometry_, planes_, std::move(draft_), &number);
    result.may_touch = touches_anywhere_ || !touches_.empty();
    if (!touches_anywhere_) {
      keep_few(touches_);
      result.touches = std::move(touches_);
    }
    for (UntouchedPart& part : parts_) {
      for (UntouchedPart::Shared& shared : part.shared) shared.point = number[shared.point];
    }
    result.parts = std::move(parts_);
    return result;
  }

 private:
  PlaneTable planes_;
  CellGeometry geometry_;
  DraftBoundary draft_;
  std::vector<UntouchedPart> parts_;
  std::vector<GridBox> touches_;
  bool touches_anywhere_ = false;
};

}  // namespace

std::shared_ptr<const BoundaryMesh> side_by_side(const std::vector<Operand>& operands) {
  if (operands.size() == 1 && !operands[0].appearance && operands[0].first_source == 0 &&
      operands[0].translation == IVec3{0, 0, 0}) {
    return operands[0].boundary;
  }
  Gatherer gatherer;
  for (const Operand& operand : operands) gatherer.add(operand);
  return std::make_shared<BoundaryMesh>(gatherer.finish());
}

}  // namespace csgrun

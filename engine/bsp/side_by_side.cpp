#include "engine/bsp/side_by_side.h"

#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/bsp/canonical_order.h"
#include "engine/bsp/cell_geometry.h"
#include "engine/bsp/enter_planes.h"
#include "engine/bsp/touch_list.h"

namespace csgrun {
namespace {

/// Puts boundaries into one.
class Gatherer {
 public:
  explicit Gatherer(const std::vector<Operand>& operands) : geometry_(planes_, nullptr) {
    size_t planes = 0;
    for (const Operand& operand : operands) planes += operand.boundary->planes.size();
    planes_.make_room(planes);
    for (const Operand& operand : operands) add(operand);
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
  void add(const Operand& operand) {
    const BoundaryMesh& mesh = *operand.boundary;
    const IVec3& t = operand.translation;
    std::vector<PlaneId> plane_of(mesh.planes.size());
    enter_planes(
        planes_, mesh.planes.size(),
        [&](size_t p) { return as_stored(translate_plane(mesh.planes[p], t)); },
        [&](size_t p, const ReducedPlane& plane) { plane_of[p] = planes_.intern_computed(plane); });
    const uint32_t first_point = geometry_.add_points(mesh.point_planes.size());
    for_each_range(mesh.point_planes.size(), [&](size_t begin, size_t end) {
      for (auto p = static_cast<uint32_t>(begin); p < end; ++p) {
        const auto& named = mesh.point_planes[p];
        geometry_.set_point(
            first_point + p,
            {plane_of[named[0]].index(), plane_of[named[1]].index(), plane_of[named[2]].index()},
            rounded_when_moved(mesh, p, t));
      }
    });
    for (const BoundaryMesh::Face& face : mesh.faces) {
      FaceLabel label = face.label;
      label.source += operand.first_source;
      if (operand.appearance) label.appearance = *operand.appearance;
      draft_.add_face(mesh, face, label, first_point, [&](uint32_t p) { return plane_of[p]; });
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
  return std::make_shared<BoundaryMesh>(Gatherer(operands).finish());
}

}  // namespace csgrun

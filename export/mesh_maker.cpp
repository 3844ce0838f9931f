#include "export/mesh_maker.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "export/defects.h"
#include "export/repair.h"
#include "export/text.h"

namespace csgrun {
namespace {

/// Leaves out the outlines of faces that rounding bent: everybody cuts those into other triangles.
void drop_bent_outlines(RoundedMesh& mesh) {
  for (auto& outline : mesh.outlines) {
    if (outline.size() <= 3) continue;
    const auto& p = mesh.positions;
    const auto has_area = [&](size_t k) {
      for (int axis = 0; axis < 3; ++axis) {
        if (orient_along(axis, p[outline[0]], p[outline[1]], p[outline[k]]) != 0) return true;
      }
      return false;
    };
    size_t third = 2;
    while (third < outline.size() && !has_area(third)) ++third;
    const bool flat =
        third < outline.size() && std::all_of(outline.begin(), outline.end(), [&](uint32_t v) {
          return orient(p[outline[0]], p[outline[1]], p[outline[third]], p[v]) == 0;
        });
    if (!flat) outline.clear();
  }
}

/// Leaves out the outlines that triangles around their first corner do not fill: many readers cut
/// polygons so, whatever their outline, and would draw what is not there.
void drop_concave_outlines(RoundedMesh& mesh) {
  const auto& p = mesh.positions;
  for (auto& outline : mesh.outlines) {
    if (outline.size() <= 3) continue;
    // Seen along the axis that it faces most, all these triangles look the same way.
    glm::dvec3 normal(0);
    for (size_t k = 2; k < outline.size(); ++k)
      normal += glm::cross(p[outline[k - 1]] - p[outline[0]], p[outline[k]] - p[outline[0]]);
    int axis = 0;
    for (const int other : {1, 2}) {
      if (std::abs(normal[other]) > std::abs(normal[axis])) axis = other;
    }
    int least = 0, greatest = 0;
    for (size_t k = 2; k < outline.size(); ++k) {
      const int sign = orient_along(axis, p[outline[0]], p[outline[k - 1]], p[outline[k]]);
      least = std::min(least, sign);
      greatest = std::max(greatest, sign);
    }
    const bool fills = (least < 0) != (greatest > 0);
    if (!fills) outline.clear();
  }
}

void add_vanished(const std::vector<SolidShell>& vanished, const Solid& solid, MeshCheck& check) {
  check.vanished = vanished.size();
  for (size_t i = 0; i < vanished.size(); ++i) {
    const SolidShell& shell = vanished[i];
    check.thickness = std::max(check.thickness, shell.thickness());
    if (i >= kMostPlaces) continue;
    DefectPlace place{DefectKind::kVanished, shell.at, {}};
    std::string source = source_text(solid, solid.faces[shell.face].source);
    if (!source.empty()) place.sources.push_back(std::move(source));
    check.places.push_back(std::move(place));
  }
}

double volume_of(const RoundedMesh& mesh) { return exact_volume({mesh.positions, mesh.triangles}); }

}  // namespace

Result<RoundedMesh> MeshMaker::make(const Part& part, const Affine& placement, Precision precision,
                                    bool with_outlines) {
  Result<RoundedMesh> mesh = round_part(*part.solid, placement, precision, with_outlines);
  if (!mesh) return mesh.error();
  if (options_.check) {
    const std::vector<glm::dvec3> directions = face_directions(*part.solid, placement);
    Defects defects = find_defects(*mesh, directions, {}, options_.threads);
    const Result<Fidelity> fidelity = Fidelity::of(*part.solid, placement, precision);
    if (!fidelity) return fidelity.error();
    MeshCheck check;
    check.part = part.name;
    check.found = defects.counts();
    check.triangles[0] = mesh->triangles.size();
    check.volume[0] = volume_of(*mesh);
    check.places = places_of(defects, *mesh, *part.solid);
    check.distance = fidelity->rounding().distance;
    if (!defects.none()) {
      if (const Status status =
              repair(*mesh, directions, precision, *fidelity, options_, defects, check);
          !status) {
        return status.error();
      }
      check.verdict = defects.none() ? CheckVerdict::kRepaired : CheckVerdict::kFailed;
    }
    add_vanished(fidelity->vanished(mesh->triangle_face), *part.solid, check);
    check.left = defects.counts();
    check.triangles[1] = mesh->triangles.size();
    check.volume[1] = volume_of(*mesh);
    mesh->flipped = defects.flipped.size();
    drop_bent_outlines(*mesh);
    report_.checks.push_back(std::move(check));
  }
  if (with_outlines) drop_concave_outlines(*mesh);
  totals_.add(*mesh, part.name);
  return mesh;
}

}  // namespace csgrun

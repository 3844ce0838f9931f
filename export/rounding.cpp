#include "export/rounding.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "export/collapse.h"
#include "export/none.h"

namespace csgrun {
namespace {

uint64_t mixed(uint64_t x) {  // the finaliser of MurmurHash3, by Austin Appleby (public domain)
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdull;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53ull;
  return x ^ (x >> 33);
}

/// Whether two vertices of different exact points have one rounded place.
bool points_met(std::span<const uint32_t> place, std::span<const uint32_t> point_of) {
  std::vector<uint32_t> point_at(place.size(), kNone);
  for (size_t v = 0; v < place.size(); ++v) {
    uint32_t& point = point_at[place[v]];
    if (point == kNone) point = point_of[v];
    if (point != point_of[v]) return true;
  }
  return false;
}

/// Twice the area vector of a loop (Newell), about its first corner to keep digits.
glm::dvec3 area_vector(std::span<const uint32_t> loop, std::span<const glm::dvec3> positions) {
  glm::dvec3 sum(0);
  const glm::dvec3 origin = positions[loop[0]];
  for (size_t i = 1; i + 1 < loop.size(); ++i) {
    sum += glm::cross(positions[loop[i]] - origin, positions[loop[i + 1]] - origin);
  }
  return sum;
}

glm::dvec3 unit_or_zero(const glm::dvec3& v) {
  // Scaled first: the squares of a face of nanometres, times an area, may underflow.
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0)) return glm::dvec3(0);
  const glm::dvec3 scaled = v / largest;
  return scaled / std::sqrt(glm::dot(scaled, scaled));
}

std::span<const uint32_t> loop_of(const Solid& solid, uint32_t loop) {
  return std::span(solid.loop_vertices)
      .subspan(solid.loop_starts[loop], solid.loop_starts[loop + 1] - solid.loop_starts[loop]);
}

std::vector<glm::dvec3> normals_of_faces(const Solid& solid, std::span<const glm::dvec3> positions,
                                         bool mirrored) {
  std::vector<glm::dvec3> normals(solid.faces.size());
  for (size_t f = 0; f < normals.size(); ++f) {
    const glm::dvec3 n =
        unit_or_zero(area_vector(loop_of(solid, solid.faces[f].first_loop), positions));
    normals[f] = n == glm::dvec3(0) ? glm::dvec3(0, 0, 1) : mirrored ? -n : n;
  }
  return normals;
}

bool is_consistent(const Solid& solid) {
  const size_t vertices = solid.positions.size();
  if (solid.positions_f32.size() != vertices || solid.point_of.size() != vertices) return false;
  if (solid.triangle_face.size() != solid.triangles.size()) return false;
  if (solid.loop_starts.empty() || solid.loop_starts.back() != solid.loop_vertices.size())
    return false;
  for (const uint32_t face : solid.triangle_face) {
    if (face >= solid.faces.size()) return false;
  }
  for (const uint32_t v : solid.loop_vertices) {
    if (v >= vertices) return false;
  }
  for (const Solid::Face& face : solid.faces) {
    if (face.loop_count == 0 || face.appearance >= solid.appearances.size()) return false;
    if (size_t{face.first_loop} + face.loop_count >= solid.loop_starts.size()) return false;
    if (loop_of(solid, face.first_loop).size() < 3) return false;
  }
  return true;
}

/// Takes out connected surfaces that rounding pressed into one axis-parallel plane: thin plates,
/// whose two sides need not have the same triangles and so did not cancel.
void remove_flat_shells(CollapsedSurface& surface, std::span<const glm::dvec3> positions) {
  const std::vector<uint32_t> shell = shells_of(surface.twins);
  const size_t count = shell.empty() ? 0 : 1 + *std::max_element(shell.begin(), shell.end());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<glm::dvec3> low(count, glm::dvec3(kInfinity)), high(count, glm::dvec3(-kInfinity));
  for (size_t t = 0; t < shell.size(); ++t) {
    for (const uint32_t v : surface.vertices[t]) {
      low[shell[t]] = glm::min(low[shell[t]], positions[surface.origin[v]]);
      high[shell[t]] = glm::max(high[shell[t]], positions[surface.origin[v]]);
    }
  }
  const auto is_flat = [&](uint32_t s) {
    return low[s].x == high[s].x || low[s].y == high[s].y || low[s].z == high[s].z;
  };
  CollapsedSurface kept;
  kept.dropped = surface.dropped;
  kept.cancelled = surface.cancelled;
  std::vector<uint32_t> new_triangle(shell.size(), kNone), new_vertex(surface.origin.size(), kNone);
  for (uint32_t t = 0; t < shell.size(); ++t) {
    if (is_flat(shell[t])) {
      ++kept.cancelled;
      continue;
    }
    new_triangle[t] = static_cast<uint32_t>(kept.triangles.size());
    kept.triangles.push_back(surface.triangles[t]);
    for (const uint32_t v : surface.vertices[t]) new_vertex[v] = 0;
  }
  if (kept.triangles.size() == surface.triangles.size()) return;
  for (size_t v = 0; v < new_vertex.size(); ++v) {
    if (new_vertex[v] == kNone) continue;
    new_vertex[v] = static_cast<uint32_t>(kept.origin.size());
    kept.origin.push_back(surface.origin[v]);
  }
  for (uint32_t t = 0; t < shell.size(); ++t) {
    if (new_triangle[t] == kNone) continue;
    const Triangle& old = surface.vertices[t];
    kept.vertices.push_back({new_vertex[old[0]], new_vertex[old[1]], new_vertex[old[2]]});
    for (uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      kept.twins.push_back(3 * new_triangle[surface.twins[h] / 3] + surface.twins[h] % 3);
    }
  }
  surface = std::move(kept);
}

/// The outline of each face, if its triangles are a disc without inner vertices, all there and
/// glued to one another as they were. `old_twins` belong to the solid's triangles.
void trace_outlines(const Solid& solid, std::span<const uint32_t> survivors,
                    std::span<const uint32_t> old_twins, RoundedMesh& mesh) {
  std::vector<uint32_t> new_triangle(solid.triangles.size(), kNone);
  for (uint32_t t = 0; t < survivors.size(); ++t) new_triangle[survivors[t]] = t;
  std::vector<std::vector<uint32_t>> triangles_of(solid.faces.size());
  for (uint32_t t = 0; t < solid.triangles.size(); ++t) {
    triangles_of[solid.triangle_face[t]].push_back(t);
  }
  const auto renumbered = [&](uint32_t h) { return 3 * new_triangle[h / 3] + h % 3; };

  mesh.outlines.resize(solid.faces.size());
  for (uint32_t f = 0; f < solid.faces.size(); ++f) {
    const std::span<const uint32_t> loop = loop_of(solid, solid.faces[f].first_loop);
    if (solid.faces[f].loop_count != 1 || triangles_of[f].size() + 2 != loop.size()) continue;
    uint32_t border = kNone;
    bool intact = true;
    size_t border_length = 0;
    for (const uint32_t t : triangles_of[f]) {
      if (new_triangle[t] == kNone) intact = false;
      for (uint32_t h = 3 * t; intact && h < 3 * t + 3; ++h) {
        if (solid.triangle_face[old_twins[h] / 3] == f) {
          const uint32_t other = old_twins[h] / 3;
          if (new_triangle[other] == kNone ||
              mesh.twins[renumbered(h)] != renumbered(old_twins[h])) {
            intact = false;
          }
        } else {
          border = h;
          ++border_length;
        }
      }
    }
    if (!intact || border_length != loop.size()) continue;

    std::vector<uint32_t> outline;
    uint32_t h = border;
    do {
      const uint32_t n = renumbered(h);
      outline.push_back(mesh.triangles[n / 3][n % 3]);
      h = next_in_triangle(h);
      while (solid.triangle_face[old_twins[h] / 3] == f) h = next_in_triangle(old_twins[h]);
    } while (h != border && outline.size() <= loop.size());
    std::vector<uint32_t> distinct = outline;
    std::sort(distinct.begin(), distinct.end());
    if (outline.size() != loop.size() ||
        std::adjacent_find(distinct.begin(), distinct.end()) != distinct.end()) {
      continue;
    }
    // From the smallest vertex on, whichever triangle the walk began in.
    std::rotate(outline.begin(), std::min_element(outline.begin(), outline.end()), outline.end());
    mesh.outlines[f] = std::move(outline);
  }
}

void reverse_orientation(RoundedMesh& mesh) {
  // Corners a b c become a c b: the half-edges ab, bc, ca become ca, bc, ab, reversed.
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  std::vector<uint32_t> twins(mesh.twins.size());
  const auto turned = [](uint32_t h) { return h - h % 3 + (2 - h % 3); };
  for (uint32_t h = 0; h < twins.size(); ++h) twins[turned(h)] = turned(mesh.twins[h]);
  mesh.twins = std::move(twins);
  for (auto& outline : mesh.outlines) {
    if (!outline.empty()) std::reverse(outline.begin() + 1, outline.end());
  }
}

uint64_t count_flipped(const RoundedMesh& mesh) {
  // The cross product of edges e is wrong by a few |e|^2 2^-53; what is smaller has no side.
  constexpr double kNoise = 0x1p-49;
  uint64_t flipped = 0;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const glm::dvec3 ab = mesh.positions[b] - mesh.positions[a];
    const glm::dvec3 ac = mesh.positions[c] - mesh.positions[a];
    const double side = glm::dot(glm::cross(ab, ac), mesh.face_normals[mesh.triangle_face[t]]);
    if (side < -kNoise * (glm::dot(ab, ab) + glm::dot(ac, ac))) ++flipped;
  }
  return flipped;
}

}  // namespace

std::vector<uint32_t> number_places(std::span<const glm::dvec3> positions) {
  // Open addressing: only the numbers leave, so the order of the table does not show.
  std::vector<uint32_t> table(std::bit_ceil(2 * positions.size() + 1), kNone);
  std::vector<uint32_t> place(positions.size());
  std::vector<uint32_t> first_at;  // per place: the first vertex there
  for (uint32_t v = 0; v < positions.size(); ++v) {
    const glm::dvec3& p = positions[v];
    uint64_t hash = mixed(std::bit_cast<uint64_t>(p.x));
    hash = mixed(hash + std::bit_cast<uint64_t>(p.y));
    hash = mixed(hash + std::bit_cast<uint64_t>(p.z));
    size_t slot = hash & (table.size() - 1);
    while (table[slot] != kNone && positions[first_at[table[slot]]] != p) {
      slot = (slot + 1) & (table.size() - 1);
    }
    if (table[slot] == kNone) {
      table[slot] = static_cast<uint32_t>(first_at.size());
      first_at.push_back(v);
    }
    place[v] = table[slot];
  }
  return place;
}

std::vector<glm::dvec3> positions_of_places(std::span<const glm::dvec3> positions,
                                            std::span<const uint32_t> place) {
  std::vector<glm::dvec3> points;
  for (size_t v = 0; v < place.size(); ++v) {
    if (place[v] == points.size()) points.push_back(positions[v]);
  }
  return points;
}

PlacedSolid place_solid(const Solid& solid, const Affine& placement) {
  PlacedSolid placed;
  placed.positions = solid.positions;
  if (placement != Affine{}) {
    const auto& m = placement.m;
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    placed.mirrored = determinant < 0;
    for (glm::dvec3& p : placed.positions) p = placement.apply(p);
  }
  placed.face_normals = normals_of_faces(solid, placed.positions, placed.mirrored);
  return placed;
}

Result<RoundedMesh> round_part(const Solid& solid, const Affine& placement, Precision precision,
                               bool with_outlines) {
  if (!is_consistent(solid)) {
    return Error{
        ErrorCode::kInternal, "the arrays of a solid to be written do not fit together", {}};
  }
  PlacedSolid placed = place_solid(solid, placement);
  std::vector<glm::dvec3> rounded = std::move(placed.positions);
  if (precision == Precision::kFloat) {
    for (size_t v = 0; v < rounded.size(); ++v) {
      // Unmoved, the engine has rounded the exact value already; twice would be once too often.
      const auto& f = solid.positions_f32[v];
      rounded[v] = placement == Affine{} ? glm::dvec3(f[0], f[1], f[2])
                                         : glm::dvec3(static_cast<float>(rounded[v].x),
                                                      static_cast<float>(rounded[v].y),
                                                      static_cast<float>(rounded[v].z));
    }
  }
  for (glm::dvec3& p : rounded) {
    p += 0.0;  // no -0: equal places have equal bytes
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      return Error{ErrorCode::kOutOfRange, "a coordinate is too large for the file's format", {}};
    }
  }

  Result<std::vector<uint32_t>> solid_twins = manifold_twins(solid.triangles, rounded.size());
  if (!solid_twins) return solid_twins.error();
  const std::vector<uint32_t> place = number_places(rounded);
  CollapsedSurface surface;
  const bool any_met = points_met(place, solid.point_of);
  if (any_met) {
    surface = collapse(solid.triangles, *solid_twins, place);
    remove_flat_shells(surface, rounded);
  } else {
    surface.triangles.resize(solid.triangles.size());
    surface.origin.resize(rounded.size());
    for (uint32_t t = 0; t < surface.triangles.size(); ++t) surface.triangles[t] = t;
    for (uint32_t v = 0; v < surface.origin.size(); ++v) surface.origin[v] = v;
    surface.vertices = solid.triangles;
    surface.twins = *solid_twins;
  }

  RoundedMesh mesh;
  mesh.dropped = surface.dropped;
  mesh.cancelled = surface.cancelled;
  mesh.face_normals = std::move(placed.face_normals);
  mesh.positions.reserve(surface.origin.size());
  for (const uint32_t v : surface.origin) mesh.positions.push_back(rounded[v]);
  mesh.triangles = std::move(surface.vertices);
  mesh.twins = std::move(surface.twins);
  for (const uint32_t t : surface.triangles) mesh.triangle_face.push_back(solid.triangle_face[t]);
  if (with_outlines) trace_outlines(solid, surface.triangles, *solid_twins, mesh);
  if (placed.mirrored) reverse_orientation(mesh);
  mesh.flipped = count_flipped(mesh);

  // The check that every file must pass, on the very arrays that are written: where nothing met,
  // and nothing was turned over, they are those that passed it.
  if (!any_met && !placed.mirrored) return mesh;
  Result<std::vector<uint32_t>> twins = manifold_twins(mesh.triangles, mesh.positions.size());
  if (!twins) return twins.error();
  if (*twins != mesh.twins) {
    return Error{ErrorCode::kInternal, "edges are not glued as the indices of the mesh say", {}};
  }
  return mesh;
}

Status move_vertices(RoundedMesh& mesh, std::vector<glm::dvec3> positions) {
  CollapsedSurface surface = collapse(mesh.triangles, mesh.twins, number_places(positions));
  remove_flat_shells(surface, positions);
  mesh.dropped += surface.dropped;
  mesh.cancelled += surface.cancelled;
  mesh.positions.clear();
  for (const uint32_t v : surface.origin) mesh.positions.push_back(positions[v]);
  std::vector<uint32_t> faces;
  for (const uint32_t t : surface.triangles) faces.push_back(mesh.triangle_face[t]);
  mesh.triangle_face = std::move(faces);
  mesh.triangles = std::move(surface.vertices);
  mesh.twins = std::move(surface.twins);
  for (auto& outline : mesh.outlines) outline.clear();
  Result<std::vector<uint32_t>> twins = manifold_twins(mesh.triangles, mesh.positions.size());
  if (!twins) return twins.error();
  return std::monostate{};
}

void RoundingTotals::add(const RoundedMesh& mesh, const std::string& part) {
  if (mesh.triangles.empty() && !mesh.face_normals.empty()) {  // there was something to be written
    vanished_.add(1, part);
    return;
  }
  dropped_.add(mesh.dropped, part);
  cancelled_.add(mesh.cancelled, part);
  flipped_.add(mesh.flipped, part);
}

void RoundingTotals::Kind::add(uint64_t more, const std::string& part) {
  if (more == 0) return;
  if (count == 0) first_part = part;
  count += more;
  ++parts;
}

void RoundingTotals::report(WriteReport& report) const {
  const auto quoted = [](const Kind& kind) { return "'" + kind.first_part + "'"; };
  if (vanished_.count == 1) {
    report.warnings.push_back(
        (vanished_.first_part.empty() ? "the solid" : "part " + quoted(vanished_)) +
        " is thinner than the file's precision and was written empty");
  } else if (vanished_.count > 1) {
    report.warnings.push_back(std::to_string(vanished_.count) +
                              " parts are thinner than the file's precision and were written "
                              "empty, the first is " +
                              quoted(vanished_));
  }
  const auto triangles = [&](const Kind& kind, const char* one, const char* many) {
    if (kind.count == 0) return;
    std::string of;
    if (kind.parts > 1) {
      of = " of " + std::to_string(kind.parts) + " parts";
    } else if (!kind.first_part.empty()) {
      of = " of part " + quoted(kind);
    }
    report.warnings.push_back(std::to_string(kind.count) + (kind.count == 1
                                                                ? " triangle" + of + one
                                                                : " triangles" + of + many));
  };
  triangles(dropped_, " thinner than the file's precision was dropped",
            " thinner than the file's precision were dropped");
  triangles(cancelled_, " that rounding laid on another was cancelled",
            " that rounding laid on one another were cancelled");
  triangles(flipped_, " turned over by rounding", " turned over by rounding");
}

}  // namespace csgrun

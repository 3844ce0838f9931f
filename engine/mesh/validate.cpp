#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <csgrun/engine/validate.h>

#include "engine/base/none.h"
#include "engine/mesh/flat_points.h"
#include "engine/mesh/mesh_lists.h"
#include "engine/mesh/mesh_text.h"

namespace csgrun {
namespace {

constexpr size_t kPlacesPerKind = 5;
constexpr const char* kOpen = "open edge ";
constexpr const char* kMisoriented = "edge with faces of opposite orientation ";
constexpr const char* kDegenerate = "degenerate face ";
constexpr const char* kBadIndex = "bad index ";
constexpr const char* kNonFinite = "point that is not finite ";

class Places {
 public:
  explicit Places(std::vector<std::string>& all) : all_(all) {}
  [[nodiscard]] bool wanted() const { return count_ < kPlacesPerKind; }
  void add(std::string text) {
    ++count_;
    all_.push_back(std::move(text));
  }

 private:
  std::vector<std::string>& all_;
  size_t count_ = 0;
};

bool loop_is_degenerate(const PolygonMesh& mesh, uint32_t begin, uint32_t end) {
  if (end - begin < 3) return true;
  for (uint32_t i = begin; i < end; ++i) {
    if (mesh.corners[i] == mesh.corners[i + 1 < end ? i + 1 : begin]) return true;
  }
  return false;
}

/// Whether all corners of a face lie on one line.
bool has_no_area(const PolygonMesh& mesh, uint32_t face) {
  return is_flat(mesh.points, {mesh.corners.data() + mesh.loop_starts[mesh.face_starts[face]],
                               mesh.corners.data() + mesh.loop_starts[mesh.face_starts[face + 1]]});
}

std::string face_text(const PolygonMesh& mesh, uint32_t face) {
  std::string text = std::to_string(face) + " at ";
  const uint32_t begin = mesh.loop_starts[mesh.face_starts[face]];
  const uint32_t end = mesh.loop_starts[mesh.face_starts[face + 1]];
  if (begin == end) return std::to_string(face) + " without corners";
  return text + place_text(mesh.points[mesh.corners[begin]]);
}

struct EdgeWay {
  uint32_t other;   ///< the end of greater index
  uint32_t corner;  ///< where the edge starts
  bool forward;     ///< from the end of smaller index to the other
};

struct UnbalancedEdge {
  uint32_t corner, from, to;
  uint32_t excess;  ///< how many more run this way than back
};

/// All edges that do not run as often back as forth, in the order of the corners.
std::vector<UnbalancedEdge> unbalanced_edges(const PolygonMesh& mesh) {
  // Edges are grouped by the end of smaller index first: groups are short, so sorting is cheap.
  std::vector<uint32_t> starts(mesh.points.size() + 1, 0);
  const auto for_each_edge = [&](auto visit) {
    for (size_t l = 0; l < mesh.loop_count(); ++l) {
      const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
      for (uint32_t i = begin; i < end; ++i) {
        const uint32_t a = mesh.corners[i], b = mesh.corners[i + 1 < end ? i + 1 : begin];
        if (a != b && std::max(a, b) < mesh.points.size()) visit(i, a, b);
      }
    }
  };
  for_each_edge([&](uint32_t, uint32_t a, uint32_t b) { ++starts[std::min(a, b) + 1]; });
  for (size_t v = 0; v < mesh.points.size(); ++v) starts[v + 1] += starts[v];
  std::vector<EdgeWay> edges(starts.back());
  std::vector<uint32_t> next = starts;
  for_each_edge([&](uint32_t corner, uint32_t a, uint32_t b) {
    edges[next[std::min(a, b)]++] = {std::max(a, b), corner, a < b};
  });

  std::vector<UnbalancedEdge> found;
  for (uint32_t v = 0; v < mesh.points.size(); ++v) {
    const auto begin = edges.begin() + starts[v], end = edges.begin() + starts[v + 1];
    std::sort(begin, end, [](const EdgeWay& a, const EdgeWay& b) {
      return a.other != b.other ? a.other < b.other : a.corner < b.corner;
    });
    for (auto e = begin; e != end;) {
      const auto first = e;
      int64_t balance = 0;
      for (; e != end && e->other == first->other; ++e) balance += e->forward ? 1 : -1;
      if (balance == 0) continue;
      const bool forward = balance > 0;
      const auto shown =
          std::find_if(first, e, [&](const EdgeWay& d) { return d.forward == forward; });
      found.push_back({shown->corner, forward ? v : first->other, forward ? first->other : v,
                       static_cast<uint32_t>(std::abs(balance))});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const UnbalancedEdge& a, const UnbalancedEdge& b) { return a.corner < b.corner; });
  return found;
}

}  // namespace

std::string MeshReport::text() const {
  std::string out;
  const auto part = [&](uint64_t count, const char* one, const char* many, const char* prefix) {
    if (count == 0) return;
    if (!out.empty()) out += ", ";
    out += std::to_string(count) + " " + (count == 1 ? one : many);
    const std::string start = prefix;
    for (const std::string& entry : first_places) {
      if (entry.compare(0, start.size(), start) != 0) continue;
      out += (count == 1 ? " (" : " (first: ") + entry.substr(start.size()) + ")";
      break;
    }
  };
  part(bad_indices, "bad index", "bad indices", kBadIndex);
  part(non_finite_points, "point that is not finite", "points that are not finite", kNonFinite);
  part(degenerate_faces, "degenerate face", "degenerate faces", "degenerate ");
  part(open_edges, "open edge", "open edges", kOpen);
  part(misoriented_edges, "edge with faces of opposite orientation",
       "edges with faces of opposite orientation", kMisoriented);
  return out;
}

MeshReport check_mesh(const PolygonMesh& mesh) {
  MeshReport report;
  Places bad(report.first_places), infinite(report.first_places), flat(report.first_places),
      open(report.first_places), misoriented(report.first_places);
  if (!has_sound_lists(mesh)) {
    report.bad_indices = 1;
    bad.add(std::string(kBadIndex) + "in the lists of loops and faces");
    return report;
  }
  for (size_t i = 0; i < mesh.corners.size(); ++i) {
    if (mesh.corners[i] < mesh.points.size()) continue;
    ++report.bad_indices;
    if (bad.wanted()) {
      bad.add(kBadIndex + std::to_string(mesh.corners[i]) + " of " +
              std::to_string(mesh.points.size()) + " points");
    }
  }
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    const glm::dvec3& p = mesh.points[i];
    if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) continue;
    ++report.non_finite_points;
    if (infinite.wanted()) infinite.add(kNonFinite + std::to_string(i) + " " + place_text(p));
  }
  for (uint32_t f = 0; f < mesh.face_count(); ++f) {
    const uint32_t first = mesh.face_starts[f], last = mesh.face_starts[f + 1];
    const auto corner_is_bad = [&](uint32_t v) {
      return v >= mesh.points.size() || !std::isfinite(mesh.points[v].x) ||
             !std::isfinite(mesh.points[v].y) || !std::isfinite(mesh.points[v].z);
    };
    if (std::any_of(mesh.corners.begin() + mesh.loop_starts[first],
                    mesh.corners.begin() + mesh.loop_starts[last], corner_is_bad)) {
      continue;  // reported above
    }
    bool degenerate = first == last;
    for (uint32_t l = first; l < last; ++l) {
      degenerate =
          degenerate || loop_is_degenerate(mesh, mesh.loop_starts[l], mesh.loop_starts[l + 1]);
    }
    if (!degenerate && !has_no_area(mesh, f)) continue;
    ++report.degenerate_faces;
    if (flat.wanted()) flat.add(kDegenerate + face_text(mesh, f));
  }

  // Of the edges in excess in one direction two and two face each other the wrong way; one that is
  // left over has no partner at all.
  const std::vector<UnbalancedEdge> edges = unbalanced_edges(mesh);
  const auto edge_text = [&](const UnbalancedEdge& e) {
    return place_text(mesh.points[e.from]) + " - " + place_text(mesh.points[e.to]);
  };
  for (const UnbalancedEdge& e : edges) {
    if (e.excess % 2 == 0) continue;
    ++report.open_edges;
    if (open.wanted()) open.add(kOpen + edge_text(e));
  }
  for (const UnbalancedEdge& e : edges) {
    if (e.excess < 2) continue;
    report.misoriented_edges += e.excess / 2;
    if (misoriented.wanted()) misoriented.add(kMisoriented + edge_text(e));
  }
  return report;
}

void weld_points(PolygonMesh& mesh) {
  std::vector<bool> used(mesh.points.size());
  for (uint32_t v : mesh.corners) {
    if (v < used.size()) used[v] = true;
  }
  // An open hash table of the points kept; it is only asked, never walked through.
  std::vector<uint32_t> table(std::bit_ceil(mesh.points.size() * 2 + 1), kNone);
  const size_t mask = table.size() - 1;
  const auto hash = [](const glm::dvec3& p) {
    uint64_t h = 0x9e3779b97f4a7c15ULL;
    for (int k = 0; k < 3; ++k) {
      h = (h ^ std::bit_cast<uint64_t>(p[k])) * 0xff51afd7ed558ccdULL;
      h ^= h >> 32;
    }
    return h;
  };
  std::vector<uint32_t> renamed(mesh.points.size(), kNone);
  uint32_t kept = 0;
  for (size_t i = 0; i < mesh.points.size(); ++i) {
    if (!used[i]) continue;
    const glm::dvec3 p = mesh.points[i] + glm::dvec3(0.0);  // -0 becomes +0, its equal
    size_t at = hash(p) & mask;
    while (table[at] != kNone && mesh.points[table[at]] != p) at = (at + 1) & mask;
    if (table[at] == kNone) {
      mesh.points[kept] = p;
      table[at] = kept++;
    }
    renamed[i] = table[at];
  }
  mesh.points.resize(kept);
  for (uint32_t& v : mesh.corners) {
    if (v < renamed.size()) v = renamed[v];
  }
}

double signed_volume(const PolygonMesh& mesh) {
  if (mesh.corners.empty()) return 0;
  const glm::dvec3 origin = mesh.points[mesh.corners[0]];
  double six_volumes = 0;
  for (size_t l = 0; l < mesh.loop_count(); ++l) {
    const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
    if (begin == end) continue;
    const glm::dvec3 a = mesh.points[mesh.corners[begin]] - origin;
    for (uint32_t i = begin + 1; i + 1 < end; ++i) {
      const glm::dvec3 b = mesh.points[mesh.corners[i]] - origin;
      const glm::dvec3 c = mesh.points[mesh.corners[i + 1]] - origin;
      six_volumes += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) +
                     a.z * (b.x * c.y - b.y * c.x);
    }
  }
  return six_volumes / 6;
}

void reverse_faces(PolygonMesh& mesh) {
  for (size_t l = 0; l < mesh.loop_count(); ++l) {
    std::reverse(mesh.corners.begin() + mesh.loop_starts[l],
                 mesh.corners.begin() + mesh.loop_starts[l + 1]);
  }
}

}  // namespace csgrun

#include "tests/support/kernel_checks.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "tests/support/conformity.h"
#include "tests/support/exact_measures.h"

namespace csgrun::test {
namespace {

/// Solids of so many triangles have all pairs of them tried.
constexpr size_t kMostForPairs = 600;

}  // namespace

int cases(int ordinary) {
  const char* given = std::getenv("CSGRUN_CASES");
  return given ? std::atoi(given) : ordinary;
}

Query random_query(Random& random, const ExactSolid& s) {
  const auto pick = [&]() -> const Rational3& {
    return s
        .points[static_cast<size_t>(random.integer(0, static_cast<int64_t>(s.points.size()) - 1))];
  };
  const Rational3 &p = pick(), &r = pick();
  const double t = random.unit();
  const int shrink = static_cast<int>(random.integer(0, 10));
  Query q{};
  for (int k = 0; k < 3; ++k) {
    const double a = p[k].get_d(), b = r[k].get_d();
    const double reach = std::ldexp(1 + std::fabs(b - a), -shrink);
    q[k] = a + t * (b - a) + (random.unit() - 0.5) * reach;
  }
  return q;
}

std::string disagreement(Random& random, const Tree& tree, const std::vector<Oracle>& leaves,
                         const BoundaryMesh& result, int points) {
  const Oracle oracle(exact_solid(result));
  for (int i = 0; i < points; ++i) {
    const auto which = static_cast<size_t>(random.integer(0, static_cast<int64_t>(leaves.size())));
    const bool of_result = which == leaves.size() && !oracle.solid().points.empty();
    const Query q =
        random_query(random, of_result ? oracle.solid() : leaves[which % leaves.size()].solid());
    const auto at = [&] {
      return " at " + std::to_string(q[0]) + " " + std::to_string(q[1]) + " " +
             std::to_string(q[2]);
    };
    std::vector<bool> inside;
    for (const Oracle& o : leaves) {
      const auto w = o.winding(q);
      if (!w) break;  // on the boundary
      if (*w != 0 && *w != 1) return "a leaf is not sound" + at();
      inside.push_back(*w == 1);
    }
    const auto w = oracle.winding(q);
    if (inside.size() < leaves.size() || !w) continue;
    if (*w != (tree.inside(inside) ? 1 : 0)) {
      return "winding number " + std::to_string(*w) + " of " + tree.text() + at();
    }
  }
  return "";
}

KernelOptions random_options(Random& random) {
  KernelOptions o;
  constexpr uint32_t kLimits[] = {1, 3, 9, 17, 33};
  o.cell_limit = kLimits[random.integer(0, 4)];
  for (auto& s : o.octree_shift) s = static_cast<uint32_t>(random.integer(0, 5));
  o.whole_faces = random.integer(0, 3) != 0;
  return o;
}

Tree random_tree(Random& random, int first, int last) {
  if (first == last) return leaf(first);
  Tree t;
  t.op = static_cast<BooleanOp>(random.integer(0, 3));
  int at = first;
  while (at <= last) {
    // At least two children: the first never takes everything.
    const int end = static_cast<int>(random.integer(at, at == first ? last - 1 : last));
    t.children.push_back(random_tree(random, at, end));
    at = end + 1;
  }
  return t;
}

std::string fault_in(const Solid& solid) {
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> apex;  // directed edge -> the third corner
  for (const auto& t : solid.triangles) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] >= solid.positions.size()) return "an index out of range";
      if (!apex.emplace(std::pair(t[k], t[(k + 1) % 3]), t[(k + 2) % 3]).second) {
        return "a directed edge twice: " + std::to_string(t[k]) + " " +
               std::to_string(t[(k + 1) % 3]);
      }
    }
  }
  std::vector<uint32_t> degree(solid.positions.size(), 0), start(solid.positions.size(), 0);
  for (const auto& [edge, third] : apex) {
    if (!apex.count({edge.second, edge.first})) return "an open edge";
    ++degree[edge.first];
    start[edge.first] = edge.second;
  }
  for (uint32_t v = 0; v < degree.size(); ++v) {
    if (degree[v] == 0) return "a vertex that no triangle uses";
    uint32_t around = 0, at = start[v];
    do {
      at = apex.at({v, at});
      ++around;
    } while (at != start[v]);
    if (around != degree[v]) return "a vertex with several fans: " + std::to_string(v);
  }
  return "";
}

namespace {

/// Empty when the measures are those of the exact triangles: volume, centroid and box correctly
/// rounded, area within one unit in the last place. `at` gives a vertex' exact point.
template <class At>
std::string fault_in_measures(const Solid& solid, At&& at) {
  if (solid.empty()) return solid.measures.volume == 0 ? "" : "an empty solid has a volume";
  mpq_class six = 0;
  Rational3 moment{0, 0, 0};  // 24 times the volume, times the centroid
  mpf_class twice_area(0, 512);
  Rational3 lo = at(0), hi = at(0);
  for (const auto& [i, j, k] : solid.triangles) {
    const Rational3 &a = at(i), &b = at(j), &c = at(k);
    const mpq_class v = dot(a, cross(b, c));
    six += v;
    for (int x = 0; x < 3; ++x) {
      moment[x] += v * (a[x] + b[x] + c[x]);
      for (const Rational3* p : {&a, &b, &c}) {
        lo[x] = std::min(lo[x], (*p)[x]);
        hi[x] = std::max(hi[x], (*p)[x]);
      }
    }
    const Rational3 n = cross(minus(b, a), minus(c, a));
    twice_area += sqrt(mpf_class(dot(n, n), 512));
  }
  const Measures& m = solid.measures;
  if (!is_correctly_rounded(six / 6, m.volume)) return "the volume is not correctly rounded";
  const mpf_class error = abs(twice_area / 2 - mpf_class(m.area, 512));
  if (error > std::nextafter(m.area, HUGE_VAL) - m.area) return "the area is wrong";
  for (int x = 0; x < 3; ++x) {
    if (!is_correctly_rounded(moment[x] / (4 * six), m.centroid[x])) return "the centroid is wrong";
    if (!is_correctly_rounded(lo[x], m.bbox[0][x]) || !is_correctly_rounded(hi[x], m.bbox[1][x])) {
      return "the box is wrong";
    }
  }
  return "";
}

}  // namespace

std::vector<Rational3> exact_points(const Solid& solid) {
  std::vector<Rational3> points;
  for (const auto& text : solid.exact_points) {
    points.emplace_back();
    for (int k = 0; k < 3; ++k) points.back()[k] = mpq_class(text[k].empty() ? "0" : text[k]);
  }
  return points;
}

std::string fault_in(const Solid& solid, const BoundaryMesh& mesh) {
  if (const auto fault = fault_in(solid); !fault.empty()) return fault;
  const ExactSolid exact = exact_solid(mesh);
  // The mesh's points and, where edges of solids in contact cross or are divided, a few more.
  const std::vector<Rational3> points = exact_points(solid);
  for (const uint32_t p : solid.point_of) {
    if (p < exact.points.size() && points[p] != exact.points[p]) return "a point is another one";
  }
  const auto at = [&](uint32_t v) -> const Rational3& { return points[solid.point_of[v]]; };
  ExactSolid flat;  // the presented faces over exact points
  flat.points = points;
  for (const Solid::Face& f : solid.faces) {
    flat.faces.emplace_back();
    for (uint32_t l = f.first_loop; l < f.first_loop + f.loop_count; ++l) {
      auto& loop = flat.faces.back().loops.emplace_back();
      for (uint32_t c = solid.loop_starts[l]; c < solid.loop_starts[l + 1]; ++c) {
        loop.push_back(solid.point_of[solid.loop_vertices[c]]);
      }
    }
  }
  std::vector<Rational3> area(solid.faces.size());
  std::vector<Rational3> whole;
  for (const auto& face : flat.faces) whole.push_back(area_vector(flat, face));
  mpq_class six = 0;
  for (size_t t = 0; t < solid.triangles.size(); ++t) {
    const auto& [a, b, c] = solid.triangles[t];
    const uint32_t f = solid.triangle_face[t];
    const Rational3 n = cross(minus(at(b), at(a)), minus(at(c), at(a)));
    if (cross(n, whole[f]) != Rational3{0, 0, 0}) return "a triangle leaves the plane of its face";
    if (dot(n, whole[f]) <= 0) return "a triangle is turned over or has no area";
    for (int k = 0; k < 3; ++k) area[f][k] += n[k];
    six += dot(at(a), cross(at(b), at(c)));
  }
  if (area != whole) return "triangles do not add up to their face";
  if (six / 6 != volume(exact)) return "triangles do not add up to the volume";
  for (size_t v = 0; v < solid.positions.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      if (!is_correctly_rounded(at(static_cast<uint32_t>(v))[k], solid.positions[v][k])) {
        return "a position is not correctly rounded";
      }
    }
  }
  if (solid.triangles.size() <= kMostForPairs) {
    if (const auto fault = fault_in_contacts(solid, at); !fault.empty()) return fault;
  }
  return fault_in_measures(solid, at);
}

}  // namespace csgrun::test

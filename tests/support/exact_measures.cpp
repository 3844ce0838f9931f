#include "tests/support/exact_measures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/operand.h"
#include "tests/support/gmp_bridge.h"

namespace csgrun::test {

Rational3 area_vector(const ExactSolid& s, const ExactSolid::Face& face) {
  const Rational3& apex = s.points[face.loops[0][0]];
  Rational3 sum{0, 0, 0};
  for (const auto& loop : face.loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const Rational3 c = cross(minus(s.points[loop[i]], apex),
                                minus(s.points[loop[i + 1 < loop.size() ? i + 1 : 0]], apex));
      for (int k = 0; k < 3; ++k) sum[k] += c[k];
    }
  }
  return sum;
}

mpq_class volume(const ExactSolid& s) {
  mpq_class six = 0;
  for (const auto& face : s.faces) six += dot(s.points[face.loops[0][0]], area_vector(s, face));
  return six / 6;
}

mpq_class volume(const BoundaryMesh& mesh) { return volume(exact_solid(mesh)); }

bool is_correctly_rounded(const mpq_class& exact, double rounded) {
  const mpq_class r(rounded);
  const mpq_class error = abs(exact - r);
  for (const double towards : {-HUGE_VAL, HUGE_VAL}) {
    const mpq_class gap = abs(mpq_class(std::nextafter(rounded, towards)) - r) / 2;
    const bool on_that_side = towards > 0 ? exact > r : exact < r;
    if (!on_that_side) continue;
    if (error > gap) return false;
    if (error == gap) {
      int exponent;
      const double mantissa = std::frexp(rounded, &exponent);
      if (std::fmod(std::ldexp(mantissa, 53), 2.0) != 0) return false;
    }
  }
  return true;
}

namespace {

/// A line by value: direction as coprime integers with the first non-zero one positive, and moment.
struct ExactLine {
  std::array<mpz_class, 3> direction;
  Rational3 moment;
  bool operator<(const ExactLine& o) const {
    return std::tie(direction, moment) < std::tie(o.direction, o.moment);
  }
};

ExactLine line_through(const Rational3& a, const Rational3& b, bool& reversed) {
  Rational3 d = minus(b, a);
  mpz_class common = 1, divisor = 0;
  for (auto& x : d) common = lcm(common, x.get_den());
  ExactLine line;
  for (int k = 0; k < 3; ++k) line.direction[k] = mpq_class(d[k] * common).get_num();
  for (const auto& x : line.direction) divisor = gcd(divisor, x);
  reversed = false;
  for (const auto& x : line.direction) {
    if (x == 0) continue;
    reversed = x < 0;
    break;
  }
  for (auto& x : line.direction) x /= reversed ? mpz_class(-divisor) : divisor;
  line.moment = cross(a, {line.direction[0], line.direction[1], line.direction[2]});
  return line;
}

/// Empty when the directed edges of all faces balance on every line: the surface is closed. Where
/// edges overlap only in part (T-junctions) each stretch is looked at on its own.
std::string unbalanced_line(const ExactSolid& s) {
  std::map<ExactLine, std::vector<std::pair<mpq_class, int>>> lines;
  for (const auto& face : s.faces) {
    for (const auto& loop : face.loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const Rational3 &a = s.points[loop[i]],
                        &b = s.points[loop[i + 1 < loop.size() ? i + 1 : 0]];
        if (a == b) return "an edge of length 0";
        bool reversed;
        ExactLine line = line_through(a, b, reversed);
        int axis = 0;
        while (line.direction[axis] == 0) ++axis;
        auto& events = lines[std::move(line)];
        events.emplace_back(a[axis], 1);
        events.emplace_back(b[axis], -1);
      }
    }
  }
  for (auto& [line, events] : lines) {
    std::map<mpq_class, int> net;
    for (const auto& [at, change] : events) net[at] += change;
    for (const auto& [at, change] : net) {
      if (change != 0) {
        return "edges do not balance at " + at.get_str() + " on a line with direction " +
               line.direction[0].get_str() + " " + line.direction[1].get_str() + " " +
               line.direction[2].get_str();
      }
    }
  }
  return "";
}

}  // namespace

std::string fault_in(const BoundaryMesh& mesh) {
  const auto at_face = [](size_t f) { return " (face " + std::to_string(f) + ")"; };
  if (mesh.loop_starts.front() != 0 || mesh.loop_starts.back() != mesh.corners.size()) {
    return "loop_starts do not span the corners";
  }
  for (size_t p = 0; p < mesh.point_planes.size(); ++p) {
    const auto& t = mesh.point_planes[p];
    const auto n = [&](int i) {
      const Plane& s = mesh.planes[t[i]];
      return Rational3{to_gmp(s.a), to_gmp(s.b), to_gmp(s.c)};
    };
    if (dot(n(0), cross(n(1), n(2))) == 0) {
      return "the planes of point " + std::to_string(p) + " do not meet in a point";
    }
  }
  const ExactSolid s = exact_solid(mesh);
  for (size_t p = 0; p < s.points.size(); ++p) {
    for (int k = 0; k < 3; ++k) {
      if (!is_correctly_rounded(s.points[p][k], mesh.point_rounded[p][k])) {
        return "point " + std::to_string(p) + " is not correctly rounded";
      }
    }
    if (p > 0 && !(s.points[p - 1] < s.points[p])) return "points out of order or twice";
  }
  std::set<std::tuple<uint32_t, FaceLabel>> seen;
  std::vector<uint8_t> used(s.points.size(), 0);
  for (size_t f = 0; f < mesh.faces.size(); ++f) {
    const BoundaryMesh::Face& face = mesh.faces[f];
    if (!seen.emplace(face.plane.value(), face.label).second) {
      return "two faces of one plane, side and label" + at_face(f);
    }
    Plane plane = mesh.planes[face.plane.index()];
    if (face.plane.flipped()) plane = plane.reversed();
    const Rational3 normal{to_gmp(plane.a), to_gmp(plane.b), to_gmp(plane.c)};
    const auto value = [&](const Plane& q, const Rational3& x) -> mpq_class {
      return dot({to_gmp(q.a), to_gmp(q.b), to_gmp(q.c)}, x) + to_gmp(q.d);
    };
    if (dot(area_vector(s, s.faces[f]), normal) <= 0)
      return "a face has no positive area" + at_face(f);
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = mesh.loop_starts[l], n = mesh.loop_starts[l + 1] - begin;
      if (n < 3) return "a loop of fewer than three corners" + at_face(f);
      for (uint32_t i = 0; i < n; ++i) {
        const BoundaryMesh::Corner &c = mesh.corners[begin + i],
                                   &d = mesh.corners[begin + (i + 1) % n];
        const Rational3 &before = s.points[mesh.corners[begin + (i + n - 1) % n].point],
                        &here = s.points[c.point], &after = s.points[d.point];
        used[c.point] = 1;
        if (value(plane, here) != 0) return "a corner is off its plane" + at_face(f);
        const Plane& edge = mesh.planes[c.edge_plane];
        if (value(edge, here) != 0 || value(edge, after) != 0) {
          return "an edge is off its plane" + at_face(f);
        }
        const Rational3 across = cross(normal, {to_gmp(edge.a), to_gmp(edge.b), to_gmp(edge.c)});
        if (across == Rational3{0, 0, 0}) return "an edge's plane is the face's" + at_face(f);
        if (cross(minus(here, before), minus(after, here)) == Rational3{0, 0, 0}) {
          return "a corner that is none at point " + std::to_string(c.point) + at_face(f);
        }
      }
    }
  }
  if (std::find(used.begin(), used.end(), 0) != used.end()) return "a point that no loop uses";
  return unbalanced_line(s);
}

uint64_t six_volumes_residue(const BoundaryMesh& mesh, int which) {
  const Residues r(kPrimes[which]);
  using V = std::array<uint64_t, 3>;
  const auto cross_of = [&](const V& a, const V& b) {
    const auto minor = [&](int i, int j) {
      return r.subtract(r.multiply(a[i], b[j]), r.multiply(a[j], b[i]));
    };
    return V{minor(1, 2), minor(2, 0), minor(0, 1)};
  };
  const auto dot_of = [&](const V& a, const V& b) {
    return r.add(r.add(r.multiply(a[0], b[0]), r.multiply(a[1], b[1])), r.multiply(a[2], b[2]));
  };
  const auto minus_of = [&](const V& a, const V& b) {
    return V{r.subtract(a[0], b[0]), r.subtract(a[1], b[1]), r.subtract(a[2], b[2])};
  };
  std::vector<V> points;
  points.reserve(mesh.point_planes.size());
  for (const auto& t : mesh.point_planes) {
    V n[3];
    uint64_t d[3];
    for (int i = 0; i < 3; ++i) {
      const Plane& s = mesh.planes[t[i]];
      n[i] = {r.of(s.a), r.of(s.b), r.of(s.c)};
      d[i] = r.of(s.d);
    }
    const V c[3] = {cross_of(n[1], n[2]), cross_of(n[2], n[0]), cross_of(n[0], n[1])};
    const uint64_t over = r.subtract(0, r.inverse(dot_of(n[0], c[0])));
    V x{};
    for (int k = 0; k < 3; ++k) {
      const uint64_t sum = r.add(r.add(r.multiply(d[0], c[0][k]), r.multiply(d[1], c[1][k])),
                                 r.multiply(d[2], c[2][k]));
      x[k] = r.multiply(sum, over);
    }
    points.push_back(x);
  }
  uint64_t total = 0;
  for (const BoundaryMesh::Face& f : mesh.faces) {
    const V& apex = points[mesh.corners[mesh.loop_starts[f.first_loop]].point];
    for (uint32_t l = f.first_loop; l < f.first_loop + f.loop_count; ++l) {
      const uint32_t begin = mesh.loop_starts[l], end = mesh.loop_starts[l + 1];
      for (uint32_t c = begin; c < end; ++c) {
        const V& a = points[mesh.corners[c].point];
        const V& b = points[mesh.corners[c + 1 < end ? c + 1 : begin].point];
        total = r.add(total, dot_of(apex, cross_of(minus_of(a, apex), minus_of(b, apex))));
      }
    }
  }
  return total;
}

uint64_t six_volumes_residue(const LeafGeometry& leaf, int which) {
  const Residues r(kPrimes[which]);
  uint64_t total = 0;
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t first = leaf.face_starts[f];
    const IVec3& a = leaf.vertices[leaf.corners[first]];
    for (uint32_t c = first + 1; c + 1 < leaf.face_starts[f + 1]; ++c) {
      const IVec3 &b = leaf.vertices[leaf.corners[c]], &d = leaf.vertices[leaf.corners[c + 1]];
      const auto minor = [&](int i, int j) {
        return static_cast<Int128>(b[i]) * d[j] - static_cast<Int128>(b[j]) * d[i];
      };
      total = r.add(total, r.of(a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1)));
    }
  }
  return total;
}

}  // namespace csgrun::test

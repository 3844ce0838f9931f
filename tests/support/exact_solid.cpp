#include "tests/support/exact_solid.h"

#include <algorithm>

#include "engine/bsp/boundary_mesh.h"
#include "engine/bsp/operand.h"
#include "tests/support/gmp_bridge.h"

namespace csgrun::test {

Rational3 minus(const Rational3& a, const Rational3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Rational3 cross(const Rational3& a, const Rational3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

mpq_class dot(const Rational3& a, const Rational3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Rational3 meeting_point(const Plane& p, const Plane& q, const Plane& r) {
  const auto n = [](const Plane& s) { return Rational3{to_gmp(s.a), to_gmp(s.b), to_gmp(s.c)}; };
  const Rational3 qr = cross(n(q), n(r)), rp = cross(n(r), n(p)), pq = cross(n(p), n(q));
  const mpq_class w = dot(n(p), qr);
  Rational3 x;
  for (int k = 0; k < 3; ++k) {
    x[k] = -(to_gmp(p.d) * qr[k] + to_gmp(q.d) * rp[k] + to_gmp(r.d) * pq[k]) / w;
  }
  return x;
}

ExactSolid exact_solid(const BoundaryMesh& mesh) {
  ExactSolid s;
  for (const auto& t : mesh.point_planes) {
    s.points.push_back(meeting_point(mesh.planes[t[0]], mesh.planes[t[1]], mesh.planes[t[2]]));
  }
  for (const BoundaryMesh::Face& f : mesh.faces) {
    s.faces.emplace_back();
    for (uint32_t l = f.first_loop; l < f.first_loop + f.loop_count; ++l) {
      auto& loop = s.faces.back().loops.emplace_back();
      for (uint32_t c = mesh.loop_starts[l]; c < mesh.loop_starts[l + 1]; ++c) {
        loop.push_back(mesh.corners[c].point);
      }
    }
  }
  return s;
}

Rational3 to_world(const Frame& frame, const Rational3& q) {
  if (frame.is_identity) return q;
  const auto row = [&](int i) {
    return Rational3{mpq_class(mpz_class(frame.matrix[i][0])),
                     mpq_class(mpz_class(frame.matrix[i][1])),
                     mpq_class(mpz_class(frame.matrix[i][2]))};
  };
  const Rational3 c12 = cross(row(1), row(2)), c20 = cross(row(2), row(0)),
                  c01 = cross(row(0), row(1));
  const mpq_class det = dot(row(0), c12), scale = mpq_class(mpz_class(1) << Frame::kShift) / det;
  Rational3 x;
  for (int k = 0; k < 3; ++k) x[k] = scale * (c12[k] * q[0] + c20[k] * q[1] + c01[k] * q[2]);
  return x;
}

bool mirrors(const Frame& frame) {
  if (frame.is_identity) return false;
  mpz_class det = 0;
  for (int j = 0; j < 3; ++j) {
    const int a = (j + 1) % 3, b = (j + 2) % 3;
    det += mpz_class(frame.matrix[0][j]) * (mpz_class(frame.matrix[1][a]) * frame.matrix[2][b] -
                                            mpz_class(frame.matrix[1][b]) * frame.matrix[2][a]);
  }
  return det < 0;
}

ExactSolid exact_solid(const Operand& operand) {
  ExactSolid s;
  if (operand.leaf) {
    const LeafGeometry& leaf = *operand.leaf;
    for (const IVec3& v : leaf.vertices) {
      s.points.push_back(
          {mpq_class(mpz_class(v[0])), mpq_class(mpz_class(v[1])), mpq_class(mpz_class(v[2]))});
    }
    for (size_t f = 0; f < leaf.face_count(); ++f) {
      s.faces.push_back({{{leaf.corners.begin() + leaf.face_starts[f],
                           leaf.corners.begin() + leaf.face_starts[f + 1]}}});
    }
  } else {
    s = exact_solid(*operand.boundary);
  }
  const Rational3 move{mpq_class(mpz_class(operand.translation[0])),
                       mpq_class(mpz_class(operand.translation[1])),
                       mpq_class(mpz_class(operand.translation[2]))};
  for (Rational3& p : s.points) {
    p = to_world(operand.frame, {p[0] + move[0], p[1] + move[1], p[2] + move[2]});
  }
  if (mirrors(operand.frame)) {
    for (auto& face : s.faces) {
      for (auto& loop : face.loops) std::reverse(loop.begin(), loop.end());
    }
  }
  return s;
}

}  // namespace csgrun::test

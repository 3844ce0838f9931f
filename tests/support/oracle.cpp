#include "tests/support/oracle.h"

#include <algorithm>
#include <cmath>

#include "tests/support/exact_measures.h"

namespace csgrun::test {

Oracle::Oracle(ExactSolid solid) : solid_(std::move(solid)) {
  for (const auto& p : solid_.points) {
    near_.push_back({p[0].get_d(), p[1].get_d(), p[2].get_d()});
  }
  for (const auto& f : solid_.faces) normals_.push_back(area_vector(solid_, f));
  for (const auto& f : solid_.faces) {
    Box box;
    for (const auto& loop : f.loops) {
      for (const uint32_t p : loop) {
        for (int k = 0; k < 3; ++k) {
          box.lo[k] = std::min(box.lo[k], near_[p][k]);
          box.hi[k] = std::max(box.hi[k], near_[p][k]);
        }
      }
    }
    for (int k = 0; k < 3; ++k) {
      box.lo[k] -= margin(box.lo[k]);
      box.hi[k] += margin(box.hi[k]);
    }
    boxes_.push_back(box);
  }
}

std::optional<int> Oracle::winding(const Query& q) const {
  int total = 0;
  for (size_t f = 0; f < solid_.faces.size(); ++f) {
    const Box& box = boxes_[f];
    if (box.hi[0] < q[0] || box.lo[1] > q[1] || box.hi[1] < q[1] || box.lo[2] > q[2] ||
        box.hi[2] < q[2]) {
      continue;
    }
    const auto around = winding_in_face(f, q);
    if (!around) return std::nullopt;
    if (*around == 0) continue;
    const int side = side_of_face(f, q);
    if (side == 0) return std::nullopt;
    // The face lies at higher x when the query is behind it along +x.
    if (side != sgn(normals_[f][0])) total += *around;
  }
  return total;
}

bool Oracle::at_most(uint32_t p, int k, double q) const {
  const double d = near_[p][k];
  if (std::fabs(d - q) > margin(d) + margin(q)) return d < q;
  return solid_.points[p][k] <= mpq_class(q);
}

std::optional<int> Oracle::winding_in_face(size_t f, const Query& q) const {
  int total = 0;
  for (const auto& loop : solid_.faces[f].loops) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const uint32_t a = loop[i], b = loop[i + 1 < loop.size() ? i + 1 : 0];
      const bool low_a = at_most(a, 1, q[1]), low_b = at_most(b, 1, q[1]);
      if (low_a == low_b) continue;
      const int turn = turn_of(a, b, q);
      if (turn == 0) return std::nullopt;
      if (low_a && turn > 0) ++total;
      if (low_b && turn < 0) --total;
    }
  }
  return total;
}

int Oracle::turn_of(uint32_t a, uint32_t b, const Query& q) const {
  const auto &u = near_[a], &v = near_[b];
  const double by = v[1] - u[1], bz = v[2] - u[2], qy = q[1] - u[1], qz = q[2] - u[2];
  const double value = by * qz - bz * qy;
  const double e =
      margin(u[1]) + margin(u[2]) + margin(v[1]) + margin(v[2]) + margin(q[1]) + margin(q[2]);
  const double bound = 2 * e * (std::fabs(by) + std::fabs(bz) + std::fabs(qy) + std::fabs(qz) + e) +
                       0x1p-48 * (std::fabs(by * qz) + std::fabs(bz * qy));
  if (value > bound) return 1;
  if (value < -bound) return -1;
  const auto &x = solid_.points[a], &y = solid_.points[b];
  const mpq_class exact =
      (y[1] - x[1]) * (mpq_class(q[2]) - x[2]) - (y[2] - x[2]) * (mpq_class(q[1]) - x[1]);
  return sgn(exact);
}

int Oracle::side_of_face(size_t f, const Query& q) const {
  const Rational3& p = solid_.points[solid_.faces[f].loops[0][0]];
  return sgn(dot(normals_[f], minus({mpq_class(q[0]), mpq_class(q[1]), mpq_class(q[2])}, p)));
}

}  // namespace csgrun::test

#include "tests/support/reference/reference.h"

#include "tests/support/reference/sections.h"

namespace csgrun::reference {

std::string gather_planes(const std::vector<Leaf>& leaves, const Claim* claim, Planes& planes) {
  std::map<Plane, uint32_t> numbers;
  for (const Leaf& leaf : leaves) {
    auto& uses = planes.of_leaf.emplace_back();
    for (const Face& f : leaf.faces) {
      Plane plane;
      bool down;
      if (std::string fault = plane_of(leaf.points, f, plane, down); !fault.empty()) {
        return "a leaf has " + fault;
      }
      const auto [at, is_new] =
          numbers.try_emplace(plane, static_cast<uint32_t>(planes.planes.size()));
      if (is_new) planes.planes.push_back(plane);
      uses.push_back({at->second, down});
    }
  }
  if (!claim) return "";
  for (const Face& f : claim->faces) {
    Plane plane;
    bool down;
    if (std::string fault = plane_of(claim->points, f, plane, down); !fault.empty()) {
      return "the result has " + fault;
    }
    const auto at = numbers.find(plane);
    if (at == numbers.end()) return "a face of the result is in a plane of no leaf";
    planes.of_claim.push_back({at->second, down});
  }
  return "";
}

namespace {

/// Whether 128 bits hold everything that Sections computes.
bool fits_128(const std::vector<Leaf>& leaves, const Claim* claim, const Planes& planes) {
  const auto bits = [](const mpz_class& v) {
    return static_cast<int>(mpz_sizeinbase(v.get_mpz_t(), 2));
  };
  int n = 1, d = 1, x = 1, w = 1;
  for (const Plane& p : planes.planes) {
    for (int k = 0; k < 3; ++k) n = std::max(n, bits(p.c[k]));
    d = std::max(d, bits(p.c[3]));
  }
  for (const Leaf& leaf : leaves) {
    for (const Point& p : leaf.points) {
      for (int k = 0; k < 3; ++k) x = std::max(x, bits(p[k]));
      w = std::max(w, bits(p[3]));
    }
  }
  // Abscissae: corners of the claim and of leaves, points where edges or lines meet.
  const int value = std::max(n + x, d + w) + 2;
  int widest = std::max(x, w);
  if (claim) {
    for (const Point& p : claim->points) {
      for (const auto& c : p) widest = std::max(widest, bits(c));
    }
  }
  // A line of two planes, or through two points and reduced: hardly ever wider, but see to it.
  const int slope = std::max(2 * n + 1, 2 * std::max(x, w) + 1);
  const int height = std::max(n + d + 1, slope);
  int num = std::max(widest, value + x + 1), den = std::max(widest, value + w + 1);
  num = std::max(num, slope + height + 1);
  den = std::max(den, 2 * slope + 1);
  const int at = std::max(slope + num, height + den) + 1 + slope + 1;
  return std::max({num + den + 1, at, 2 * widest + 1}) <= 125;
}

}  // namespace

std::string difference(const std::vector<Leaf>& leaves, const Tree& tree, const Claim& claim,
                       Fault fault) {
  Planes planes;
  if (std::string text = gather_planes(leaves, &claim, planes); !text.empty()) return text;
  if (fits_128(leaves, &claim, planes)) {
    return Sections<__int128>(leaves, tree, planes, &claim, fault, {}).run();
  }
  return Sections<mpz_class>(leaves, tree, planes, &claim, fault, {}).run();
}

namespace {

template <class Z>
void measure_with(const std::vector<Leaf>& leaves, const Tree& tree, const Planes& planes,
                  Fault fault, Measured& m) {
  const auto rational = [](const Z& num, const Z& den) {
    mpq_class r(Number<Z>::to_gmp(num), Number<Z>::to_gmp(den));
    r.canonicalize();
    return r;
  };
  const auto add = [&](const Trapezoid<Z>& t) {
    const mpq_class l = rational(t.left.num, t.left.den), r = rational(t.right.num, t.right.den);
    const auto height = [&](const Line<Z>& line) -> mpq_class {
      return -(rational(line.a, line.b) * (l + r) + 2 * rational(line.c, line.b));
    };
    const mpq_class area = (height(t.upper) - height(t.lower)) / 2 * (r - l);
    m.areas[{t.plane, t.up, t.leaf}] += area;
    // Cones from the origin: a third of height times area.
    mpq_class offset(-t.plane.c[3], t.plane.c[t.plane.axis]);
    offset.canonicalize();
    m.volume += (t.up ? 1 : -1) * offset * area / 3;
  };
  m.fault = Sections<Z>(leaves, tree, planes, nullptr, fault, add).run();
}

}  // namespace

Measured measure(const std::vector<Leaf>& leaves, const Tree& tree, Fault fault) {
  Measured m;
  Planes planes;
  m.fault = gather_planes(leaves, nullptr, planes);
  if (!m.fault.empty()) return m;
  if (fits_128(leaves, nullptr, planes)) {
    measure_with<__int128>(leaves, tree, planes, fault, m);
  } else {
    measure_with<mpz_class>(leaves, tree, planes, fault, m);
  }
  return m;
}

}  // namespace csgrun::reference

#include "engine/bsp/line_key.h"

namespace csgrun {
namespace {

constexpr uint64_t kPrime = (uint64_t{1} << 61) - 1;

uint64_t reduce(UInt128 v) {
  uint64_t r = static_cast<uint64_t>(v & kPrime) + static_cast<uint64_t>(v >> 61);
  r = (r & kPrime) + (r >> 61);
  return r >= kPrime ? r - kPrime : r;
}

uint64_t times(uint64_t a, uint64_t b) { return reduce(static_cast<UInt128>(a) * b); }
uint64_t minus(uint64_t a, uint64_t b) { return a >= b ? a - b : a + kPrime - b; }

uint64_t residue(Int128 v) {
  const UInt128 m = v < 0 ? -static_cast<UInt128>(v) : static_cast<UInt128>(v);
  const uint64_t r = static_cast<uint64_t>(m % kPrime);
  return v < 0 ? minus(0, r) : r;
}

/// a^(p - 2): the inverse.
uint64_t inverse(uint64_t a) {
  uint64_t r = 1;
  for (uint64_t e = kPrime - 2; e; e >>= 1) {
    if (e & 1) r = times(r, a);
    a = times(a, a);
  }
  return r;
}

uint64_t scramble(uint64_t h, uint64_t v) {
  h = (h ^ v) * 0x9fb21c651e98df25ull;
  return h ^ (h >> 29);
}

}  // namespace

const LineNamer::Residues& LineNamer::residues(uint32_t plane) {
  if (plane / kPage >= pages_.size()) pages_.resize(planes_->size() / kPage + 1);
  std::unique_ptr<Page>& page = pages_[plane / kPage];
  if (!page) page = std::make_unique<Page>();
  Residues& r = (*page)[plane % kPage];
  if (!r.known) {
    const Plane& p = planes_->plane(plane);
    r = {{residue(p.a), residue(p.b), residue(p.c), residue(p.d)}, true};
  }
  return r;
}

LineNamer::Coordinates LineNamer::coordinates(PlanePair line) {
  const uint64_t* a = residues(line.p).v;
  const uint64_t* b = residues(line.q).v;
  const auto minor = [&](int i, int j) { return minus(times(a[i], b[j]), times(a[j], b[i])); };
  Coordinates c{{minor(0, 1), minor(0, 2), minor(1, 2), minor(0, 3), minor(1, 3), minor(2, 3)}, 0};
  while (c.first < 5 && c.v[c.first] == 0) ++c.first;
  return c;
}

void LineNamer::keys(const std::vector<PlanePair>& lines, std::vector<LineKey>& keys) {
  lines_.clear();
  products_.clear();
  uint64_t product = 1;
  for (const PlanePair& line : lines) {
    lines_.push_back(coordinates(line));
    products_.push_back(product);
    product = times(product, lines_.back().v[lines_.back().first]);
  }
  uint64_t rest = inverse(product);
  keys.resize(lines.size());
  for (size_t i = lines.size(); i-- > 0;) {
    const Coordinates& c = lines_[i];
    const uint64_t scale = times(rest, products_[i]);
    rest = times(rest, c.v[c.first]);
    LineKey key{0x9e3779b97f4a7c15ull, 0xc2b2ae3d27d4eb4full};
    for (const uint64_t coordinate : c.v) {
      const uint64_t v = times(coordinate, scale);
      key.a = scramble(key.a, v);
      key.b = scramble(key.b, v * 0xd6e8feb86659fd93ull + 1);
    }
    keys[i] = key;
  }
}

}  // namespace csgrun

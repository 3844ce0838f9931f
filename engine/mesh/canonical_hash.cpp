#include "engine/mesh/canonical_hash.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "engine/mesh/residues.h"

namespace csgrun {
namespace {

constexpr uint64_t kPrime = (uint64_t{1} << 61) - 1;

class Hasher {
 public:
  template <class T>
  void add(const T& v) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    const auto* bytes = reinterpret_cast<const unsigned char*>(&v);
    bytes_.insert(bytes_.end(), bytes, bytes + sizeof v);
  }
  void add_text(const std::string& s) {
    add(s.size());
    bytes_.insert(bytes_.end(), s.begin(), s.end());
  }
  [[nodiscard]] std::array<uint64_t, 2> value() const {
    const XXH128_hash_t h = XXH3_128bits(bytes_.data(), bytes_.size());
    return {h.high64, h.low64};
  }

 private:
  std::vector<unsigned char> bytes_;
};

}  // namespace

std::array<uint64_t, 2> canonical_hash(const std::vector<MergedFace>& faces, CellGeometry& geometry,
                                       const PresentContext& context) {
  Hasher hasher;
  hasher.add(context.step.numerator);
  hasher.add(context.step.denominator);
  hasher.add(context.step.exponent);
  const PrimeField field(kPrime);
  std::vector<uint32_t> number(geometry.point_count(), kNone);
  uint32_t next = 0;
  for (const MergedFace& f : faces) {
    const Appearance& a = context.appearances[f.appearance];
    for (const float c : {a.red, a.green, a.blue, a.alpha, a.metallic, a.roughness}) hasher.add(c);
    hasher.add_text(a.name);
    hasher.add(static_cast<uint32_t>(f.surface != 0));
    hasher.add(f.loops.size());
    for (const auto& loop : f.loops) {
      hasher.add(loop.size());
      for (const DirectedEdge& e : loop) {
        if (number[e.from] == kNone) {
          number[e.from] = next++;
          const Point& p = geometry.exact(e.from);
          const uint64_t scale = field.inverse(field.residue(p.w));
          for (const auto* c : {&p.x, &p.y, &p.z}) {
            hasher.add(field.multiply(field.residue(*c), scale));
          }
          for (const double c : geometry.point(e.from).rounded) hasher.add(c + 0.0);
        }
        hasher.add(number[e.from]);
      }
    }
  }
  return hasher.value();
}

}  // namespace csgrun

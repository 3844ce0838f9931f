#include "engine/mesh/canonical_hash.h"

#include <cstring>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "engine/mesh/residues.h"

namespace csgrun {
namespace {

constexpr uint64_t kPrime = (uint64_t{1} << 61) - 1;

/// Bytes as they come, hashed in blocks.
class Hasher {
 public:
  Hasher() { XXH3_128bits_reset(&state_); }
  template <class T>
  void add(const T& v) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    if (used_ + sizeof v > bytes_.size()) flush();
    std::memcpy(bytes_.data() + used_, &v, sizeof v);
    used_ += sizeof v;
  }
  void add_text(const std::string& s) {
    add(s.size());
    if (s.empty()) return;
    flush();
    XXH3_128bits_update(&state_, s.data(), s.size());
  }
  [[nodiscard]] std::array<uint64_t, 2> value() {
    flush();
    const XXH128_hash_t h = XXH3_128bits_digest(&state_);
    return {h.high64, h.low64};
  }

 private:
  void flush() {
    XXH3_128bits_update(&state_, bytes_.data(), used_);
    used_ = 0;
  }

  XXH3_state_t state_;
  std::array<unsigned char, 1 << 14> bytes_;
  size_t used_ = 0;
};

/// Adds points when they are met first, and numbers from then on.
class PointHasher {
 public:
  PointHasher(Hasher& hasher, size_t point_count)
      : hasher_(hasher), field_(kPrime), number_(point_count, kNone) {}

  [[nodiscard]] bool is_new(uint32_t point) const { return number_[point] == kNone; }
  void add(uint32_t point, const Point& p, const std::array<double, 3>& rounded) {
    // All points of a leaf in a frame have one weight.
    if (p.w != weight_) {
      weight_ = p.w;
      scale_ = field_.inverse(field_.residue(p.w));
    }
    for (const auto* c : {&p.x, &p.y, &p.z}) {
      hasher_.add(field_.multiply(field_.residue(*c), scale_));
    }
    for (const double c : rounded) hasher_.add(c + 0.0);
    number_[point] = next_++;
  }
  void add(uint32_t point, const IVec3& p) {
    for (const int64_t c : p) hasher_.add(field_.residue(c));
    for (const int64_t c : p) hasher_.add(static_cast<double>(c));
    number_[point] = next_++;
  }
  void add_number(uint32_t point) { hasher_.add(number_[point]); }

 private:
  Hasher& hasher_;
  PrimeField field_;
  std::vector<uint32_t> number_;
  uint32_t next_ = 0;
  Int<kPointLimbs> weight_{1};
  uint64_t scale_ = 1;  ///< its inverse
};

}  // namespace

std::array<uint64_t, 2> canonical_hash(const std::vector<MergedFace>& faces,
                                       const WholeOrder& whole, const BoundaryMesh& boundary,
                                       CellGeometry& geometry, const PresentContext& context) {
  Hasher hasher;
  hasher.add(context.step.numerator);
  hasher.add(context.step.denominator);
  hasher.add(context.step.exponent);
  const auto more_points = geometry.point_count() - boundary.point_planes.size();
  PointHasher points(hasher, whole.points().size() + more_points);
  const auto begin_face = [&](uint32_t appearance, uint32_t surface, size_t loops) {
    const Appearance& a = context.appearances[appearance];
    for (const float c : {a.red, a.green, a.blue, a.alpha, a.metallic, a.roughness}) hasher.add(c);
    hasher.add_text(a.name);
    hasher.add(static_cast<uint32_t>(surface != 0));
    hasher.add(loops);
  };
  const auto add_explicit = [&](const MergedFace& f) {
    begin_face(f.appearance, f.surface, f.loops.size());
    for (const auto& loop : f.loops) {
      hasher.add(loop.size());
      for (const DirectedEdge& e : loop) {
        const uint32_t p = whole.number(e.from);
        if (points.is_new(p)) points.add(p, geometry.exact(e.from), geometry.point(e.from).rounded);
        points.add_number(p);
      }
    }
  };
  const auto add_untouched = [&](const UntouchedTriangle& t) {
    const UntouchedPart& part = boundary.parts[t.part];
    const FaceLabel label = part.label(t.face);
    begin_face(label.appearance, label.surface, 1);
    hasher.add(t.points.size());
    for (const uint32_t p : t.points) {
      if (points.is_new(p)) {
        const WholeOrder::Place& place = whole.points()[p];
        if (place.explicit_point == kNone && part.map.is_identity()) {
          points.add(p, part.vertex(place.vertex));
        } else if (place.explicit_point == kNone) {
          points.add(p, part.point(place.vertex), part.rounded_point(place.vertex));
        } else {
          points.add(p, geometry.exact(place.explicit_point),
                     geometry.point(place.explicit_point).rounded);
        }
      }
      points.add_number(p);
    }
  };
  for (const uint32_t f : whole.faces()) {
    if (f < whole.explicit_face_count()) {
      add_explicit(faces[f]);
    } else {
      add_untouched(whole.triangle(f));
    }
  }
  return hasher.value();
}

}  // namespace csgrun

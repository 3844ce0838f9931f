#include "engine/csg/boundary_bytes.h"

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/base/bytes.h"

namespace csgrun {
namespace {

/// Frames have numbers in their scene. Of one but the world nothing is known in another scene but
/// that it is not the world: this is the number of none.
constexpr uint32_t kSomeFrame = UINT32_MAX;

/// Numbers that count up, or are one, or are listed.
enum class NumberingKind : uint8_t { kOne, kCountUp, kListed };

/// Appearances as numbers in a list of those that occur.
class AppearanceList {
 public:
  uint32_t add(uint32_t id) {
    const auto [found, is_new] = numbers_.try_emplace(id, static_cast<uint32_t>(ids_.size()));
    if (is_new) ids_.push_back(id);
    return found->second;
  }
  [[nodiscard]] const std::vector<uint32_t>& ids() const { return ids_; }

 private:
  std::unordered_map<uint32_t, uint32_t> numbers_;
  std::vector<uint32_t> ids_;
};

void write(ByteWriter& out, const Appearance& a) {
  for (const float x : {a.red, a.green, a.blue, a.alpha, a.metallic, a.roughness}) out.number(x);
  out.number(static_cast<uint8_t>(a.is_default));
  out.text(a.name);
}

Appearance read_appearance(ByteReader& in) {
  Appearance a;
  for (float* x : {&a.red, &a.green, &a.blue, &a.alpha, &a.metallic, &a.roughness}) {
    *x = in.number<float>();
  }
  a.is_default = in.number<uint8_t>() != 0;
  in.list(a.name);
  return a;
}

void write(ByteWriter& out, const FaceNumbers& numbers, size_t count) {
  if (numbers.stored() > 0) {
    out.number(NumberingKind::kListed);
    const std::vector<uint32_t> list = numbers.list(count);
    out.list(list);
  } else {
    out.number(numbers.count_up() ? NumberingKind::kCountUp : NumberingKind::kOne);
    out.number(numbers[0]);
  }
}

FaceNumbers read_numbers(ByteReader& in, size_t count) {
  const auto numbering = in.number<NumberingKind>();
  if (numbering == NumberingKind::kOne) return FaceNumbers::all(in.number<uint32_t>());
  if (numbering == NumberingKind::kCountUp) return FaceNumbers::ascending(in.number<uint32_t>());
  std::vector<uint32_t> list;
  in.list(list);
  list.resize(count);
  return {std::move(list)};
}

class Writer {
 public:
  Writer(const StoredBoundary& stored, const AppearanceTable& appearances)
      : stored_(stored), appearances_(appearances) {}

  std::string run() {
    const BoundaryMesh& b = *stored_.boundary;
    write_place();
    body_.number(static_cast<uint8_t>(b.may_touch));
    body_.list(b.touches);
    body_.list(b.planes);
    body_.list(b.point_planes);
    body_.list(b.point_rounded);
    write_faces(b);
    body_.list(b.loop_starts);
    body_.list(b.corners);
    write_parts(b);
    ByteWriter all;
    all.number(static_cast<uint32_t>(list_.ids().size()));
    for (const uint32_t id : list_.ids()) write(all, appearances_.values()[id]);
    return all.take() + body_.take();
  }

 private:
  void write_place() {
    const Identity& id = stored_.id;
    body_.number(static_cast<uint8_t>(id.frame == 0));
    body_.number(id.permutation.axis);
    body_.number(id.permutation.sign);
    body_.number(id.origin);
    body_.number(id.paint == kUnpainted ? kUnpainted : list_.add(id.paint));
  }

  void write_faces(const BoundaryMesh& b) {
    std::vector<std::array<uint32_t, 8>> faces;
    faces.reserve(b.faces.size());
    for (const BoundaryMesh::Face& f : b.faces) {
      const uint32_t flags = (f.whole ? 1u : 0u) | (f.complete ? 2u : 0u);
      faces.push_back({f.plane.value(), f.label.source, f.label.facet, f.label.surface,
                       list_.add(f.label.appearance), f.first_loop, f.loop_count, flags});
    }
    body_.list(faces);
  }

  void write_parts(const BoundaryMesh& b) {
    std::vector<const LeafGeometry*> leaves;
    std::unordered_map<const LeafGeometry*, uint32_t> numbers;
    std::vector<uint8_t> has_own_colours;
    for (const UntouchedPart& part : b.parts) {
      const LeafGeometry* leaf = part.leaf.get();
      const auto [found, is_new] = numbers.try_emplace(leaf, static_cast<uint32_t>(leaves.size()));
      if (is_new) leaves.push_back(leaf), has_own_colours.push_back(0);
      if (!part.appearance) has_own_colours[found->second] = 1;
    }
    body_.number(static_cast<uint32_t>(leaves.size()));
    for (size_t i = 0; i < leaves.size(); ++i) write_leaf(*leaves[i], has_own_colours[i] != 0);
    body_.number(static_cast<uint32_t>(b.parts.size()));
    for (const UntouchedPart& part : b.parts) {
      body_.number(numbers.at(part.leaf.get()));
      body_.number(part.translation);
      body_.number(static_cast<uint8_t>(part.map.is_identity()));
      body_.number(part.map.frame().matrix);
      body_.number(part.source);
      body_.number(part.appearance ? list_.add(*part.appearance) : kUnpainted);
      body_.number(static_cast<uint8_t>(part.flipped));
      body_.list(part.faces);
      body_.list(part.shared);
      body_.list(part.world);
    }
  }

  /// Colours that every part of it paints over are not written: they may be of no appearance that
  /// there is.
  void write_leaf(const LeafGeometry& leaf, bool has_own_colours) {
    const size_t count = leaf.face_count();
    body_.list(leaf.vertices);
    body_.list(leaf.corners);
    body_.list(leaf.face_starts);
    body_.list(leaf.opposite);
    write(body_, leaf.facet, count);
    write(body_, leaf.surface, count);
    body_.number(static_cast<uint8_t>(has_own_colours));
    if (has_own_colours) {
      if (const auto common = leaf.appearance.common()) {
        write(body_, FaceNumbers::all(list_.add(*common)), count);
      } else {
        std::vector<uint32_t> each = leaf.appearance.list(count);
        for (uint32_t& id : each) id = list_.add(id);
        write(body_, FaceNumbers(std::move(each)), count);
      }
    }
    body_.number(static_cast<uint8_t>((leaf.convex ? 1 : 0) | (leaf.has_single_fans ? 2 : 0) |
                                      (leaf.may_have_flat_edges ? 4 : 0) |
                                      (leaf.may_touch ? 8 : 0)));
  }

  const StoredBoundary& stored_;
  const AppearanceTable& appearances_;
  AppearanceList list_;
  ByteWriter body_;
};

class Reader {
 public:
  Reader(std::string_view bytes, AppearanceTable& appearances)
      : in_(bytes), appearances_(appearances) {}

  std::optional<StoredBoundary> run(const Key& key) {
    const auto count = in_.number<uint32_t>();
    std::vector<Appearance> values;
    for (uint32_t i = 0; i < count && in_.is_good(); ++i) values.push_back(read_appearance(in_));
    if (!in_.is_good()) return std::nullopt;
    for (const Appearance& value : values) ids_.push_back(appearances_.intern(value));
    auto boundary = std::make_shared<BoundaryMesh>();
    StoredBoundary stored;
    stored.id.key = key;
    read_place(stored.id);
    boundary->may_touch = in_.number<uint8_t>() != 0;
    in_.list(boundary->touches);
    in_.list(boundary->planes);
    in_.list(boundary->point_planes);
    in_.list(boundary->point_rounded);
    read_faces(*boundary);
    in_.list(boundary->loop_starts);
    in_.list(boundary->corners);
    read_parts(*boundary);
    if (!in_.is_at_end() || !is_known_) return std::nullopt;
    stored.boundary = std::move(boundary);
    return stored;
  }

 private:
  uint32_t id_of(uint32_t number) {
    if (number < ids_.size()) return ids_[number];
    is_known_ = false;
    return 0;
  }

  void read_place(Identity& id) {
    id.frame = in_.number<uint8_t>() != 0 ? 0 : kSomeFrame;
    id.permutation.axis = in_.number<std::array<int8_t, 3>>();
    id.permutation.sign = in_.number<std::array<int8_t, 3>>();
    id.origin = in_.number<IVec3>();
    const auto paint = in_.number<uint32_t>();
    id.paint = paint == kUnpainted ? kUnpainted : id_of(paint);
  }

  void read_faces(BoundaryMesh& b) {
    std::vector<std::array<uint32_t, 8>> faces;
    in_.list(faces);
    b.faces.reserve(faces.size());
    for (const auto& f : faces) {
      BoundaryMesh::Face& face = b.faces.emplace_back();
      face.plane = PlaneId::from_value(f[0]);
      face.label = {f[1], f[2], f[3], id_of(f[4])};
      face.first_loop = f[5], face.loop_count = f[6];
      face.whole = (f[7] & 1) != 0, face.complete = (f[7] & 2) != 0;
    }
  }

  void read_parts(BoundaryMesh& b) {
    const auto leaf_count = in_.number<uint32_t>();
    std::vector<std::shared_ptr<const LeafGeometry>> leaves;
    for (uint32_t i = 0; i < leaf_count && in_.is_good(); ++i) leaves.push_back(read_leaf());
    const auto part_count = in_.number<uint32_t>();
    for (uint32_t i = 0; i < part_count && in_.is_good(); ++i) {
      UntouchedPart& part = b.parts.emplace_back();
      const auto leaf = in_.number<uint32_t>();
      if (leaf < leaves.size()) part.leaf = leaves[leaf];
      is_known_ = is_known_ && part.leaf;
      part.translation = in_.number<IVec3>();
      Frame frame;
      frame.is_identity = in_.number<uint8_t>() != 0;
      frame.matrix = in_.number<decltype(frame.matrix)>();
      if (!frame.is_identity) part.map = FrameMap(frame);
      part.source = in_.number<uint32_t>();
      const auto appearance = in_.number<uint32_t>();
      if (appearance != kUnpainted) part.appearance = id_of(appearance);
      part.flipped = in_.number<uint8_t>() != 0;
      in_.list(part.faces);
      in_.list(part.shared);
      in_.list(part.world);
    }
  }

  std::shared_ptr<const LeafGeometry> read_leaf() {
    auto leaf = std::make_shared<LeafGeometry>();
    in_.list(leaf->vertices);
    in_.list(leaf->corners);
    in_.list(leaf->face_starts);
    in_.list(leaf->opposite);
    const size_t count = leaf->face_starts.empty() ? 0 : leaf->face_count();
    leaf->facet = read_numbers(in_, count);
    leaf->surface = read_numbers(in_, count);
    if (in_.number<uint8_t>() != 0) {
      const FaceNumbers numbers = read_numbers(in_, count);
      if (const auto common = numbers.common()) {
        leaf->appearance = FaceNumbers::all(id_of(*common));
      } else {
        std::vector<uint32_t> each = numbers.list(count);
        for (uint32_t& id : each) id = id_of(id);
        leaf->appearance = FaceNumbers(std::move(each));
      }
    }
    const auto flags = in_.number<uint8_t>();
    leaf->convex = (flags & 1) != 0, leaf->has_single_fans = (flags & 2) != 0;
    leaf->may_have_flat_edges = (flags & 4) != 0, leaf->may_touch = (flags & 8) != 0;
    return leaf;
  }

  ByteReader in_;
  AppearanceTable& appearances_;
  std::vector<uint32_t> ids_;  ///< in this run, by their numbers in the bytes
  bool is_known_ = true;       ///< all that numbers name is there
};

}  // namespace

std::string to_bytes(const StoredBoundary& stored, const AppearanceTable& appearances) {
  return Writer(stored, appearances).run();
}

std::optional<StoredBoundary> from_bytes(std::string_view bytes, const Key& key,
                                         AppearanceTable& appearances) {
  return Reader(bytes, appearances).run(key);
}

}  // namespace csgrun

// The pieces of a version as one job would have left them: whole polygons, cut ones, and triangles
// of leaves that nothing met, which are named before there is a job, so that it need not have them.
#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/bsp/result_pieces.h"
#include "engine/bsp/some_faces.h"
#include "engine/bsp/untouched.h"

namespace csgrun {
namespace {

class PieceAssembler {
 public:
  explicit PieceAssembler(const ResultPieces& version) : version_(version), store_(*version.store) {
    version.tree.each([](const PieceBox&) { return true; },
                      [&](uint32_t p) { pieces_.push_back(p); });
    std::sort(pieces_.begin(), pieces_.end());
    find_operands();
    find_fates();
  }

  Result<std::shared_ptr<const BoundaryMesh>> run(bool name_untouched) {
    std::vector<std::vector<UntouchedPart>> parts(operands_.size());
    if (name_untouched) {
      for_each_alone(operands_.size(), face_count_ > kFewForThreads, [&](size_t o) {
        if (operands_[o].leaf && !operands_[o].leaf->may_touch) {
          parts[o] =
              untouched_parts(operands_[o], nullptr, fate_[o].data(), {}, is_named_[o].data());
        }
      });
    }
    const SomeFaces some = faces_of_pieces();
    Job job(operands_, store_.planes, some);
    std::vector<UntouchedPart> named;
    for (size_t o = 0; o < parts.size(); ++o) {
      for (UntouchedPart& part : parts[o]) {
        place_in_job(part, job, o);
        named.push_back(std::move(part));
      }
    }
    std::vector<FragmentSet> sets(1);
    std::vector<WholePolygon> whole = whole_polygons(job);
    take_cut(job, sets.front());
    return assemble(job, std::move(sets), std::move(whole),
                    {version_.touches_anywhere, version_.touches.boxes()}, std::move(named));
  }

 private:
  /// Whether a point is named by a leaf. (How many vertices a boundary has in a job depends on the
  /// job; its points are named by their planes.)
  [[nodiscard]] bool is_leaf_vertex(uint32_t point) const {
    const uint32_t o = store_.operand_of(point);
    return o != kNone && store_.operands()[o].leaf;
  }

  /// Those that have pieces or corners of pieces, in the order of their sources, as one operation
  /// would have them.
  void find_operands() {
    const auto& all = store_.operands();
    std::vector<uint8_t> is_used(all.size(), 0);
    for (const uint32_t p : pieces_) {
      is_used[store_.piece(p).operand] = 1;
      for (const uint32_t point : store_.corners(p)) {
        if (is_leaf_vertex(point)) is_used[store_.operand_of(point)] = 1;
      }
    }
    std::vector<uint32_t> order;
    for (uint32_t o = 0; o < is_used.size(); ++o) {
      if (is_used[o]) order.push_back(o);
    }
    const auto source = [&](uint32_t o) { return all[o].first_source + version_.first_source; };
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return source(a) < source(b); });
    number_.assign(all.size(), kNone);
    for (const uint32_t o : order) {
      number_[o] = static_cast<uint32_t>(operands_.size());
      operands_.push_back(all[o]);
      operands_.back().first_source = source(o);
    }
  }

  /// Calls f(face, is_met) for the faces of a whole piece.
  template <class F>
  void each_whole_face(uint32_t piece, F&& f) const {
    const PieceStore::Piece& own = store_.piece(piece);
    if (!store_.is_group(piece)) return f(own.face, own.is_met);
    // What is known of the faces of a group is known of their pieces, if they were made.
    const auto faces = store_.group_faces(piece);
    const PieceStore::Parts parts = store_.parts(piece);
    for (uint32_t i = 0; i < faces.size(); ++i) {
      f(faces[i], parts.were_made() && store_.piece(parts.first + i).is_met);
    }
  }

  void find_fates() {
    fate_.resize(operands_.size());
    is_there_.resize(operands_.size());
    is_named_.resize(operands_.size());
    for (size_t o = 0; o < operands_.size(); ++o) {
      if (!operands_[o].leaf) continue;
      const size_t count = operands_[o].leaf->face_count();
      fate_[o].assign(count, FaceFate::kMixed);
      is_there_[o].assign(count, 0);
      is_named_[o].assign(count, 0);
      face_count_ += count;
    }
    for (const uint32_t p : pieces_) {
      const PieceStore::Piece& piece = store_.piece(p);
      const uint32_t o = number_[piece.operand];
      if (!operands_[o].leaf) continue;
      if (!piece.is_whole) {
        is_there_[o][piece.face] = 1;
        continue;
      }
      const FaceFate fate = piece.is_flipped ? FaceFate::kFlipped : FaceFate::kKept;
      each_whole_face(p, [&](uint32_t face, bool is_met) {
        is_there_[o][face] = 1;
        if (!is_met) fate_[o][face] = fate;
      });
    }
  }

  /// The faces that pieces are of, without those that are named.
  [[nodiscard]] SomeFaces faces_of_pieces() const {
    SomeFaces some;
    some.faces.resize(operands_.size());
    for (const uint32_t p : pieces_) {
      const uint32_t o = number_[store_.piece(p).operand];
      if (operands_[o].boundary) some.faces[o].push_back(store_.piece(p).face);
    }
    for (size_t o = 0; o < operands_.size(); ++o) {
      if (operands_[o].boundary) {
        some.is_partial.push_back(1);
        add_other_sides(*operands_[o].boundary, some.faces[o]);
        std::sort(some.faces[o].begin(), some.faces[o].end());
        const auto end = std::unique(some.faces[o].begin(), some.faces[o].end());
        some.faces[o].erase(end, some.faces[o].end());
        continue;
      }
      some.is_partial.push_back(can_be_partial(operands_[o]) ? 1 : 0);
      if (!some.is_partial[o]) continue;
      for (uint32_t f = 0; f < is_there_[o].size(); ++f) {
        if (is_there_[o][f] && !is_named_[o][f]) some.faces[o].push_back(f);
      }
    }
    return some;
  }

  /// Adds the faces of a boundary that are of the same facets as some, on the other sides of their
  /// planes: whether a facet is complete is seen from both.
  static void add_other_sides(const BoundaryMesh& boundary, std::vector<uint32_t>& faces) {
    using Key = std::pair<FaceLabel, uint32_t>;
    const auto key = [&](uint32_t f) {
      return Key(boundary.faces[f].label, boundary.faces[f].plane.index());
    };
    const auto count = static_cast<uint32_t>(boundary.faces.size());
    std::vector<Key> known;
    for (const uint32_t f : faces) {
      if (f < count) known.push_back(key(f));
    }
    std::sort(known.begin(), known.end());
    for (uint32_t f = 0; f < count; ++f) {
      if (std::binary_search(known.begin(), known.end(), key(f))) faces.push_back(f);
    }
  }

  /// The first polygon of a job that is of a face of an operand.
  static uint32_t first_polygon(const Job& job, uint32_t operand, uint32_t face) {
    const uint32_t begin = job.polygon_start(operand), end = job.polygon_start(operand + 1);
    if (job.is_leaf(operand) && !job.some_faces(operand)) return begin + face;
    // How a boundary's face is made convex depends on the other operands of a job.
    const auto first = job.polygons().begin();
    const auto found = std::lower_bound(first + begin, first + end, face,
                                        [](const JobPolygon& p, uint32_t f) { return p.face < f; });
    return static_cast<uint32_t>(found - first);
  }

  [[nodiscard]] std::vector<WholePolygon> whole_polygons(const Job& job) const {
    std::vector<WholePolygon> whole;
    for (const uint32_t p : pieces_) {
      const PieceStore::Piece& piece = store_.piece(p);
      if (!piece.is_whole) continue;
      const uint32_t o = number_[piece.operand];
      each_whole_face(p, [&](uint32_t face, bool is_met) {
        if (is_named_[o][face]) return;
        whole.push_back({first_polygon(job, o, face), piece.is_flipped, is_met});
      });
    }
    return whole;
  }

  void take_cut(const Job& job, FragmentSet& set) {
    std::vector<uint32_t>& number_of = store_.scratch();
    std::vector<uint32_t> numbered;
    for (const uint32_t p : pieces_) {
      const PieceStore::Piece& piece = store_.piece(p);
      if (piece.is_whole) continue;
      const uint32_t polygon = first_polygon(job, number_[piece.operand], piece.face);
      const auto first_corner = static_cast<uint32_t>(set.corner_point.size());
      store_.each_loop(p, [&](uint32_t begin, uint32_t end) {
        set.pieces.push_back({piece.support, polygon, first_corner + begin, end - begin, false});
      });
      const auto corners = store_.corners(p);
      const auto edges = store_.edges(p);
      for (uint32_t i = 0; i < piece.count; ++i) {
        const uint32_t point = corners[i];
        if (number_of[point] == kNone) {
          number_of[point] = static_cast<uint32_t>(set.points.size());
          numbered.push_back(point);
          uint32_t vertex = kNone;
          if (is_leaf_vertex(point)) {
            const uint32_t o = store_.operand_of(point);
            vertex = job.vertex_start(number_[o]) + point - store_.first_point(o);
          }
          set.points.push_back({store_.rounded(point), store_.point_planes(point), vertex});
        }
        set.corner_point.push_back(number_of[point]);
        set.corner_plane.push_back(edges[i]);
      }
    }
    for (const uint32_t point : numbered) number_of[point] = kNone;
  }

  const ResultPieces& version_;
  PieceStore& store_;
  std::vector<uint32_t> pieces_;
  std::vector<Operand> operands_;
  std::vector<uint32_t> number_;  ///< per operand of the store: of operands_, or kNone
  /// Per face of each leaf: what became of it, whether any of it is left, and whether it is named
  /// as untouched.
  std::vector<std::vector<FaceFate>> fate_;
  std::vector<std::vector<uint8_t>> is_there_, is_named_;
  size_t face_count_ = 0;
};

}  // namespace

Result<std::shared_ptr<const BoundaryMesh>> assemble_pieces(const ResultPieces& version,
                                                            bool name_untouched) {
  return PieceAssembler(version).run(name_untouched);
}

}  // namespace csgrun

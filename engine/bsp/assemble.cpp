#include "engine/bsp/assemble.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <map>
#include <numeric>
#include <type_traits>
#include <utility>

#include "engine/base/in_order.h"
#include "engine/base/parallel.h"
#include "engine/base/raw_vector.h"
#include "engine/bsp/canonical_order.h"
#include "engine/bsp/point_index.h"
#include "engine/bsp/regions.h"

namespace csgrun {
namespace {

class Assembler {
 public:
  explicit Assembler(Job& job)
      : job_(job),
        geometry_(job.planes(), &job),
        index_(geometry_),
        builder_(geometry_, job.planes()) {}

  Result<std::shared_ptr<const BoundaryMesh>> run(std::vector<FragmentSet> sets,
                                                  std::vector<WholePolygon> whole,
                                                  Touching touching,
                                                  std::vector<UntouchedPart> parts) {
    gather(std::move(sets), std::move(whole));
    std::sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) {
      return std::tie(a.plane, a.label, a.polygon, a.first) <
             std::tie(b.plane, b.label, b.polygon, b.first);
    });
    find_groups();
    const uint32_t open = make_faces();
    if (open != kNone) {
      return Error{ErrorCode::kInternal,
                   "the pieces of a face do not close up (plane " +
                       std::to_string(pieces_[groups_[open]].plane.index()) + ")",
                   {}};
    }
    const auto may_be_complete = [&](uint32_t group) {
      return face_of_group_[group] != kNone &&
             job_.is_of_complete_facet(job_.polygons()[pieces_[groups_[group]].polygon]);
    };
    for (const uint32_t group : numbers_where(face_of_group_.size(), may_be_complete)) {
      find_completeness(group);
    }
    for (UntouchedPart& part : parts) {
      for (UntouchedPart::Shared& s : part.shared) {
        s.point = s.point < vertex_number_.size() ? vertex(s.point) : kNone;
      }
    }
    release_pieces();
    std::vector<uint32_t> number;
    auto mesh = std::make_shared<BoundaryMesh>(
        canonical(geometry_, job_.planes(), std::move(draft_), &number));
    mesh->may_touch = touching.anywhere || !touching.boxes.empty();
    if (!touching.anywhere) mesh->touches = std::move(touching.boxes);
    for (UntouchedPart& part : parts) {
      for (UntouchedPart::Shared& s : part.shared) {
        if (s.point >= number.size() || number[s.point] == kNone) {
          return Error{ErrorCode::kInternal, "an untouched face shares a corner with no other", {}};
        }
        s.point = number[s.point];
      }
    }
    mesh->parts = std::move(parts);
    return std::shared_ptr<const BoundaryMesh>(std::move(mesh));
  }

 private:
  static constexpr uint32_t kNamed = 1u << 31;  ///< see gather

  struct Piece {
    PlaneId plane;
    FaceLabel label;
    uint32_t polygon, first, count;
    bool whole;
    bool is_loose = false;
  };

  /// Lists pieces and their corners: at first vertices of the job by their numbers, other points by
  /// kNamed + number.
  void gather(std::vector<FragmentSet> sets, std::vector<WholePolygon> whole) {
    for (FragmentSet& set : sets) gather_cut(std::exchange(set, {}));
    gather_whole(std::move(whole));
    number_corners();
  }

  void gather_cut(FragmentSet set) {
    const std::vector<uint32_t> number = number_points(set);
    std::vector<uint32_t> first(set.pieces.size() + 1);
    first[0] = static_cast<uint32_t>(corners_.size());
    for (size_t i = 0; i < set.pieces.size(); ++i) first[i + 1] = first[i] + set.pieces[i].count;
    const size_t before = pieces_.size();
    pieces_.resize(before + set.pieces.size());
    corners_.resize(first.back());
    planes_.resize(first.back());
    for_each_range(set.pieces.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const FragmentSet::Piece& p = set.pieces[i];
        pieces_[before + i] = {
            p.plane,   job_.label(job_.polygons()[p.polygon]), p.polygon, first[i], p.count, false,
            p.is_loose};
        for (uint32_t c = 0; c < p.count; ++c) {
          corners_[first[i] + c] = number[set.corner_point[p.first + c]];
          planes_[first[i] + c] = set.corner_plane[p.first + c];
        }
      }
    });
  }

  /// Makes points of those of a set that are no vertices. What corners are to be, see gather.
  std::vector<uint32_t> number_points(const FragmentSet& set) {
    const std::vector<uint32_t> made =
        numbers_where(set.points.size(), [&](uint32_t i) { return set.points[i].vertex == kNone; });
    const std::vector<uint32_t> points = add_points(made.size(), [&](size_t i, uint32_t p) {
      geometry_.set_point(p, set.points[made[i]].planes, set.points[made[i]].rounded);
    });
    std::vector<uint32_t> number(set.points.size());
    for_each_range(number.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) number[i] = set.points[i].vertex;
    });
    for_each_range(made.size(), [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) number[made[i]] = kNamed | points[i];
    });
    return number;
  }

  /// Adds points, of which set(i, number) sets one, and returns what they are in the index.
  template <class Set>
  std::vector<uint32_t> add_points(size_t count, Set&& set) {
    std::vector<uint32_t> points(count);
    const uint32_t first = geometry_.add_points(count);
    for_each_range(count, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        points[i] = first + static_cast<uint32_t>(i);
        set(i, points[i]);
      }
    });
    index_.make_unique(points);
    for (uint32_t& p : points) p = index_.known(p);
    return points;
  }

  void gather_whole(std::vector<WholePolygon> whole) {
    std::vector<uint32_t> polygons(whole.size()), first(whole.size() + 1);
    first[0] = static_cast<uint32_t>(corners_.size());
    for (size_t w = 0; w < whole.size(); ++w) {
      polygons[w] = whole[w].polygon;
      first[w + 1] = first[w] + job_.polygons()[polygons[w]].count;
    }
    job_.ensure_planes(polygons);
    const size_t before = pieces_.size();
    pieces_.resize(before + whole.size());
    corners_.resize(first.back());
    planes_.resize(first.back());
    for_each_range(whole.size(), [&](size_t begin, size_t end) {
      for (size_t w = begin; w < end; ++w) {
        const JobPolygon& p = job_.polygons()[polygons[w]];
        const bool flip = whole[w].flip;
        pieces_[before + w] = {flip ? p.support.flip() : p.support,
                               job_.label(p),
                               polygons[w],
                               first[w],
                               p.count,
                               true};
        each_corner(p, flip, [&, next = first[w]](uint32_t vertex, uint32_t plane) mutable {
          corners_[next] = vertex;
          planes_[next++] = plane;
        });
      }
    });
  }

  /// Makes points of all corners.
  void number_corners() {
    std::vector<uint8_t> is_used(job_.vertex_count(), 0);
    for_each_range(corners_.size(), [&](size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        if (corners_[c] & kNamed) continue;
        std::atomic_ref(is_used[corners_[c]]).store(1, std::memory_order_relaxed);
      }
    });
    const auto used = numbers_where(is_used.size(), [&](uint32_t v) { return is_used[v] != 0; });
    const std::vector<uint32_t> points = add_points(
        used.size(), [&](size_t i, uint32_t p) { geometry_.set_vertex_point(p, used[i]); });
    vertex_number_.assign(job_.vertex_count(), kNone);
    for (size_t i = 0; i < used.size(); ++i) vertex_number_[used[i]] = points[i];
    for_each_range(corners_.size(), [&](size_t begin, size_t end) {
      for (size_t c = begin; c < end; ++c) {
        uint32_t& corner = corners_[c];
        corner = corner & kNamed ? corner & ~kNamed : vertex_number_[corner];
      }
    });
  }

  void add_polygon(const JobPolygon& p, bool flip) {
    each_corner(p, flip, [&](uint32_t v, uint32_t plane) {
      corners_.push_back(vertex(v));
      planes_.push_back(plane);
    });
  }

  /// Calls visit(vertex of the job, plane of the edge that leaves it) round a polygon.
  template <class Visit>
  void each_corner(const JobPolygon& p, bool flip, Visit&& visit) const {
    const auto corners = job_.corners(p);
    const auto edges = job_.edge_planes(p);
    for (uint32_t i = 0; i < p.count; ++i) {
      visit(corners[corner_place(i, p.count, flip)], edges[edge_place(i, p.count, flip)]);
    }
  }

  uint32_t vertex(uint32_t v) {
    if (vertex_number_[v] == kNone) vertex_number_[v] = index_.unique(geometry_.vertex_point(v));
    return vertex_number_[v];
  }

  void edges_of(const Piece& p, std::vector<DirectedEdge>& edges) const {
    for (uint32_t i = 0; i < p.count; ++i) {
      const uint32_t next = i + 1 < p.count ? i + 1 : 0;
      edges.push_back({corners_[p.first + i], corners_[p.first + next], planes_[p.first + i]});
    }
  }

  /// Pieces that share plane, side and label stand together.
  void find_groups() {
    for (size_t i = 0; i < pieces_.size(); ++i) {
      if (i > 0 && pieces_[i].plane == pieces_[i - 1].plane &&
          pieces_[i].label == pieces_[i - 1].label) {
        continue;
      }
      groups_.push_back(static_cast<uint32_t>(i));
    }
    face_of_group_.resize(groups_.size());
    groups_.push_back(static_cast<uint32_t>(pieces_.size()));
  }

  /// What is not needed once there are faces: as much memory as these.
  void release_pieces() {
    const auto release = [](auto&... all) {
      ((all = std::remove_reference_t<decltype(all)>()), ...);
    };
    release(pieces_, corners_, planes_, groups_, face_of_group_, by_label_, vertex_number_);
    index_.release();
  }

  /// Makes a face of each group that leaves one, on several threads. Returns the first group whose
  /// pieces do not close up, or kNone.
  uint32_t make_faces() {
    constexpr size_t kCornersPerPart = 4096;  // if they are not of one face
    const size_t count = face_of_group_.size();
    const std::vector<size_t> starts = part_starts(count, kCornersPerPart, [&](size_t g) {
      size_t corners = 0;
      for (uint32_t i = groups_[g]; i < groups_[g + 1]; ++i) corners += pieces_[i].count;
      return corners;
    });
    if (starts.size() <= 2) return FaceMaker(*this).make(0, count, draft_);
    for_each_range(geometry_.point_count(), [&](size_t begin, size_t end) {
      for (size_t p = begin; p < end; ++p) geometry_.find_on_grid(static_cast<uint32_t>(p));
    });
    std::vector<DraftBoundary> drafts(starts.size() - 1);
    std::vector<uint32_t> open(drafts.size(), kNone);
    make_parts_in_order(
        drafts.size(),
        [&](size_t part) {
          open[part] = FaceMaker(*this).make(starts[part], starts[part + 1], drafts[part]);
        },
        [&](size_t part) {
          const auto before = static_cast<uint32_t>(draft_.faces.size());
          for (size_t g = starts[part]; g < starts[part + 1]; ++g) {
            if (face_of_group_[g] != kNone) face_of_group_[g] += before;
          }
          draft_.append(drafts[part]);
          drafts[part] = {};
        });
    const auto first_open =
        std::find_if(open.begin(), open.end(), [](uint32_t g) { return g != kNone; });
    return first_open == open.end() ? kNone : *first_open;
  }

  /// Makes faces for one thread; reads what was gathered.
  class FaceMaker {
   public:
    explicit FaceMaker(Assembler& all) : all_(all), builder_(all.geometry_, all.job_.planes()) {}

    /// Adds the faces of groups [begin, end) to `draft` and notes their numbers there. Returns the
    /// first group whose pieces do not close up, or kNone.
    uint32_t make(size_t begin, size_t end, DraftBoundary& draft) {
      for (size_t g = begin; g < end; ++g) {
        const size_t before = draft.faces.size();
        if (!add_face(all_.groups_[g], all_.groups_[g + 1], draft)) return static_cast<uint32_t>(g);
        all_.face_of_group_[g] =
            draft.faces.size() > before ? static_cast<uint32_t>(before) : kNone;
      }
      return kNone;
    }

   private:
    /// Makes one face of pieces [begin, end), if they leave one; false if they do not close up.
    bool add_face(size_t begin, size_t end, DraftBoundary& draft) {
      edges_.clear();
      for (size_t i = begin; i < end; ++i) all_.edges_of(all_.pieces_[i], edges_);
      const Piece& first = all_.pieces_[begin];
      if (end - begin == 1 && first.whole && first.count == 3) {
        // All its corners are true ones.
        draft.begin_face(first.plane, first.label, false, false);
        draft.edges.insert(draft.edges.end(), edges_.begin(), edges_.end());
        draft.end_loop();
        return true;
      }
      const bool built = end - begin == 1 && !first.is_loose
                             ? builder_.build_single(first.plane, edges_, loops_)
                             : builder_.build(first.plane, edges_, loops_);
      if (!built) return false;
      if (loops_.loop_count() == 0) return true;
      draft.begin_face(first.plane, first.label, false, false);
      for (size_t l = 0; l < loops_.loop_count(); ++l) {
        draft.edges.insert(draft.edges.end(), loops_.edges.begin() + loops_.starts[l],
                           loops_.edges.begin() + loops_.starts[l + 1]);
        draft.end_loop();
      }
      return true;
    }

    Assembler& all_;
    RegionBuilder builder_;
    std::vector<DirectedEdge> edges_;
    RegionLoops loops_;
  };

  /// Whether the face of a group is the whole facet that its pieces come from, alone or together
  /// with the pieces on the other side of the plane.
  void find_completeness(uint32_t group) {
    const size_t begin = groups_[group], end = groups_[group + 1];
    DraftBoundary::Face& face = draft_.faces[face_of_group_[group]];
    const Piece first = pieces_[begin];
    // The pieces of a plane stand together: mostly there is no other side, or no other label.
    auto other_begin = pieces_.begin() + end, other_end = other_begin;
    const auto in_plane = [&](size_t i) { return pieces_[i].plane.index() == first.plane.index(); };
    if ((begin > 0 && in_plane(begin - 1)) || (end < pieces_.size() && in_plane(end))) {
      const Piece other{first.plane.flip(), first.label, 0, 0, 0, false};
      std::tie(other_begin, other_end) = std::equal_range(
          pieces_.begin(), pieces_.end(), other, [](const Piece& a, const Piece& b) {
            return std::tie(a.plane, a.label) < std::tie(b.plane, b.label);
          });
    }
    const bool alone = other_begin == other_end;
    const std::vector<uint32_t>& polygons = facet_of(first);
    // (All of them here leave nothing for the other side.)
    bool complete = polygons.size() == end - begin &&
                    std::all_of(pieces_.begin() + begin, pieces_.begin() + end,
                                [](const Piece& p) { return p.whole; });
    if (!complete && !(alone && has_new_corner(face, polygons))) {
      facet_.clear();
      const size_t mark = corners_.size();
      for (const uint32_t q : polygons) {
        job_.ensure_planes(q);
        const JobPolygon& p = job_.polygons()[q];
        const Piece piece{first.plane, first.label, q, static_cast<uint32_t>(corners_.size()),
                          p.count,     true};
        add_polygon(p, p.support != first.plane);
        edges_of(piece, facet_);
      }
      corners_.resize(mark);
      planes_.resize(mark);
      edges_.clear();
      for (size_t i = begin; i < end; ++i) edges_of(pieces_[i], edges_);
      for (auto p = other_begin; p != other_end; ++p) {
        const size_t at = edges_.size();
        edges_of(*p, edges_);
        for (size_t i = at; i < edges_.size(); ++i) std::swap(edges_[i].from, edges_[i].to);
      }
      complete = builder_.build(first.plane, facet_, facet_loops_) &&
                 builder_.build(first.plane, edges_, both_sides_) &&
                 same_loops(facet_loops_, both_sides_);
    }
    face.complete = complete;
    face.whole = complete && alone;
  }

  /// Whether a face has a corner that none of the polygons has.
  bool has_new_corner(const DraftBoundary::Face& face, const std::vector<uint32_t>& polygons) {
    constexpr size_t kFew = 16;
    old_corners_.clear();
    for (const uint32_t q : polygons) {
      for (const uint32_t v : job_.corners(job_.polygons()[q])) old_corners_.push_back(vertex(v));
      if (old_corners_.size() > kFew) return false;
    }
    const uint32_t first = draft_.loop_starts[face.first_loop],
                   last = draft_.loop_starts[face.first_loop + face.loop_count];
    return std::any_of(
        draft_.edges.begin() + first, draft_.edges.begin() + last, [&](const DirectedEdge& e) {
          return std::find(old_corners_.begin(), old_corners_.end(), e.from) == old_corners_.end();
        });
  }

  /// The polygons of the facet that a piece comes from, which lie in its plane.
  const std::vector<uint32_t>& facet_of(const Piece& piece) {
    const auto& all = job_.polygons();
    const JobPolygon& own = all[piece.polygon];
    std::vector<uint32_t>& polygons = facet_polygons_;
    polygons.clear();
    if (job_.is_of_whole_facet(own)) {
      const auto same = [&](uint32_t q) {
        return all[q].operand == own.operand && job_.label(all[q]) == piece.label;
      };
      uint32_t lo = piece.polygon, hi = piece.polygon + 1;
      while (lo > 0 && same(lo - 1)) --lo;
      while (hi < all.size() && same(hi)) ++hi;
      for (uint32_t q = lo; q < hi; ++q) {
        job_.ensure_support(q);
        if (all[q].support.index() == piece.plane.index()) polygons.push_back(q);
      }
      return polygons;
    }
    // The two sides of a facet stand anywhere in the operand, which is a materialised result and
    // has its planes.
    auto& sorted = by_label_[own.operand];
    const auto key = [&](uint32_t q) {
      return std::pair(job_.label(all[q]), all[q].support.index());
    };
    if (sorted.empty()) {
      sorted.resize(job_.polygon_start(own.operand + 1) - job_.polygon_start(own.operand));
      std::iota(sorted.begin(), sorted.end(), job_.polygon_start(own.operand));
      std::stable_sort(sorted.begin(), sorted.end(),
                       [&](uint32_t p, uint32_t q) { return key(p) < key(q); });
    }
    auto at = std::lower_bound(sorted.begin(), sorted.end(), piece.polygon,
                               [&](uint32_t p, uint32_t q) { return key(p) < key(q); });
    for (; at != sorted.end() && key(*at) == key(piece.polygon); ++at) polygons.push_back(*at);
    return polygons;
  }

  static bool same_loops(const RegionLoops& a, const RegionLoops& b) {
    if (a.starts.size() != b.starts.size() || a.edges.size() != b.edges.size()) return false;
    const auto sorted_edges = [](const RegionLoops& l) {
      std::vector<std::pair<uint32_t, uint32_t>> e;
      for (const DirectedEdge& d : l.edges) e.emplace_back(d.from, d.to);
      std::sort(e.begin(), e.end());
      return e;
    };
    return sorted_edges(a) == sorted_edges(b);
  }

  Job& job_;
  CellGeometry geometry_;
  PointIndex index_;
  RegionBuilder builder_;
  std::vector<uint32_t> vertex_number_;
  RawVector<Piece> pieces_;
  RawVector<uint32_t> corners_, planes_;
  std::vector<uint32_t> groups_;         ///< the first piece of each, and the end
  std::vector<uint32_t> face_of_group_;  ///< in the draft, or kNone
  std::vector<DirectedEdge> edges_, facet_;
  RegionLoops facet_loops_, both_sides_;
  std::vector<uint32_t> facet_polygons_, old_corners_;
  std::map<uint32_t, std::vector<uint32_t>> by_label_;  ///< per operand
  DraftBoundary draft_;
};

}  // namespace

Result<std::shared_ptr<const BoundaryMesh>> assemble(Job& job, std::vector<FragmentSet> sets,
                                                     std::vector<WholePolygon> whole,
                                                     Touching touching,
                                                     std::vector<UntouchedPart> parts) {
  return Assembler(job).run(std::move(sets), std::move(whole), std::move(touching),
                            std::move(parts));
}

}  // namespace csgrun

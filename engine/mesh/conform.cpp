#include "engine/mesh/conform.h"

#include <algorithm>
#include <optional>

#include "engine/base/raw_vector.h"
#include "engine/bsp/point_index.h"
#include "engine/mesh/box_tree.h"
#include "engine/mesh/common_line.h"
#include "engine/mesh/face_search.h"
#include "engine/mesh/met_edges.h"
#include "engine/mesh/self_contact.h"

namespace csgrun {
namespace {

/// Points to be found by boxes.
class PointTree {
 public:
  PointTree(std::span<const uint32_t> points, const CellGeometry& geometry)
      : points_(points), boxes_(boxes_of(points, geometry)), tree_(boxes_) {}

  /// Calls f(point) for those in a box of rounded coordinates.
  template <class F>
  void find(const Box& box, F&& f) const {
    tree_.visit_all(box, [&](uint32_t i) { f(points_[i]); });
  }

 private:
  static std::vector<Box> boxes_of(std::span<const uint32_t> points, const CellGeometry& geometry) {
    std::vector<Box> boxes;
    boxes.reserve(points.size());
    for (const uint32_t p : points) {
      const auto& at = geometry.point(p).rounded;
      boxes.push_back({at, at});
    }
    return boxes;
  }

  std::span<const uint32_t> points_;
  const std::vector<Box> boxes_;
  const BoxTree tree_;
};

class Conformer {
 public:
  Conformer(std::vector<MergedFace>& faces, std::span<const uint32_t> near, CellGeometry& geometry,
            const PlaneTable& planes)
      : faces_(faces),
        near_(near),
        geometry_(geometry),
        view_(geometry),
        planes_(planes),
        search_(faces, geometry, view_, planes),
        edges_(edges_of(faces, near)),
        boxes_(boxes_of(edges_, geometry)),
        tree_(boxes_),
        place_of_(faces.size()),
        face_boxes_(near.size()),
        corner_of_(geometry.point_count(), kNone),
        located_in_(geometry.point_count(), kNone),
        next_(geometry.point_count(), kNone),
        previous_(geometry.point_count(), kNone),
        sides_(near.size()),
        lying_(near.size()) {
    for (size_t i = 0; i < near.size(); ++i) place_of_[near[i]] = static_cast<uint32_t>(i);
  }

  void run() {
    const MetEdges near(edges_, boxes_, tree_, geometry_);
    for (size_t place = 0; place < near.face_count(); ++place) {
      face_boxes_[place_of_[near.face(place)]] = near.box(place);
    }
    near.each([&](uint32_t f) { return planes_.approximate(faces_[f].plane.index()); },
              [&](size_t place, std::span<const MetEdges::Met> met) {
                const uint32_t f = near.face(place);
                mark_face(f, near.start(place), near.start(place + 1));
                for (const MetEdges::Met& m : met) look_at(f, m);
              },
              straddling_);
    std::sort(straddling_.begin(), straddling_.end());
    straddling_.erase(std::unique(straddling_.begin(), straddling_.end()), straddling_.end());
    for (const auto& [f, g] : straddling_) {
      if (!may_meet_on_line(f, g)) continue;
      const Box box = common_box(f, g);
      cross_edges(f, g, box);
      cross_faces(f, g, box);
    }
    const size_t touched = lying_faces_.size();
    for (size_t i = 0; i < touched; ++i) cross_lying_edges(lying_faces_[i]);
    if (contacts_.empty() && touched == 0) return;
    std::sort(contacts_.begin(), contacts_.end());
    contacts_.erase(std::unique(contacts_.begin(), contacts_.end()), contacts_.end());
    break_edges();
    const PointTree contacts(contacts_, geometry_);
    for (const uint32_t f : lying_faces_) find_slits(f, contacts);
    find_points();
  }

 private:
  /// An edge in the plane of a face that it is no edge of; `other`: the face through which it runs,
  /// too, or kNone for an edge of a face.
  struct Lying {
    DirectedEdge edge;
    uint32_t other;
  };

  using Ends = std::pair<uint32_t, uint32_t>;
  /// On which sides of a face's plane edges of another face were seen.
  struct Sides {
    uint32_t of = kNone;
    SidesOfPlane sides;
  };

  /// In the order of faces and their loops.
  static std::vector<FaceEdge> edges_of(const std::vector<MergedFace>& faces,
                                        std::span<const uint32_t> near) {
    std::vector<FaceEdge> edges;
    for (const uint32_t f : near) {
      for (const auto& loop : faces[f].loops) {
        for (const DirectedEdge& e : loop) edges.push_back({e, f});
      }
    }
    return edges;
  }

  static std::vector<Box> boxes_of(const std::vector<FaceEdge>& edges,
                                   const CellGeometry& geometry) {
    std::vector<Box> boxes;
    boxes.reserve(edges.size());
    for (const FaceEdge& e : edges) boxes.push_back(box_of(e.edge, geometry));
    return boxes;
  }

  /// Marks the corners and the rim of the face that is looked at from now on.
  void mark_face(uint32_t f, uint32_t begin, uint32_t end) {
    rim_.clear();
    bool is_simple = true;
    for (uint32_t i = begin; i < end; ++i) {
      const DirectedEdge& e = edges_[i].edge;
      is_simple = is_simple && corner_of_[e.from] != f;
      corner_of_[e.from] = f;
      next_[e.from] = e.to;
      previous_[e.to] = e.from;
    }
    if (is_simple) return;
    for (uint32_t i = begin; i < end; ++i) {
      rim_.push_back(std::minmax(edges_[i].edge.from, edges_[i].edge.to));
    }
    std::sort(rim_.begin(), rim_.end());
  }

  /// Whether an edge between corners of the face that is marked is one of its own.
  [[nodiscard]] bool is_marked_rim(const DirectedEdge& e) const {
    if (next_[e.from] == e.to || previous_[e.from] == e.to) return true;
    return !rim_.empty() &&
           std::binary_search(rim_.begin(), rim_.end(), Ends(std::minmax(e.from, e.to)));
  }

  /// What an edge of another face does to face f, which is marked.
  void look_at(uint32_t f, const MetEdges::Met& met) {
    const uint32_t g = edges_[met.edge].face;
    const DirectedEdge& e = edges_[met.edge].edge;
    const uint32_t support = faces_[f].plane.index();
    const bool from_shared = corner_of_[e.from] == f, to_shared = corner_of_[e.to] == f;
    const int from = from_shared ? 0 : geometry_.side(support, e.from);
    const int to = to_shared ? 0 : geometry_.side(support, e.to);
    if (from == 0 && !from_shared && located_in_[e.from] != f && in_box(f, e.from)) {
      located_in_[e.from] = f;
      touch(f, e.from);
    }
    note_sides(f, g, met.sides, from, to);
    if (from != 0 || to != 0 || faces_[g].plane.index() == support) return;
    // An edge of f itself is none that may run through it.
    if (from_shared && to_shared && is_marked_rim(e)) return;
    add_lying(f, {{e.from, e.to, e.plane == support ? faces_[g].plane.index() : e.plane}, kNone});
  }

  /// Notes the pair when edges of g near f lie on both sides of f's plane; `known` are those of
  /// edges that do not touch it.
  void note_sides(uint32_t f, uint32_t g, SidesOfPlane known, int from, int to) {
    Sides& seen = sides_[place_of_[g]];
    if (seen.of != f) seen = {f, known};
    if (seen.sides.both()) return;
    seen.sides.note(from, to);
    if (seen.sides.both()) straddling_.push_back(std::minmax(f, g));
  }

  [[nodiscard]] bool in_box(uint32_t f, uint32_t p) const {
    const auto& at = geometry_.point(p).rounded;
    return face_boxes_[place_of_[f]].overlaps({at, at});
  }

  void touch(uint32_t f, uint32_t p) {
    const int where = search_.locate(f, p);
    if (where >= 0) contacts_.push_back(p);
    if (where > 0) inner_.push_back({f, p});
  }

  void add_lying(uint32_t f, const Lying& lying) {
    std::vector<Lying>& own = lying_[place_of_[f]];
    if (own.empty()) lying_faces_.push_back(f);
    own.push_back(lying);
  }

  /// A box that holds what two faces have in common.
  [[nodiscard]] Box common_box(uint32_t f, uint32_t g) const {
    Box box = face_boxes_[place_of_[f]];
    const Box& other = face_boxes_[place_of_[g]];
    for (size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::max(box.lo[k], other.lo[k]);
      box.hi[k] = std::min(box.hi[k], other.hi[k]);
    }
    return box;
  }

  /// Where edges of the two faces, each of which passes through the plane of the other face, meet.
  /// `box` is common to them.
  void cross_edges(uint32_t f, uint32_t g, const Box& box) {
    const uint32_t f_plane = faces_[f].plane.index(), g_plane = faces_[g].plane.index();
    const auto passing = [&](uint32_t face, uint32_t plane, std::vector<DirectedEdge>& edges) {
      search_.find(face, box, edges);
      std::erase_if(edges, [&](const DirectedEdge& e) { return !passes(e, plane); });
    };
    std::vector<DirectedEdge> of_f, of_g;
    passing(f, g_plane, of_f);
    passing(g, f_plane, of_g);
    for (const DirectedEdge& e : of_g) {
      for (const DirectedEdge& r : of_f) {
        if (!boxes_meet(e, r)) continue;
        const uint32_t x = geometry_.add_point({g_plane, e.plane, f_plane});
        if (geometry_.side(r.plane, x) != 0 || !lies_inside(geometry_, r, x) ||
            !lies_inside(geometry_, e, x)) {
          continue;
        }
        contacts_.push_back(unique(x));
      }
    }
  }

  /// Whether two faces may have more of the line of their planes in common than a corner of both.
  /// Of a face of very many edges all may, as these are not looked at.
  bool may_meet_on_line(uint32_t f, uint32_t g) {
    if (search_.has_many_edges(f) || search_.has_many_edges(g)) {
      return face_boxes_[place_of_[f]].overlaps(face_boxes_[place_of_[g]]);
    }
    return may_share_line(faces_[f], faces_[g], geometry_, planes_);
  }

  /// Faces may pass through each other along a line where wedges of material touch crosswise: of
  /// both, only what is left and right of the line bounds anything. `box` is common to both faces.
  void cross_faces(uint32_t f, uint32_t g, const Box& box) {
    on_line_.clear();
    meet_plane(f, faces_[g].plane.index(), box);
    meet_plane(g, faces_[f].plane.index(), box);
    const LineAxis line =
        line_axis(planes_.plane(faces_[f].plane.index()), planes_.plane(faces_[g].plane.index()));
    for (uint32_t& p : on_line_) p = unique(p);
    std::sort(on_line_.begin(), on_line_.end(),
              [&](uint32_t p, uint32_t q) { return geometry_.compare_along(p, q, line.axis) < 0; });
    on_line_.erase(std::unique(on_line_.begin(), on_line_.end()), on_line_.end());
    for (size_t i = 1; i < on_line_.size(); ++i) {
      const uint32_t p = on_line_[i - 1], q = on_line_[i];
      if (search_.locate(f, p) < 0 || search_.locate(f, q) < 0) continue;
      if (search_.locate(g, p) < 0 || search_.locate(g, q) < 0) continue;
      contacts_.push_back(p);
      contacts_.push_back(q);
      add_lying(f, {{p, q, faces_[g].plane.index()}, g});
      add_lying(g, {{p, q, faces_[f].plane.index()}, f});
    }
  }

  /// Adds the points in which the rim of a face meets a plane, those in a box at least.
  void meet_plane(uint32_t f, uint32_t plane, const Box& box) {
    found_.clear();
    search_.find(f, box, found_);
    for (const DirectedEdge& e : found_) {
      const int here = geometry_.side(plane, e.from), there = geometry_.side(plane, e.to);
      if (here == 0) on_line_.push_back(e.from);
      if (here * there < 0) {
        on_line_.push_back(geometry_.add_point({faces_[f].plane.index(), e.plane, plane}));
      }
    }
  }

  [[nodiscard]] bool boxes_meet(const DirectedEdge& e, const DirectedEdge& r) const {
    return box_of(e, geometry_).overlaps(box_of(r, geometry_));
  }

  [[nodiscard]] bool passes(const DirectedEdge& e, uint32_t plane) {
    return geometry_.side(plane, e.from) * geometry_.side(plane, e.to) < 0;
  }

  static bool have_common_end(const DirectedEdge& a, const DirectedEdge& b) {
    return a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to;
  }

  /// Whether an edge in the plane of a face leaves it at one of its corners and meets it nowhere
  /// else, as all edges around a corner do that many faces have in common. `rim`: the face's edges
  /// whose boxes meet that of the edge. When it is not certain, it does not.
  bool only_leaves_corner(uint32_t f, DirectedEdge e, std::span<const DirectedEdge> rim) {
    const auto is_corner = [&](uint32_t p) {
      return std::any_of(rim.begin(), rim.end(), [p](const auto& r) { return r.from == p; });
    };
    if (is_corner(e.from) == is_corner(e.to)) return false;
    if (is_corner(e.to)) std::swap(e.from, e.to);
    const auto is_clear = [&](const DirectedEdge& r) {
      const int from = geometry_.side(e.plane, r.from), to = geometry_.side(e.plane, r.to);
      if (r.from == e.from || r.to == e.from) return from != 0 || to != 0;
      return from * to > 0 || geometry_.side(r.plane, e.from) * geometry_.side(r.plane, e.to) > 0;
    };
    return std::all_of(rim.begin(), rim.end(), is_clear) && !search_.starts_inside(f, e);
  }

  /// Where the edges that lie in the plane of a face cross its rim, and each other within it. Those
  /// that only leave a corner of the face are dropped.
  void cross_lying_edges(uint32_t f) {
    const uint32_t support = faces_[f].plane.index();
    const auto cross = [&](const DirectedEdge& a, const DirectedEdge& b) {
      if (!passes(a, b.plane) || !passes(b, a.plane)) return;
      contacts_.push_back(unique(geometry_.add_point({support, a.plane, b.plane})));
    };
    std::vector<Lying>& lines = lying_[place_of_[f]];
    std::vector<Box> boxes;
    std::vector<DirectedEdge> rim;  // near each line, one after another
    std::vector<size_t> rim_ends;
    std::erase_if(lines, [&](const Lying& line) {
      const size_t first = rim.size();
      boxes.push_back(box_of(line.edge, geometry_));
      search_.find(f, boxes.back(), rim);
      if (line.other == kNone && only_leaves_corner(f, line.edge, std::span(rim).subspan(first))) {
        rim.resize(first);
        boxes.pop_back();
        return true;
      }
      rim_ends.push_back(rim.size());
      return false;
    });
    const BoxTree tree(boxes);
    // In the order of edges: which points are made first must not depend on the trees.
    std::vector<uint32_t> met;
    size_t next = 0;
    for (uint32_t i = 0; i < lines.size(); ++i) {
      for (; next < rim_ends[i]; ++next) cross(lines[i].edge, rim[next]);
      met.clear();
      tree.visit_later(i, [&](uint32_t j) {
        if (!have_common_end(lines[i].edge, lines[j].edge)) met.push_back(j);
      });
      std::sort(met.begin(), met.end());
      for (const uint32_t j : met) cross(lines[i].edge, lines[j].edge);
    }
  }

  /// The number of a point made here: that of an equal one that was there before.
  uint32_t unique(uint32_t point) {
    if (!index_) {
      index_.emplace(geometry_);
      for (const uint32_t f : near_) {
        for (const auto& loop : faces_[f].loops) {
          for (const DirectedEdge& e : loop) index_->unique(e.from);
        }
      }
    }
    return index_->unique(point);
  }

  /// Breaks the edges of all faces at the contacts that lie inside them.
  void break_edges() {
    std::vector<std::pair<uint32_t, uint32_t>> inside;  // edge, contact
    for (const uint32_t p : contacts_) {
      const auto& at = geometry_.point(p).rounded;
      tree_.visit_all({at, at}, [&](uint32_t e) {
        if (geometry_.side(faces_[edges_[e].face].plane.index(), p) == 0 &&
            lies_inside(geometry_, edges_[e].edge, p)) {
          inside.push_back({e, p});
        }
      });
    }
    std::sort(inside.begin(), inside.end());
    std::vector<DirectedEdge> broken;
    std::vector<uint32_t> points;
    uint32_t number = 0;
    auto next = inside.begin();
    for (const uint32_t f : near_) {
      for (auto& loop : faces_[f].loops) {
        const auto count = static_cast<uint32_t>(loop.size());
        if (next != inside.end() && next->first < number + count) {
          broken.clear();
          for (uint32_t i = 0; i < count; ++i) {
            points.clear();
            for (; next != inside.end() && next->first == number + i; ++next) {
              points.push_back(next->second);
            }
            append_broken(geometry_, loop[i], points, broken);
          }
          loop = broken;
        }
        number += count;
      }
    }
    if (inside.empty()) return;
    search_.forget();
    break_partners(inside);
  }

  /// Breaks the edges of faces that are not near where the faces that share them were broken.
  void break_partners(std::span<const std::pair<uint32_t, uint32_t>> inside) {
    std::vector<std::pair<Ends, uint32_t>> broken;
    std::vector<uint8_t> is_end(geometry_.point_count(), 0);
    for (const auto& [e, p] : inside) {
      const Ends ends = std::minmax(edges_[e].edge.from, edges_[e].edge.to);
      broken.emplace_back(ends, p);
      is_end[ends.first] = 1;
    }
    std::sort(broken.begin(), broken.end());
    broken.erase(std::unique(broken.begin(), broken.end()), broken.end());
    std::vector<DirectedEdge> parts;
    std::vector<uint32_t> points;
    auto next_near = near_.begin();
    for (uint32_t f = 0; f < faces_.size(); ++f) {
      if (next_near != near_.end() && *next_near == f) {
        ++next_near;
        continue;
      }
      for (auto& loop : faces_[f].loops) {
        parts.clear();
        for (const DirectedEdge& e : loop) {
          points.clear();
          const Ends ends = std::minmax(e.from, e.to);
          if (is_end[ends.first] != 0) {
            for (auto at = std::lower_bound(broken.begin(), broken.end(), std::pair(ends, 0u));
                 at != broken.end() && at->first == ends; ++at) {
              points.push_back(at->second);
            }
          }
          append_broken(geometry_, e, points, parts);
        }
        if (parts.size() != loop.size()) loop = parts;
      }
    }
  }

  /// The parts of lying edges that are inside their face.
  void find_slits(uint32_t f, const PointTree& contacts) {
    if (lying_[place_of_[f]].empty()) return;
    MergedFace& face = faces_[f];
    std::vector<uint32_t> points;
    contacts.find(face_boxes_[place_of_[f]], [&](uint32_t p) {
      if (geometry_.side(face.plane.index(), p) == 0) points.push_back(p);
    });
    for (const auto& loop : face.loops) {
      for (const DirectedEdge& e : loop) points.push_back(e.from);
    }
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const PointTree near(points, geometry_);
    std::vector<DirectedEdge> parts;
    std::vector<uint32_t> inside;
    for (const Lying& lying : lying_[place_of_[f]]) {
      inside.clear();
      near.find(box_of(lying.edge, geometry_), [&](uint32_t p) {
        if (lies_inside(geometry_, lying.edge, p)) inside.push_back(p);
      });
      parts.clear();
      append_broken(geometry_, lying.edge, inside, parts);
      for (const DirectedEdge& e : parts) {
        if (!search_.runs_inside(f, e)) continue;
        if (lying.other != kNone) {
          const DirectedEdge there{e.from, e.to, face.plane.index()};
          if (!search_.runs_inside(lying.other, there)) continue;
        }
        face.own_contacts().slits.push_back(std::minmax({e.from, e.to}));
      }
    }
    if (!face.contacts) return;
    auto& slits = face.contacts->slits;
    std::sort(slits.begin(), slits.end());
    slits.erase(std::unique(slits.begin(), slits.end()), slits.end());
  }

  /// The corners within faces at which no slit ends.
  void find_points() {
    std::sort(inner_.begin(), inner_.end());
    inner_.erase(std::unique(inner_.begin(), inner_.end()), inner_.end());
    for (const auto& [f, p] : inner_) {
      const auto slits = faces_[f].slits();
      const bool ends_slit = std::any_of(slits.begin(), slits.end(), [p = p](const auto& s) {
        return s.first == p || s.second == p;
      });
      if (!ends_slit) faces_[f].own_contacts().points.push_back(p);
    }
  }

  std::vector<MergedFace>& faces_;
  std::span<const uint32_t> near_;
  CellGeometry& geometry_;
  PointView view_;
  const PlaneTable& planes_;
  FaceSearch search_;
  const std::vector<FaceEdge> edges_;  ///< as they were given
  const std::vector<Box> boxes_;       ///< of the edges
  const BoxTree tree_;
  RawVector<uint32_t> place_of_;           ///< per face near contacts: in the lists of these
  std::vector<Box> face_boxes_;            ///< of the faces near contacts
  std::vector<uint32_t> corner_of_;        ///< per point: the face that was marked last
  std::vector<uint32_t> located_in_;       ///< per point: the face in which it was looked for last
  std::vector<uint32_t> next_, previous_;  ///< per corner of that face: along its loop
  std::vector<Ends> rim_;     ///< of that face, sorted; empty if it passes no corner twice
  std::vector<Sides> sides_;  ///< per near face, of the plane of the one that was marked last
  /// Faces of which one has edges, near the other, on both sides of the other's plane.
  std::vector<std::pair<uint32_t, uint32_t>> straddling_;
  std::vector<uint32_t> contacts_;                    ///< points at which edges are to be broken
  std::vector<std::pair<uint32_t, uint32_t>> inner_;  ///< faces, and corners of others within them
  std::vector<std::vector<Lying>> lying_;             ///< per near face
  std::vector<uint32_t> lying_faces_;                 ///< those that have any
  std::optional<PointIndex> index_;
  std::vector<uint32_t> on_line_;
  std::vector<DirectedEdge> found_;
};

}  // namespace

void conform_contacts(std::vector<MergedFace>& faces, std::span<const uint32_t> near,
                      CellGeometry& geometry, const PlaneTable& planes) {
  Conformer(faces, near, geometry, planes).run();
}

}  // namespace csgrun

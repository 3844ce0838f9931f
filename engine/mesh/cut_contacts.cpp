#include "engine/mesh/cut_contacts.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "engine/mesh/box_tree.h"
#include "engine/mesh/face_location.h"
#include "engine/mesh/nest_loops.h"
#include "engine/mesh/self_contact.h"

namespace csgrun {
namespace {

/// An edge of some face, by its lower and higher point.
struct FaceEdge {
  uint32_t lo, hi;
  uint32_t face;
  uint32_t plane;
  bool forward;  ///< runs from lo to hi
};

/// Edges, to be found by where they are. Rounding keeps the order along an axis: what lies on an
/// edge, or meets it, is in its box or meets that.
class EdgesInSpace {
 public:
  EdgesInSpace(const std::vector<DirectedEdge>& edges, const CellGeometry& geometry)
      : geometry_(geometry) {
    boxes_.reserve(edges.size());
    for (const DirectedEdge& e : edges) boxes_.push_back(box(e.from, e.to));
    if (!boxes_.empty()) tree_.emplace(boxes_);
  }

  /// That around two points, and that of an edge.
  [[nodiscard]] Box box(uint32_t p, uint32_t q) const {
    const auto &a = geometry_.point(p).rounded, &b = geometry_.point(q).rounded;
    Box box{};
    for (size_t k = 0; k < 3; ++k) std::tie(box.lo[k], box.hi[k]) = std::minmax(a[k], b[k]);
    return box;
  }
  [[nodiscard]] const Box& box(uint32_t edge) const { return boxes_[edge]; }

  /// Calls visit(edge) for those whose boxes meet another one.
  template <class Visit>
  void each_near(const Box& near, Visit&& visit) const {
    if (tree_) tree_->visit_all(near, visit);
  }

 private:
  const CellGeometry& geometry_;
  std::vector<Box> boxes_;
  std::optional<BoxTree> tree_;
};

class ContactCutter {
 public:
  ContactCutter(std::vector<MergedFace>& faces, std::span<const uint32_t> near,
                CellGeometry& geometry, const PlaneTable& planes)
      : faces_(faces), near_(near), geometry_(geometry), view_(geometry), planes_(planes) {
    index_edges();
    first_corner_.assign(geometry_.point_count(), kNone);
  }

  bool run() {
    bool any = false;
    for (const uint32_t f : near_) {
      if (!faces_[f].untouched && find_contacts(f)) any |= cut(f);
    }
    if (any) sort_faces(faces_, planes_);
    return any;
  }

 private:
  using Edge = std::pair<uint32_t, uint32_t>;

  /// Per point, the edges of touched faces that start or end there.
  void index_edges() {
    std::vector<uint32_t> count(geometry_.point_count() + 1, 0);
    const auto each = [&](auto&& visit) {
      for (const uint32_t f : near_) {
        if (faces_[f].untouched) continue;
        for (const auto& loop : faces_[f].loops) {
          for (const DirectedEdge& e : loop) {
            visit(FaceEdge{std::min(e.from, e.to), std::max(e.from, e.to), f, e.plane,
                           e.from < e.to});
          }
        }
      }
    };
    each([&](const FaceEdge& e) { ++count[e.lo], ++count[e.hi]; });
    starts_.assign(count.size() + 1, 0);
    for (size_t p = 0; p < count.size(); ++p) starts_[p + 1] = starts_[p] + count[p];
    edges_.resize(starts_.back());
    std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
    each([&](const FaceEdge& e) { edges_[next[e.lo]++] = e, edges_[next[e.hi]++] = e; });
  }

  /// Whether some edge leaves the rim within the face's plane: hardly ever.
  [[nodiscard]] bool may_have_contacts(uint32_t f) {
    const uint32_t support = faces_[f].plane.index();
    for (const auto& loop : faces_[f].loops) {
      for (size_t k = 0; k < loop.size(); ++k) {
        const uint32_t p = loop[k].from, before = loop[k > 0 ? k - 1 : loop.size() - 1].from;
        for (uint32_t i = starts_[p]; i < starts_[p + 1]; ++i) {
          const uint32_t q = edges_[i].lo == p ? edges_[i].hi : edges_[i].lo;
          if (edges_[i].face != f && q != loop[k].to && q != before &&
              geometry_.side(support, q) == 0) {
            return true;
          }
        }
      }
    }
    return false;
  }

  /// Collects the edges in the plane of face f that lie inside it and are touched by faces behind
  /// it, from the rim inwards. False when there is no way from rim to rim.
  bool find_contacts(uint32_t f) {
    if (!may_have_contacts(f)) return false;
    const PlaneId support = faces_[f].plane;
    rim_edges_.clear();
    rim_.clear();
    contacts_.clear();
    std::set<Edge> known;
    std::vector<uint32_t> frontier;
    for (const uint32_t p : marked_) first_corner_[p] = kNone;
    marked_.clear();
    corners_.clear();
    for (const auto& loop : faces_[f].loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const DirectedEdge& e = loop[i];
        rim_edges_.push_back(e);
        known.insert(std::minmax(e.from, e.to));
        if (rim_.insert(e.from).second) frontier.push_back(e.from);
        corners_.push_back({loop[i > 0 ? i - 1 : loop.size() - 1], e, first_corner_[e.from]});
        first_corner_[e.from] = static_cast<uint32_t>(corners_.size() - 1);
        marked_.push_back(e.from);
      }
    }
    const EdgesInSpace rim(rim_edges_, geometry_);
    std::set<uint32_t> reached = rim_;
    while (!frontier.empty()) {
      const uint32_t p = frontier.back();
      frontier.pop_back();
      for (uint32_t i = starts_[p]; i < starts_[p + 1]; ++i) {
        const FaceEdge& e = edges_[i];
        const uint32_t q = e.lo == p ? e.hi : e.lo;
        if (e.face == f || geometry_.side(support.index(), q) != 0) continue;
        if (known.count({e.lo, e.hi}) || !behind(support, e)) continue;
        const DirectedEdge line{p, q, e.plane == support.index() ? other_plane(e) : e.plane};
        if (!starts_inside(f, line) || leaves(line, rim)) continue;
        known.insert({e.lo, e.hi});
        contacts_.push_back(line);
        if (!reached.insert(q).second) continue;
        if (on_rim(q, rim)) {
          rim_.insert(q);
        } else {
          frontier.push_back(q);
        }
      }
    }
    drop_crossings();
    // From here on all lines meet in points that they have.
    std::set<uint32_t> points = rim_;
    for (const DirectedEdge& c : contacts_) points.insert({c.from, c.to});
    break_at(points, contacts_);
    break_at(points, rim_edges_);
    drop_dead_ends();
    return !contacts_.empty();
  }

  /// Whether a point lies on a rim edge, between its ends.
  [[nodiscard]] bool on_rim(uint32_t p, const EdgesInSpace& rim) {
    bool found = false;
    rim.each_near(rim.box(p, p),
                  [&](uint32_t e) { found = found || lies_inside(geometry_, rim_edges_[e], p); });
    return found;
  }

  /// Lines that cross where neither has a point (edges of different solids can) part nothing.
  void drop_crossings() {
    std::vector<uint8_t> crossed(contacts_.size(), 0);
    const EdgesInSpace contacts(contacts_, geometry_);
    for (uint32_t i = 0; i < contacts_.size(); ++i) {
      contacts.each_near(contacts.box(i), [&](uint32_t j) {
        if (j > i && cross(contacts_[i], contacts_[j])) crossed[i] = crossed[j] = 1;
      });
    }
    size_t kept = 0;
    for (size_t i = 0; i < contacts_.size(); ++i) {
      if (!crossed[i]) contacts_[kept++] = contacts_[i];
    }
    contacts_.resize(kept);
  }

  void break_at(const std::set<uint32_t>& points, std::vector<DirectedEdge>& edges) {
    std::vector<std::pair<uint32_t, uint32_t>> on_edge;
    const EdgesInSpace in_space(edges, geometry_);
    for (const uint32_t p : points) {
      in_space.each_near(in_space.box(p, p), [&](uint32_t e) {
        if (lies_inside(geometry_, edges[e], p)) on_edge.emplace_back(e, p);
      });
    }
    std::sort(on_edge.begin(), on_edge.end());
    std::vector<DirectedEdge> broken;
    std::vector<uint32_t> inside;
    auto next = on_edge.begin();
    for (uint32_t e = 0; e < edges.size(); ++e) {
      inside.clear();
      for (; next != on_edge.end() && next->first == e; ++next) inside.push_back(next->second);
      append_broken(geometry_, edges[e], inside, broken);
    }
    edges = std::move(broken);
  }

  /// A plane through the edge that is not the support: the edge's own, or that of its face.
  [[nodiscard]] uint32_t other_plane(const FaceEdge& e) const {
    return faces_[e.face].plane.index();
  }

  /// Whether the face of edge e, which lies in the plane `support`, is behind that plane.
  [[nodiscard]] bool behind(PlaneId support, const FaceEdge& e) {
    const MergedFace& g = faces_[e.face];
    if (g.plane.index() == support.index()) return false;
    // g runs to the left of the edge, along n_g x D: behind the support when n_f . (n_g x D) =
    // D . (n_f x n_g) is negative.
    const LineAxis line = line_axis(planes_.oriented(support), planes_.oriented(g.plane));
    const int along = geometry_.compare_along(e.hi, e.lo, line.axis) * line.sign;
    return (e.forward ? along : -along) < 0;
  }

  /// Whether the line, from a point on the rim or inside of face f, goes on inside it.
  [[nodiscard]] bool starts_inside(uint32_t f, const DirectedEdge& line) {
    if (!rim_.count(line.from)) return true;
    FaceLocator locator(faces_[f].plane, view_, planes_);
    for (uint32_t c = first_corner_[line.from]; c != kNone; c = corners_[c].next) {
      if (locator.is_in_wedge(corners_[c].arriving, corners_[c].leaving, line)) return true;
    }
    return false;
  }

  /// Whether two edges cross between their ends.
  [[nodiscard]] bool cross(const DirectedEdge& a, const DirectedEdge& b) {
    const auto apart = [&](uint32_t plane, uint32_t p, uint32_t q) {
      return geometry_.side(plane, p) * geometry_.side(plane, q) < 0;
    };
    return apart(b.plane, a.from, a.to) && apart(a.plane, b.from, b.to);
  }

  /// Whether the line crosses the rim between its ends. What starts inside and does not cross the
  /// rim ends inside or on it.
  [[nodiscard]] bool leaves(const DirectedEdge& line, const EdgesInSpace& rim) {
    bool found = false;
    rim.each_near(rim.box(line.from, line.to),
                  [&](uint32_t e) { found = found || cross(rim_edges_[e], line); });
    return found;
  }

  void drop_dead_ends() {
    for (bool again = true; again;) {
      std::map<uint32_t, int> degree;
      for (const DirectedEdge& c : contacts_) ++degree[c.from], ++degree[c.to];
      const auto dead = [&](uint32_t p) { return degree[p] == 1 && !rim_.count(p); };
      again = std::erase_if(contacts_,
                            [&](const DirectedEdge& c) { return dead(c.from) || dead(c.to); }) > 0;
    }
  }

  bool cut(uint32_t f) {
    std::vector<DirectedEdge> edges = rim_edges_;
    for (const DirectedEdge& c : contacts_) {
      edges.push_back(c);
      edges.push_back({c.to, c.from, c.plane});
    }
    RegionBuilder builder(geometry_, planes_);
    RegionLoops loops;
    if (!builder.build_single(faces_[f].plane, edges, loops)) return false;
    auto parts = nest_loops(faces_[f].plane, loops, view_, planes_);
    for (size_t i = 1; i < parts.size(); ++i) {
      const MergedFace& whole = faces_[f];
      faces_.push_back(
          {whole.plane, whole.appearance, whole.surface, whole.source, whole.untouched,
           FaceLoops(parts[i]),
           whole.contacts ? std::make_unique<InnerContacts>(*whole.contacts) : nullptr});
    }
    faces_[f].loops = FaceLoops(parts[0]);
    return true;
  }

  std::vector<MergedFace>& faces_;
  std::span<const uint32_t> near_;
  CellGeometry& geometry_;
  PointView view_;
  const PlaneTable& planes_;
  std::vector<uint32_t> starts_;
  std::vector<FaceEdge> edges_;
  std::vector<DirectedEdge> rim_edges_, contacts_;
  /// Of the face that is looked at; several at one point are linked.
  struct Corner {
    DirectedEdge arriving, leaving;
    uint32_t next;
  };
  std::vector<Corner> corners_;
  std::vector<uint32_t> first_corner_, marked_;  ///< per point; those that have one
  std::set<uint32_t> rim_;  ///< points of the rim, also where a contact ends on it
};

}  // namespace

bool cut_at_contacts(std::vector<MergedFace>& faces, std::span<const uint32_t> near,
                     CellGeometry& geometry, const PlaneTable& planes) {
  return ContactCutter(faces, near, geometry, planes).run();
}

}  // namespace csgrun

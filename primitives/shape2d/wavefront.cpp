#include "primitives/shape2d/wavefront.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

#include "primitives/base/none.h"

namespace csgrun {
namespace {

/// Places nearer than this are one, events within this time happen at once; in steps. Coordinates
/// below 2^30 are known to about 2^-20.
constexpr double kSamePlace = 0x1p-6, kSameTime = 0x1p-10;
constexpr double kNever = std::numeric_limits<double>::infinity();
/// A line of the outline, which moves to its left.
struct Line {
  Point2D direction;
  glm::dvec2 start, along, normal;  ///< the last two of length 1
};

/// A corner of the wavefront, from its birth on.
struct Corner {
  uint32_t in, out;  ///< the lines of the edges that end and start here
  uint32_t node;     ///< where it was born
  double birth;
  glm::dvec2 at, velocity;
  bool reflex;  ///< or straight
  bool alive = true;
  uint32_t prev = kNone, next = kNone;
  double shrinks_at = kNever;  ///< when the edge to `next` has no length left
  // Of reflex corners: the first edge that it will reach, by that edge's ends.
  double hits_at = kNever;
  uint32_t hit_from = kNone, hit_to = kNone;
};

/// A piece of an edge at the time of an event, between places.
struct Piece {
  uint32_t line, from, to;
  bool cancelled = false;
};

/// Where corners are at the time of an event: one corner that goes on, or what is decided anew.
struct Place {
  glm::dvec2 at;
  uint32_t goes_on = kNone;  ///< a corner; else there is a node
  uint32_t node = kNone;
  std::vector<uint32_t> corners;
};

class Wavefront {
 public:
  Wavefront(const RoofOutline& outline, const std::vector<glm::dvec2>& corners)
      : outline_(outline) {
    for (const glm::dvec2& p : corners) skeleton_.nodes.push_back({p, 0});
    for (uint32_t e = 0; e < outline.edge_count(); ++e) {
      const uint32_t from = outline.from[e], to = outline.to[e];
      const glm::dvec2 d = corners[to] - corners[from];
      const glm::dvec2 along = d / std::sqrt(glm::dot(d, d));
      lines_.push_back({outline.way(e), corners[from], along, {-along.y, along.x}});
    }
  }

  std::optional<Skeleton> run() {
    const auto count = static_cast<uint32_t>(outline_.edge_count());
    // Corner e stands where edge e ends.
    std::vector<uint32_t> all;
    for (uint32_t e = 0; e < count; ++e) {
      skeleton_.borders.push_back({e, outline_.from[e], outline_.to[e]});
      all.push_back(make_corner(e, outline_.next[e], outline_.to[e]));
    }
    for (uint32_t e = 0; e < count; ++e) link(e, outline_.next[e]);
    for (const uint32_t c : all) time_edge(c);
    for (const uint32_t c : all) find_hit(c);
    // An event ends an edge or cuts one; each reflex corner cuts once.
    for (size_t events = 0; events < 4 * size_t{count} + 16; ++events) {
      const double next = next_event();
      if (next == kNever)
        return alive_count_ == 0 ? std::optional(std::move(skeleton_)) : std::nullopt;
      now_ = std::max(now_, next);
      if (!pass_event()) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] glm::dvec2 place_at(const Corner& c, double time) const {
    return c.at + (time - c.birth) * c.velocity;
  }

  uint32_t make_corner(uint32_t in, uint32_t out, uint32_t node) {
    const Line &a = lines_[in], &b = lines_[out];
    const int128 turn = cross(a.direction, b.direction);
    const double cosine = glm::dot(a.along, b.along);
    Corner c{};
    c.in = in;
    c.out = out;
    c.node = node;
    c.birth = skeleton_.nodes[node].time;
    c.at = skeleton_.nodes[node].at;
    if (cosine > 0) {
      c.velocity = (a.normal + b.normal) / (1 + cosine);
    } else {
      // Near a spike the sum of the normals is noise, their difference is not.
      double sine = a.along.x * b.along.y - a.along.y * b.along.x;
      if (sine == 0 || (sine > 0) != (turn > 0)) {
        sine = static_cast<double>(turn) /
               std::sqrt(static_cast<double>(dot(a.direction, a.direction)) *
                         static_cast<double>(dot(b.direction, b.direction)));
      }
      c.velocity = glm::dvec2(b.normal.y - a.normal.y, a.normal.x - b.normal.x) / sine;
    }
    c.reflex = turn <= 0;  // straight ones stand on a ridge of parallel walls too
    corners_.push_back(c);
    ++alive_count_;
    return static_cast<uint32_t>(corners_.size() - 1);
  }

  void link(uint32_t from, uint32_t to) {
    corners_[from].next = to;
    corners_[to].prev = from;
  }

  /// When the edge that starts at a corner will have shrunk.
  void time_edge(uint32_t from) {
    Corner& u = corners_[from];
    const Corner& w = corners_[u.next];
    const glm::dvec2& along = lines_[u.out].along;
    const double length = glm::dot(place_at(w, now_) - place_at(u, now_), along);
    const double rate = glm::dot(w.velocity - u.velocity, along);
    u.shrinks_at = rate < 0 ? now_ + std::max(length, 0.0) / -rate : kNever;
  }

  /// Whether reflex corner v reaches the edge from u, and then when; else kNever.
  [[nodiscard]] double time_of_hit(const Corner& v, uint32_t from) const {
    const Corner& u = corners_[from];
    const Corner& w = corners_[u.next];
    if (u.out == v.in || u.out == v.out) return kNever;
    // Corners of one birth part for good.
    if ((u.node == v.node && u.birth == v.birth) || (w.node == v.node && w.birth == v.birth))
      return kNever;
    const Line& line = lines_[u.out];
    const double ahead = glm::dot(place_at(v, now_) - line.start, line.normal) - now_;
    const double rate = glm::dot(v.velocity, line.normal) - 1;
    if (!(rate < 0) || ahead < -kSamePlace) return kNever;
    const double time = now_ + std::max(ahead, 0.0) / -rate;
    const glm::dvec2 hit = place_at(v, time);
    const double after = glm::dot(hit - place_at(u, time), line.along);
    const double before = glm::dot(place_at(w, time) - hit, line.along);
    return after > -kSamePlace && before > -kSamePlace ? time : kNever;
  }

  void try_hit(uint32_t corner, uint32_t from) {
    Corner& v = corners_[corner];
    const double time = time_of_hit(v, from);
    if (time >= v.hits_at) return;
    v.hits_at = time;
    v.hit_from = from;
    v.hit_to = corners_[from].next;
  }

  void find_hit(uint32_t corner) {
    Corner& v = corners_[corner];
    v.hits_at = kNever;
    if (!v.reflex) return;
    for (uint32_t u = 0; u < corners_.size(); ++u) {
      if (corners_[u].alive) try_hit(corner, u);
    }
  }

  [[nodiscard]] double next_event() const {
    double next = kNever;
    for (const Corner& c : corners_) {
      if (c.alive) next = std::min({next, c.shrinks_at, c.hits_at});
    }
    return next;
  }

  uint32_t place_of(uint32_t corner) {
    const auto found = place_of_corner_.find(corner);
    if (found != place_of_corner_.end()) {
      uint32_t p = found->second;
      while (merged_[p] != p) p = merged_[p];
      return p;
    }
    const auto p = static_cast<uint32_t>(places_.size());
    places_.push_back({place_at(corners_[corner], now_), corner, kNone, {corner}});
    merged_.push_back(p);
    place_of_corner_[corner] = p;
    return p;
  }

  /// The place of a corner at which something happens.
  uint32_t event_at(uint32_t corner) {
    const uint32_t p = place_of(corner);
    places_[p].goes_on = kNone;
    return p;
  }

  void meet(uint32_t a, uint32_t b) {
    const uint32_t p = event_at(a), q = event_at(b);
    if (p == q) return;
    // The slower one is known better.
    const auto speed = [&](uint32_t place) {
      const glm::dvec2& v = corners_[places_[place].corners[0]].velocity;
      return glm::dot(v, v);
    };
    const uint32_t keep = speed(p) <= speed(q) ? p : q, drop = keep == p ? q : p;
    auto& corners = places_[keep].corners;
    corners.insert(corners.end(), places_[drop].corners.begin(), places_[drop].corners.end());
    places_[drop].corners.clear();
    merged_[drop] = keep;
  }

  /// A reflex corner is at the edge that starts at another.
  void hit(uint32_t corner, uint32_t from) {
    const Corner &v = corners_[corner], &u = corners_[from];
    const glm::dvec2 at = place_at(v, now_);
    const glm::dvec2& along = lines_[u.out].along;
    if (glm::dot(at - place_at(u, now_), along) < kSamePlace) {
      meet(corner, from);
    } else if (glm::dot(place_at(corners_[u.next], now_) - at, along) < kSamePlace) {
      meet(corner, u.next);
    } else {
      event_at(corner);
      cuts_[from].push_back(corner);
    }
  }

  void collect_events() {
    places_.clear();
    merged_.clear();
    place_of_corner_.clear();
    cuts_.clear();
    const auto count = static_cast<uint32_t>(corners_.size());
    for (uint32_t c = 0; c < count; ++c) {
      if (corners_[c].alive && corners_[c].shrinks_at <= now_ + kSameTime)
        meet(c, corners_[c].next);
    }
    for (uint32_t c = 0; c < count; ++c) {
      if (!corners_[c].alive || corners_[c].hits_at > now_ + kSameTime) continue;
      // It may reach several edges at once.
      for (uint32_t from = 0; from < count; ++from) {
        if (corners_[from].alive && time_of_hit(corners_[c], from) <= now_ + kSameTime)
          hit(c, from);
      }
    }
    // What met by chance.
    std::vector<uint32_t> touched;
    for (const auto& [corner, place] : place_of_corner_) touched.push_back(corner);
    for (size_t i = 0; i < touched.size(); ++i) {
      for (size_t j = 0; j < i; ++j) {
        const glm::dvec2 r = places_[place_of(touched[i])].at - places_[place_of(touched[j])].at;
        if (glm::dot(r, r) < kSamePlace * kSamePlace) meet(touched[j], touched[i]);
      }
    }
  }

  /// The pieces of all edges that something happened to.
  std::vector<Piece> cut_edges() {
    std::vector<uint32_t> starts;
    for (const auto& [corner, place] : place_of_corner_) {
      starts.push_back(corner);
      starts.push_back(corners_[corner].prev);
    }
    for (const auto& [from, cuts] : cuts_) starts.push_back(from);
    std::sort(starts.begin(), starts.end());
    starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
    std::vector<Piece> pieces;
    for (const uint32_t u : starts) {
      const uint32_t line = corners_[u].out;
      std::vector<uint32_t> way{place_of(u)};
      const auto cuts = cuts_.find(u);
      if (cuts != cuts_.end()) {
        std::vector<std::pair<double, uint32_t>> sorted;
        for (const uint32_t c : cuts->second) {
          const uint32_t p = place_of(c);
          sorted.emplace_back(glm::dot(places_[p].at, lines_[line].along), p);
        }
        std::sort(sorted.begin(), sorted.end());
        for (const auto& [at, p] : sorted) way.push_back(p);
      }
      way.push_back(place_of(corners_[u].next));
      for (size_t i = 1; i < way.size(); ++i) {
        if (way[i - 1] != way[i]) pieces.push_back({line, way[i - 1], way[i]});
      }
    }
    return pieces;
  }

  /// Pieces that lie on each other are a ridge, whose ends are nodes.
  void cancel_opposite(std::vector<Piece>& pieces) {
    std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> open;
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      const auto back = open.find({pieces[i].to, pieces[i].from});
      if (back == open.end() || back->second.empty()) {
        open[{pieces[i].from, pieces[i].to}].push_back(i);
        continue;
      }
      pieces[i].cancelled = pieces[back->second.back()].cancelled = true;
      places_[pieces[i].from].goes_on = places_[pieces[i].to].goes_on = kNone;
      back->second.pop_back();
    }
  }

  bool pass_event() {
    collect_events();
    std::vector<Piece> pieces = cut_edges();
    cancel_opposite(pieces);
    for (Place& place : places_) {
      if (place.goes_on != kNone || place.corners.empty()) continue;
      place.node = static_cast<uint32_t>(skeleton_.nodes.size());
      skeleton_.nodes.push_back({place.at, now_});
      for (const uint32_t c : place.corners) {
        Corner& corner = corners_[c];
        corner.alive = false;
        --alive_count_;
        skeleton_.borders.push_back({corner.in, corner.node, place.node});
        skeleton_.borders.push_back({corner.out, place.node, corner.node});
      }
    }
    // Per place: the pieces that come and go.
    std::vector<std::vector<uint32_t>> ins(places_.size()), outs(places_.size());
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      const Piece& piece = pieces[i];
      if (piece.cancelled) {
        skeleton_.borders.push_back({piece.line, places_[piece.to].node, places_[piece.from].node});
        continue;
      }
      ins[piece.to].push_back(i);
      outs[piece.from].push_back(i);
    }
    std::vector<uint32_t> start(pieces.size(), kNone), end(pieces.size(), kNone), born;
    for (uint32_t p = 0; p < places_.size(); ++p) {
      if (ins[p].empty() && outs[p].empty()) continue;
      if (places_[p].goes_on != kNone) {
        for (const uint32_t i : ins[p]) end[i] = places_[p].goes_on;
        for (const uint32_t i : outs[p]) start[i] = places_[p].goes_on;
        continue;
      }
      if (ins[p].size() != outs[p].size()) return false;
      for (const uint32_t i : ins[p]) {
        const Point2D& d = lines_[pieces[i].line].direction;
        const Point2D back = -d;
        uint32_t best = kNone;
        for (const uint32_t o : outs[p]) {
          if (best == kNone || clockwise_before(back, lines_[pieces[o].line].direction,
                                                lines_[pieces[best].line].direction))
            best = o;
        }
        if (start[best] != kNone) return false;
        const int128 turn = cross(d, lines_[pieces[best].line].direction);
        if (turn == 0 && dot(d, lines_[pieces[best].line].direction) < 0) return false;
        start[best] = end[i] = make_corner(pieces[i].line, pieces[best].line, places_[p].node);
        born.push_back(end[i]);
      }
    }
    std::vector<uint32_t> changed;
    for (uint32_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].cancelled) continue;
      if (start[i] == kNone || end[i] == kNone) return false;
      link(start[i], end[i]);
      changed.push_back(start[i]);
    }
    for (const uint32_t c : changed) time_edge(c);
    for (const uint32_t c : born) find_hit(c);
    for (uint32_t c = 0; c < corners_.size(); ++c) {
      const Corner& v = corners_[c];
      if (!v.alive || !v.reflex) continue;
      const bool lost = v.hits_at != kNever &&
                        (!corners_[v.hit_from].alive || corners_[v.hit_from].next != v.hit_to);
      if (lost) {
        find_hit(c);
      } else {
        for (const uint32_t u : changed) try_hit(c, u);
      }
    }
    return true;
  }

  const RoofOutline& outline_;
  std::vector<Line> lines_;
  std::vector<Corner> corners_;
  Skeleton skeleton_;
  double now_ = 0;
  size_t alive_count_ = 0;
  // Of the event that is passed.
  std::vector<Place> places_;
  std::vector<uint32_t> merged_;  ///< per place: itself, or one that it was merged into
  std::map<uint32_t, uint32_t> place_of_corner_;
  std::map<uint32_t, std::vector<uint32_t>> cuts_;  ///< by the corner where the edge starts
};

}  // namespace

std::optional<Skeleton> shrink(const RoofOutline& outline, const std::vector<glm::dvec2>& corners) {
  return Wavefront(outline, corners).run();
}

}  // namespace csgrun

// The reference: what is inside just above and just below every point of every plane.
//
// A result can have boundary only in planes of faces of the leaves. Each such plane P is looked at
// from both sides: a leaf's surface meets the plane a hair above P (and a hair below) in closed
// chains of directed segments, which lie on the lines where planes of faces meet P. A point's
// winding number is the sum of the segments below it. So P is swept from left to right: between two
// abscissae where something starts, ends or crosses, the lines have one order, and going up through
// them all winding numbers are known in every trapezoid between two of them. There the expression
// is evaluated on both sides: they differ exactly where the result has boundary. The claimed faces
// of the result in P are chains too; so every point of every plane is compared, but for finitely
// many lines.
//
// Nothing needs to be sound: leaves may cross themselves, touch, coincide, be turned inside out.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tests/support/reference/faults.h"
#include "tests/support/reference/numbers.h"
#include "tests/support/reference/solids.h"

namespace csgrun::reference {

/// What a trapezoid is told to: between two lines and two abscissae of a plane there is boundary.
template <class Z>
struct Trapezoid {
  const Plane& plane;
  const Abscissa<Z>&left, &right;
  const Line<Z>&lower, &upper;
  bool up;  ///< outside is above the plane
  uint32_t leaf;
};

template <class Z>
class Sections {
 public:
  using Visitor = std::function<void(const Trapezoid<Z>&)>;

  /// `claim` may be null: then nothing is compared. `visitor` may be empty.
  Sections(const std::vector<Leaf>& leaves, const Tree& tree, const Planes& planes,
           const Claim* claim, Fault fault, Visitor visitor)
      : leaves_(leaves),
        planes_(planes),
        claim_(claim),
        fault_(fault),
        visitor_(std::move(visitor)) {
    for (const Leaf& leaf : leaves) {
      auto& points = points_.emplace_back();
      for (const Point& p : leaf.points) points.push_back(converted(p));
    }
    if (claim) {
      for (const Point& p : claim->points) claim_points_.push_back(converted(p));
    }
    for (const Plane& p : planes.planes) coefficients_.push_back(converted(p.c));
    flatten(tree);
  }

  /// The first difference between the claim and the expression, or an empty text.
  std::string run() {
    for (uint32_t p = 0; p < planes_.planes.size(); ++p) {
      if (std::string text = sweep(p); !text.empty()) return text;
    }
    return "";
  }

 private:
  using Vector = std::array<Z, 4>;
  struct Step {  ///< of the expression, in postfix order: a leaf, or two values made one
    int leaf = -1;
    BooleanOp op = BooleanOp::kUnion;
  };
  struct Event {
    Abscissa<Z> at;
    uint32_t line, chain;
    int change;
  };
  struct Value {
    bool above = false, below = false;
    uint32_t leaf = ~0u;  ///< whose surface the boundary here belongs to
  };

  static Vector converted(const std::array<mpz_class, 4>& v) {
    return {Number<Z>::from(v[0]), Number<Z>::from(v[1]), Number<Z>::from(v[2]),
            Number<Z>::from(v[3])};
  }

  void flatten(const Tree& t) {
    if (t.leaf >= 0) {
      steps_.push_back({t.leaf, {}});
      return;
    }
    for (size_t i = 0; i < t.children.size(); ++i) {
      flatten(t.children[i]);
      if (i > 0) steps_.push_back({-1, t.op});
    }
  }

  // --- One plane: chains of segments on lines.

  std::string sweep(uint32_t p) {
    plane_ = p;
    axis_ = planes_.planes[p].axis;
    u_ = (axis_ + 1) % 3;
    v_ = (axis_ + 2) % 3;
    lines_.clear();
    numbers_.clear();
    line_of_plane_.assign(planes_.planes.size(), kUnknown);
    events_.clear();
    labels_.clear();
    chain_count_ = static_cast<uint32_t>(2 * leaves_.size());
    for (uint32_t l = 0; l < leaves_.size(); ++l) add_leaf(l);
    first_claim_ = chain_count_;
    claimed_.clear();
    if (claim_) {
      for (uint32_t f = 0; f < claim_->faces.size(); ++f) {
        if (planes_.of_claim[f].plane != p) continue;
        add_loops(claim_points_, claim_->faces[f], chain_count_++);
        claimed_.push_back(f);
      }
    }
    return between_events();
  }

  /// The sections of leaf l a hair above and below the plane, and its faces in the plane.
  void add_leaf(uint32_t l) {
    const std::vector<Vector>& points = points_[l];
    const Vector& plane = coefficients_[plane_];
    values_.resize(points.size());
    signs_.resize(points.size());
    for (size_t i = 0; i < points.size(); ++i) {
      const Vector& x = points[i];
      values_[i] = plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2] + plane[3] * x[3];
      signs_[i] = Number<Z>::sign(values_[i]);
    }
    const Leaf& leaf = leaves_[l];
    const size_t face_count =
        leaf.faces.size() - (fault_ == Fault::kLostFace && l + 1 == leaves_.size() ? 1 : 0);
    for (size_t f = 0; f < face_count; ++f) {
      const Face& face = leaf.faces[f];
      if (planes_.of_leaf[l][f].plane == plane_) {
        const auto [at, is_new] = labels_.try_emplace({l, face.label}, chain_count_);
        if (is_new) ++chain_count_;
        add_loops(points, face, at->second);
        continue;
      }
      for (const auto& loop : face.loops) {
        uint32_t a = loop.back();
        for (const uint32_t b : loop) {
          if (signs_[a] != signs_[b]) add_crossings(l, f, a, b);
          a = b;
        }
      }
    }
  }

  /// Seen from above, a leaf's interior is on the left of its sections when a segment runs from
  /// where the face's loop comes down through the plane to where it goes up.
  void add_crossings(uint32_t l, size_t f, uint32_t a, uint32_t b) {
    for (const bool above : {true, false}) {
      const auto is_high = [&](uint32_t i) {
        return above || fault_ == Fault::kOneSide ? signs_[i] > 0 : signs_[i] >= 0;
      };
      if (is_high(a) == is_high(b)) continue;
      const uint32_t line = line_of(planes_.of_leaf[l][f].plane);
      if (line == kNone) continue;
      // The plane's value vanishes at value(a) b - value(b) a.
      const Vector &x = points_[l][a], &y = points_[l][b];
      auto at = Abscissa<Z>::of(Z(values_[a] * y[u_] - values_[b] * x[u_]),
                                Z(values_[a] * y[3] - values_[b] * x[3]));
      const bool goes_up = is_high(b) != (fault_ == Fault::kTurnedOver && l == 0);
      events_.push_back({std::move(at), line, 2 * l + (above ? 0 : 1), goes_up ? -1 : 1});
    }
  }

  /// The edges of a face in the plane.
  void add_loops(const std::vector<Vector>& points, const Face& face, uint32_t chain) {
    for (const auto& loop : face.loops) {
      uint32_t a = loop.back();
      for (const uint32_t b : loop) {
        const Vector &x = points[a], &y = points[b];
        a = b;
        Line<Z> line;
        if (!Line<Z>::make(Z(x[v_] * y[3] - x[3] * y[v_]), Z(x[3] * y[u_] - x[u_] * y[3]),
                           Z(x[u_] * y[v_] - x[v_] * y[u_]), line)) {
          continue;
        }
        const uint32_t number = number_of(std::move(line));
        events_.push_back({Abscissa<Z>::of(x[u_], x[3]), number, chain, 1});
        events_.push_back({Abscissa<Z>::of(y[u_], y[3]), number, chain, -1});
      }
    }
  }

  uint32_t line_of(uint32_t other) {
    uint32_t& line = line_of_plane_[other];
    if (line != kUnknown) return line;
    const Vector &p = coefficients_[plane_], &q = coefficients_[other];
    const auto minor = [&](int k) -> Z { return p[axis_] * q[k] - q[axis_] * p[k]; };
    Line<Z> made;
    if (!Line<Z>::make(minor(u_), minor(v_), minor(3), made)) return line = kNone;
    return line = number_of(std::move(made));
  }

  uint32_t number_of(Line<Z> line) {
    const auto [at, is_new] =
        numbers_.try_emplace(std::move(line), static_cast<uint32_t>(lines_.size()));
    if (is_new) lines_.push_back(at->first);
    return at->second;
  }

  // --- The sweep.

  std::string between_events() {
    order_.resize(events_.size());
    for (uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
    std::sort(order_.begin(), order_.end(),
              [&](uint32_t i, uint32_t j) { return events_[i].at.compare(events_[j].at) < 0; });
    counts_.assign(lines_.size(), {});
    winding_.assign(chain_count_, 0);
    for (size_t i = 0; i < order_.size();) {
      const Abscissa<Z>& left = events_[order_[i]].at;
      for (; i < order_.size() && events_[order_[i]].at.compare(left) == 0; ++i) {
        apply(events_[order_[i]]);
      }
      active_.clear();
      for (uint32_t l = 0; l < lines_.size(); ++l) {
        if (!counts_[l].empty()) active_.push_back(l);
      }
      if (active_.empty()) continue;
      if (i == order_.size()) return "a surface is not closed" + where(left);
      if (std::string text = between(left, events_[order_[i]].at); !text.empty()) return text;
    }
    return "";
  }

  void apply(const Event& e) {
    auto& counts = counts_[e.line];
    for (auto& [chain, count] : counts) {
      if (chain != e.chain) continue;
      count += e.change;
      if (count == 0) {
        chain = counts.back().first;
        count = counts.back().second;
        counts.pop_back();
      }
      return;
    }
    counts.emplace_back(e.chain, e.change);
  }

  /// From one event to the next, cut where lines cross.
  std::string between(Abscissa<Z> left, const Abscissa<Z>& end) {
    for (;;) {
      std::sort(active_.begin(), active_.end(), [&](uint32_t i, uint32_t j) {
        const int order = lines_[i].compare_at(left, lines_[j]);
        return order != 0 ? order < 0 : lines_[i].compare_slopes(lines_[j]) < 0;
      });
      bool crossed = false;
      for (size_t i = 1; i < active_.size() && !crossed; ++i) {
        crossed = lines_[active_[i - 1]].compare_at(end, lines_[active_[i]]) > 0;
      }
      if (!crossed || fault_ == Fault::kNoCrossings) return upwards(left, end);
      // The first crossing is one of neighbours.
      Abscissa<Z> next = end;
      for (size_t i = 1; i < active_.size(); ++i) {
        const Line<Z>&low = lines_[active_[i - 1]], &high = lines_[active_[i]];
        if (low.compare_at(end, high) <= 0) continue;
        auto at = low.meeting(high);
        if (at.compare(next) < 0) next = std::move(at);
      }
      if (std::string text = upwards(left, next); !text.empty()) return text;
      left = std::move(next);
    }
  }

  /// Through all lines from below to above, in one slab.
  std::string upwards(const Abscissa<Z>& left, const Abscissa<Z>& right) {
    for (size_t i = 0; i < active_.size(); ++i) {
      for (const auto& [chain, count] : counts_[active_[i]]) winding_[chain] += count;
      if (i + 1 == active_.size()) break;
      if (std::string text = look(left, right, lines_[active_[i]], lines_[active_[i + 1]]);
          !text.empty()) {
        return text;
      }
    }
    if (std::any_of(winding_.begin(), winding_.end(), [](int w) { return w != 0; })) {
      return "a surface is not closed" + where(left);
    }
    return "";
  }

  // --- One trapezoid.

  [[nodiscard]] bool inside(uint32_t l, int winding) const {
    FillRule rule = leaves_[l].rule;
    if (fault_ == Fault::kOtherRule) {
      rule = rule == FillRule::kNonZero ? FillRule::kEvenOdd : FillRule::kNonZero;
    }
    switch (rule) {
      case FillRule::kNonZero:
        return winding != 0;
      case FillRule::kPositive:
        return winding > 0;
      default:
        return winding % 2 != 0;
    }
  }

  Value evaluate() {
    stack_.clear();
    for (const Step& s : steps_) {
      if (s.leaf >= 0) {
        const auto l = static_cast<uint32_t>(s.leaf);
        Value v{inside(l, winding_[2 * l]), inside(l, winding_[2 * l + 1]), l};
        stack_.push_back(v);
        continue;
      }
      const Value b = stack_.back();
      stack_.pop_back();
      Value& a = stack_.back();
      // The lower operand's surface counts where it has any.
      if (a.above == a.below || (fault_ == Fault::kUpperLabel && b.above != b.below)) {
        a.leaf = b.leaf;
      }
      combine(s.op, a.above, b.above);
      combine(s.op, a.below, b.below);
    }
    return stack_.back();
  }

  void combine(BooleanOp op, bool& a, bool b) const {
    switch (op) {
      case BooleanOp::kUnion:
        a = fault_ == Fault::kUnionAsXor ? a != b : a || b;
        break;
      case BooleanOp::kIntersection:
        a = a && b;
        break;
      case BooleanOp::kDifference:
        a = fault_ == Fault::kDifferenceTurned ? b && !a : a && !b;
        break;
      case BooleanOp::kSymmetricDifference:
        a = fault_ == Fault::kXorAsUnion ? a || b : a != b;
        break;
    }
  }

  std::string look(const Abscissa<Z>& left, const Abscissa<Z>& right, const Line<Z>& lower,
                   const Line<Z>& upper) {
    const Value v = evaluate();
    const bool boundary = v.above != v.below;
    if (visitor_ && boundary) {
      visitor_({planes_.planes[plane_], left, right, lower, upper, v.below, v.leaf});
    }
    if (!claim_) return "";
    // Winding numbers of faces that look down are -1 seen from above.
    const int expected = v.below ? 1 : -1;
    uint32_t found = kNone;
    for (uint32_t c = 0; c < claimed_.size(); ++c) {
      const int w = winding_[first_claim_ + c];
      if (w == 0) continue;
      const std::string at = where(left) + ", face " + std::to_string(claimed_[c]);
      if (!boundary) return "a face where there is no boundary" + at;
      if (found != kNone) return "two faces in one place" + at;
      if (w != expected) return "a face that is turned over or wound twice" + at;
      found = claimed_[c];
    }
    if (!boundary) return "";
    if (found == kNone) return "a face is missing" + where(left);
    const Label& label = claim_->faces[found].label;
    if (!has_label(v.leaf, label)) {
      return "a face from leaf " + std::to_string(label[0]) + ", facet " +
             std::to_string(label[1]) + " instead of leaf " + std::to_string(v.leaf) + where(left);
    }
    return "";
  }

  /// Whether leaf l has a face with this label here.
  [[nodiscard]] bool has_label(uint32_t l, const Label& label) const {
    const auto& sources = leaves_[l].sources;
    if (!sources.empty()) {
      return std::find(sources.begin(), sources.end(), label[0]) != sources.end();
    }
    const auto at = labels_.find({l, label});
    return at != labels_.end() && winding_[at->second] != 0;
  }

  [[nodiscard]] std::string where(const Abscissa<Z>& left) const {
    std::string text = ", plane";
    for (const auto& c : planes_.planes[plane_].c) text += " " + c.get_str();
    return text + ", right of " + std::to_string(left.near);
  }

  static constexpr uint32_t kNone = ~0u, kUnknown = ~0u - 1;

  const std::vector<Leaf>& leaves_;
  const Planes& planes_;
  const Claim* claim_;
  Fault fault_;
  Visitor visitor_;
  std::vector<std::vector<Vector>> points_;
  std::vector<Vector> claim_points_, coefficients_;
  std::vector<Step> steps_;
  // Of the plane that is looked at:
  uint32_t plane_ = 0;
  int axis_ = 0, u_ = 1, v_ = 2;
  std::vector<Z> values_;
  std::vector<int> signs_;
  std::vector<Line<Z>> lines_;
  std::map<Line<Z>, uint32_t> numbers_;
  std::vector<uint32_t> line_of_plane_;
  std::vector<Event> events_;
  std::map<std::pair<uint32_t, Label>, uint32_t> labels_;
  uint32_t chain_count_ = 0, first_claim_ = 0;
  std::vector<uint32_t> claimed_;
  std::vector<uint32_t> order_, active_;
  std::vector<std::vector<std::pair<uint32_t, int>>> counts_;  ///< by line: chain, multiplicity
  std::vector<int> winding_;
  std::vector<Value> stack_;
};

}  // namespace csgrun::reference

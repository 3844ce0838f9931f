#include "tests/support/reference/cells.h"

#include <algorithm>
#include <array>
#include <map>

#include "tests/support/reference/numbers.h"
#include "tests/support/reference/reference.h"

namespace csgrun::reference {

namespace {

template <class Z>
class Cells {
 public:
  /// Few planes only: there are about n^3 / 6 cells.
  Cells(const std::vector<Leaf>& leaves, const Tree& tree, const Planes& planes, Fault fault)
      : leaves_(leaves), tree_(tree), given_(planes), fault_(fault) {
    for (const Plane& p : planes.planes) add_plane(p);
    add_planes_of_flat_edges();
    cells_.push_back(everything());
    for (uint32_t p = 0; p < planes_.size(); ++p) cut(p);
    for (uint32_t c = 0; c < cells_.size(); ++c) numbers_.emplace(cells_[c].sides, c);
  }

  [[nodiscard]] size_t count() const { return cells_.size(); }

  /// All that cannot be reached, as a sound leaf; or nothing when windings contradict each other.
  std::optional<Leaf> unreached(Reach reach) {
    if (!find_windings()) return std::nullopt;
    std::vector<uint8_t> reached(cells_.size(), 0);
    const uint32_t start = outermost();
    std::vector<uint32_t> open{start};
    reached[start] = 1;
    while (!open.empty()) {
      const uint32_t from = open.back();
      open.pop_back();
      for (const Door& door : doors_[from]) {
        if (reached[door.to] || !passes(reach, from, door)) continue;
        reached[door.to] = 1;
        open.push_back(door.to);
      }
    }
    Leaf result;
    for (uint32_t c = 0; c < cells_.size(); ++c) {
      if (reached[c]) continue;
      for (const Door& door : doors_[c]) {
        if (!reached[door.to]) continue;
        Face& face = result.faces.emplace_back();
        face.loops.emplace_back();
        for (const uint32_t v : cells_[c].facets[door.facet].loop) {
          face.loops[0].push_back(static_cast<uint32_t>(result.points.size()));
          Point& p = result.points.emplace_back();
          for (int k = 0; k < 4; ++k) p[k] = Number<Z>::to_gmp(cells_[c].points[v][k]);
        }
      }
    }
    return result;
  }

 private:
  using Vector = std::array<Z, 4>;
  struct Facet {
    uint32_t plane;  ///< kBox: of the box around everything
    std::vector<uint32_t> loop;
  };
  struct Cell {
    std::vector<Vector> points;
    std::vector<Facet> facets;  ///< counter-clockwise from outside the cell
    std::vector<bool> sides;    ///< by plane: above
  };
  struct Door {  ///< through a facet of a cell to the next one
    uint32_t to, facet;
    bool up;  ///< the next cell is above the plane
    bool has_up, has_down;
    std::vector<int> net;  ///< by leaf: faces that look up less those that look down
  };
  static constexpr uint32_t kBox = ~0u;

  void add_plane(const Plane& p) {
    if (!known_.insert({p.c, planes_.size()}).second) return;
    planes_.push_back({Number<Z>::from(p.c[0]), Number<Z>::from(p.c[1]), Number<Z>::from(p.c[2]),
                       Number<Z>::from(p.c[3])});
  }

  /// An edge between faces of one plane is in no other plane: cut it by one that is drawn as a
  /// line.
  void add_planes_of_flat_edges() {
    for (size_t l = 0; l < leaves_.size(); ++l) {
      const Leaf& leaf = leaves_[l];
      for (size_t f = 0; f < leaf.faces.size(); ++f) {
        const Plane& plane = given_.planes[given_.of_leaf[l][f].plane];
        for (const auto& loop : leaf.faces[f].loops) {
          for (size_t i = 0; i < loop.size(); ++i) {
            const Point &a = leaf.points[loop[i]], &b = leaf.points[loop[(i + 1) % loop.size()]];
            bool is_cut = false;
            for (const Plane& q : given_.planes) {
              is_cut |= &q != &plane && value(q, a) == 0 && value(q, b) == 0;
            }
            if (is_cut) continue;
            const int u = (plane.axis + 1) % 3, v = (plane.axis + 2) % 3;
            Plane wall;
            wall.c[plane.axis] = 0;
            wall.c[u] = a[v] * b[3] - a[3] * b[v];
            wall.c[v] = a[3] * b[u] - a[u] * b[3];
            wall.c[3] = a[u] * b[v] - a[v] * b[u];
            mpz_class divisor = 0;
            for (const auto& x : wall.c) divisor = gcd(divisor, x);
            if (wall.c[u] != 0 ? wall.c[u] < 0 : wall.c[v] < 0) divisor = -divisor;
            for (auto& x : wall.c) x /= divisor;
            add_plane(wall);
          }
        }
      }
    }
  }

  static mpz_class value(const Plane& q, const Point& p) {
    return q.c[0] * p[0] + q.c[1] * p[1] + q.c[2] * p[2] + q.c[3] * p[3];
  }

  /// A cube that holds all corners, and so all that is not outside.
  [[nodiscard]] Cell everything() const {
    mpz_class reach = 1;
    for (const Leaf& leaf : leaves_) {
      for (const Point& p : leaf.points) {
        for (int k = 0; k < 3; ++k) {
          const mpz_class r = abs(p[k]) / p[3] + 2;
          if (r > reach) reach = r;
        }
      }
    }
    const Z r = Number<Z>::from(reach);
    Cell cell;
    for (int i = 0; i < 8; ++i) {
      cell.points.push_back({i & 1 ? r : Z(-r), i & 2 ? r : Z(-r), i & 4 ? r : Z(-r), Z(1)});
    }
    cell.facets = {{kBox, {0, 2, 3, 1}}, {kBox, {4, 5, 7, 6}}, {kBox, {0, 1, 5, 4}},
                   {kBox, {2, 6, 7, 3}}, {kBox, {0, 4, 6, 2}}, {kBox, {1, 3, 7, 5}}};
    return cell;
  }

  void cut(uint32_t p) {
    const size_t before = cells_.size();
    for (size_t c = 0; c < before; ++c) {
      const Vector& plane = planes_[p];
      std::vector<Z> values;
      std::vector<int> signs;
      bool above = false, below = false;
      for (const Vector& x : cells_[c].points) {
        values.push_back(plane[0] * x[0] + plane[1] * x[1] + plane[2] * x[2] + plane[3] * x[3]);
        signs.push_back(Number<Z>::sign(values.back()));
        above |= signs.back() > 0;
        below |= signs.back() < 0;
      }
      if (above && below) {
        Cell high = half(cells_[c], p, values, signs, 1);
        cells_[c] = half(cells_[c], p, values, signs, -1);
        cells_.push_back(std::move(high));
      } else {
        cells_[c].sides.push_back(above);
      }
    }
  }

  /// The part of a cell where side * value is positive.
  static Cell half(const Cell& cell, uint32_t p, const std::vector<Z>& values,
                   const std::vector<int>& signs, int side) {
    Cell part;
    part.sides = cell.sides;
    part.sides.push_back(side > 0);
    std::vector<uint32_t> kept(cell.points.size(), ~0u);
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> cuts;
    const auto keep = [&](uint32_t v) {
      if (kept[v] == ~0u) {
        kept[v] = static_cast<uint32_t>(part.points.size());
        part.points.push_back(cell.points[v]);
      }
      return kept[v];
    };
    const auto between = [&](uint32_t v, uint32_t w) {
      if (v > w) std::swap(v, w);
      const auto [at, is_new] = cuts.try_emplace({v, w}, static_cast<uint32_t>(part.points.size()));
      if (is_new) {
        Vector x;
        for (int k = 0; k < 4; ++k)
          x[k] = values[v] * cell.points[w][k] - values[w] * cell.points[v][k];
        Z divisor = x[3];
        for (int k = 0; k < 3; ++k) divisor = Number<Z>::common_divisor(divisor, x[k]);
        if ((Number<Z>::sign(x[3]) < 0) != (Number<Z>::sign(divisor) < 0)) divisor = -divisor;
        for (Z& t : x) t /= divisor;
        part.points.push_back(std::move(x));
      }
      return at->second;
    };
    std::map<uint32_t, uint32_t> rim;  // from corner to corner, as the new facet runs
    for (const Facet& facet : cell.facets) {
      Facet piece{facet.plane, {}};
      std::vector<bool> on;
      for (size_t i = 0; i < facet.loop.size(); ++i) {
        const uint32_t v = facet.loop[i], w = facet.loop[(i + 1) % facet.loop.size()];
        const int s = side * signs[v], t = side * signs[w];
        if (s >= 0) {
          piece.loop.push_back(keep(v));
          on.push_back(s == 0);
        }
        if (s * t < 0) {
          piece.loop.push_back(between(v, w));
          on.push_back(true);
        }
      }
      if (std::count(on.begin(), on.end(), false) == 0) continue;
      for (size_t i = 0; i < on.size(); ++i) {
        const size_t next = (i + 1) % on.size();
        if (on[i] && on[next]) rim[piece.loop[next]] = piece.loop[i];
      }
      part.facets.push_back(std::move(piece));
    }
    Facet cap{p, {}};
    uint32_t at = rim.begin()->first;
    do {
      cap.loop.push_back(at);
      at = rim.at(at);
    } while (at != rim.begin()->first);
    part.facets.push_back(std::move(cap));
    return part;
  }

  [[nodiscard]] uint32_t outermost() const {
    for (uint32_t c = 0; c < cells_.size(); ++c) {
      for (const Facet& f : cells_[c].facets) {
        if (f.plane == kBox) return c;
      }
    }
    return 0;
  }

  /// Is the middle of a facet in a face?
  static bool covers(const std::vector<Point>& points, const Face& face, const Plane& plane,
                     const std::array<mpq_class, 3>& x) {
    const int u = (plane.axis + 1) % 3, v = (plane.axis + 2) % 3;
    bool inside = false;
    for (const auto& loop : face.loops) {
      for (size_t i = 0; i < loop.size(); ++i) {
        const Point &a = points[loop[i]], &b = points[loop[(i + 1) % loop.size()]];
        const bool low_a = mpq_class(a[v]) <= x[v] * a[3], low_b = mpq_class(b[v]) <= x[v] * b[3];
        if (low_a == low_b) continue;
        // Where the edge passes x, against x: their order is a sign of the turn.
        const mpq_class turn = (b[u] - x[u] * b[3]) * (a[v] - x[v] * a[3]) -
                               (a[u] - x[u] * a[3]) * (b[v] - x[v] * b[3]);
        if ((turn > 0) == low_a) inside = !inside;
      }
    }
    return inside;
  }

  [[nodiscard]] Door door_of(uint32_t c, uint32_t f) const {
    const Cell& cell = cells_[c];
    const uint32_t p = cell.facets[f].plane;
    Door door{~0u, f, !cell.sides[p], false, false, std::vector<int>(leaves_.size(), 0)};
    std::vector<bool> next = cell.sides;
    next[p] = !next[p];
    const auto at = numbers_.find(next);
    if (at != numbers_.end()) door.to = at->second;
    if (p >= given_.planes.size()) return door;
    std::array<mpq_class, 3> middle{0, 0, 0};
    const auto& loop = cell.facets[f].loop;
    for (const uint32_t v : loop) {
      for (int k = 0; k < 3; ++k) {
        mpq_class x(Number<Z>::to_gmp(cell.points[v][k]), Number<Z>::to_gmp(cell.points[v][3]));
        x.canonicalize();
        middle[k] += x / mpq_class(static_cast<unsigned long>(loop.size()));
      }
    }
    for (size_t l = 0; l < leaves_.size(); ++l) {
      for (size_t g = 0; g < leaves_[l].faces.size(); ++g) {
        const Planes::Use& use = given_.of_leaf[l][g];
        if (use.plane != p) continue;
        if (!covers(leaves_[l].points, leaves_[l].faces[g], given_.planes[p], middle)) continue;
        (use.down ? door.has_down : door.has_up) = true;
        door.net[l] += use.down ? -1 : 1;
      }
    }
    return door;
  }

  /// From cell to cell, through faces. False when two ways disagree.
  bool find_windings() {
    doors_.resize(cells_.size());
    for (uint32_t c = 0; c < cells_.size(); ++c) {
      for (uint32_t f = 0; f < cells_[c].facets.size(); ++f) {
        if (cells_[c].facets[f].plane == kBox) continue;
        doors_[c].push_back(door_of(c, f));
        if (doors_[c].back().to == ~0u) return false;
      }
    }
    windings_.assign(cells_.size(), {});
    std::vector<uint32_t> open{outermost()};
    windings_[open[0]].assign(leaves_.size(), 0);
    while (!open.empty()) {
      const uint32_t from = open.back();
      open.pop_back();
      for (const Door& door : doors_[from]) {
        std::vector<int> next = windings_[from];
        for (size_t l = 0; l < next.size(); ++l) next[l] += door.up ? -door.net[l] : door.net[l];
        if (windings_[door.to].size() != leaves_.size()) {
          windings_[door.to] = std::move(next);
          open.push_back(door.to);
        } else if (windings_[door.to] != next) {
          return false;
        }
      }
    }
    inside_.clear();
    for (const auto& w : windings_) inside_.push_back(inside(tree_, w));
    return true;
  }

  [[nodiscard]] bool inside(const Tree& t, const std::vector<int>& windings) const {
    if (t.leaf >= 0) {
      const int w = windings[static_cast<size_t>(t.leaf)];
      switch (leaves_[static_cast<size_t>(t.leaf)].rule) {
        case FillRule::kNonZero:
          return w != 0;
        case FillRule::kPositive:
          return w > 0;
        default:
          return w % 2 != 0;
      }
    }
    bool r = inside(t.children[0], windings);
    for (size_t i = 1; i < t.children.size(); ++i) {
      const bool v = inside(t.children[i], windings);
      switch (t.op) {
        case BooleanOp::kUnion:
          r = r || v;
          break;
        case BooleanOp::kIntersection:
          r = r && v;
          break;
        case BooleanOp::kDifference:
          r = r && !v;
          break;
        default:
          r = r != v;
          break;
      }
    }
    return r;
  }

  [[nodiscard]] bool passes(Reach reach, uint32_t from, const Door& door) const {
    switch (reach) {
      case Reach::kSurface:
        return !door.has_up && (!door.has_down || fault_ == Fault::kLeak);
      case Reach::kFronts:  // who goes up comes from behind those that look up
        return door.up != (fault_ == Fault::kWrongWay) ? !door.has_down : !door.has_up;
      default:
        return inside_[from] == inside_[door.to];
    }
  }

  const std::vector<Leaf>& leaves_;
  const Tree& tree_;
  const Planes& given_;  ///< the first of planes_
  Fault fault_;
  std::vector<Vector> planes_;
  std::map<std::array<mpz_class, 4>, size_t> known_;
  std::vector<Cell> cells_;
  std::map<std::vector<bool>, uint32_t> numbers_;
  std::vector<std::vector<Door>> doors_;
  std::vector<std::vector<int>> windings_;
  std::vector<uint8_t> inside_;
};

}  // namespace

std::optional<Leaf> hull(const std::vector<Leaf>& leaves, const Tree& tree, Reach reach,
                         Fault fault) {
  Planes planes;
  if (!gather_planes(leaves, nullptr, planes).empty()) return std::nullopt;
  int n = 1, d = 1;
  for (const Plane& p : planes.planes) {
    for (int k = 0; k < 3; ++k) {
      n = std::max(n, static_cast<int>(mpz_sizeinbase(p.c[k].get_mpz_t(), 2)));
    }
    d = std::max(d, static_cast<int>(mpz_sizeinbase(p.c[3].get_mpz_t(), 2)));
  }
  // Corners are where three planes meet, two bits wider for the box; walls of flat edges are
  // narrower than the planes of other faces by nothing that is known, so there is room.
  const int xyz = 2 * n + d + 6;
  if (n + 2 * xyz + 6 <= 110) return Cells<__int128>(leaves, tree, planes, fault).unreached(reach);
  return Cells<mpz_class>(leaves, tree, planes, fault).unreached(reach);
}

}  // namespace csgrun::reference

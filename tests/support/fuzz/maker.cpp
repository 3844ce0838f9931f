#include "tests/support/fuzz/maker.h"

#include <algorithm>

#include "tests/support/random_frames.h"

namespace csgrun::test {

FuzzCase FuzzMaker::make() {
  FuzzCase c;
  // Mostly on a grid of few steps, where much touches; else in general position, mostly.
  size_ = one_in(8) ? random_.integer(60, 1000) : random_.integer(3, 5);
  // Small cases find most faults, and many of them fit into an hour.
  constexpr int64_t kUpTo[] = {4, 44, 72, 86, 92, 97, 99};
  const int64_t draw = random_.integer(0, 99);
  int64_t n = 1;
  for (const int64_t bound : kUpTo) n += draw >= bound;
  if (n > 6) n = random_.integer(7, 12);
  make_frames(c);
  centred_ = c.frames.size() > 1;
  for (int64_t i = 0; i < n; ++i) c.leaves.push_back(leaf(c, n));
  c.tree = node(c, 0, static_cast<int>(n) - 1);
  constexpr uint32_t kLimits[] = {1, 3, 9, 17, 33};
  c.options.cell_limit = kLimits[random_.integer(0, 4)];
  for (auto& s : c.options.octree_shift) s = static_cast<uint32_t>(random_.integer(0, 5));
  c.options.literal_cells = one_in(6);
  c.nest = one_in(2) ? random_.bits() & 0xffff : 0;
  if (one_in(4)) c.nest |= kInPieces;
  if (one_in(2)) c.nest |= kNamed;
  if (one_in(2)) c.nest |= kPrepared;
  return c;
}

IVec3 FuzzMaker::point() {
  return {random_.integer(0, size_), random_.integer(0, size_), random_.integer(0, size_)};
}

void FuzzMaker::make_frames(FuzzCase& c) {
  if (!kinds_.frames || one_in(2)) return;
  const bool turned = one_in(3);
  for (int64_t n = random_.integer(1, 2); n > 0; --n) {
    c.frames.push_back(turned ? random_frame(random_) : small_frame());
  }
}

Frame FuzzMaker::small_frame() {
  Frame f;
  f.is_identity = false;
  for (;;) {
    std::array<IVec3, 3> m{};
    for (auto& row : m) {
      for (auto& v : row) v = one_in(2) ? 0 : random_.integer(-4, 4);
    }
    const int64_t det = dot_of(m[0], cross_of(m[1], m[2]));
    if (det == 0 || std::abs(det) < 8) continue;  // the world would be large
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) f.matrix[i][j] = m[i][j] * (int64_t{1} << (Frame::kShift - 2));
    }
    return f;
  }
}

FuzzLeaf FuzzMaker::leaf(const FuzzCase& c, int64_t count) {
  FuzzLeaf l;
  if (!c.leaves.empty() && one_in(8)) {
    // The same again, perhaps moved.
    l = c.leaves[static_cast<size_t>(
        random_.integer(0, static_cast<int64_t>(c.leaves.size()) - 1))];
  } else if (kinds_.crossing && one_in(5)) {
    l.may_cross = true;
    l.fill = static_cast<FillRule>(random_.integer(0, 2));
    while (l.faces.empty()) l.faces = crossing_loops();
  } else {
    l.faces = simple_loops(count);
  }
  l.keep_facets = one_in(4);
  l.appearance = static_cast<uint32_t>(random_.integer(0, 1));
  for (auto& m : l.move) {
    m = one_in(4) ? random_.integer(-1, 1) : 0;
    if (centred_) m -= size_ / 2;
  }
  if (c.frames.size() > 1) {
    l.frame = static_cast<uint32_t>(random_.integer(0, static_cast<int64_t>(c.frames.size()) - 1));
  }
  return l;
}

std::vector<Loop> FuzzMaker::simple_loops(int64_t count) {
  if (one_in(10)) {
    // A plate beyond everything else on its sides: what cuts it leaves holes within its faces.
    IVec3 lo{-1, -1, -1}, hi{size_ + 1, size_ + 1, size_ + 1};
    const int axis = static_cast<int>(random_.integer(0, 2));
    lo[axis] = random_.integer(0, size_ - 1);
    hi[axis] = random_.integer(lo[axis] + 1, size_);
    return box_loops(lo, hi);
  }
  // Many leaves: mostly with few faces each.
  if (one_in(count > 4 ? 2 : 4)) {
    for (;;) {
      const IVec3 a = point(), b = point();
      if (a[0] != b[0] && a[1] != b[1] && a[2] != b[2]) {
        IVec3 lo, hi;
        for (int k = 0; k < 3; ++k) lo[k] = std::min(a[k], b[k]), hi[k] = std::max(a[k], b[k]);
        return box_loops(lo, hi);
      }
    }
  }
  if (one_in(8)) {
    auto loops = tent_loops(random_, size_);
    if (!loops.empty()) return loops;
  }
  for (;;) {
    auto loops = random_loops(random_, size_);
    if (loops.size() <= 24 || one_in(12)) return loops;
  }
}

std::vector<Loop> FuzzMaker::crossing_loops() {
  switch (random_.integer(0, 5)) {
    case 0: {  // two solids in one surface, one of them perhaps inside out
      auto loops = simple_loops(6);
      auto more = simple_loops(6);
      if (one_in(2)) turn_over(more);
      loops.insert(loops.end(), more.begin(), more.end());
      return loops;
    }
    case 1: {  // a solid wrapped twice, or inside out
      auto loops = simple_loops(6);
      if (one_in(2)) {
        turn_over(loops);
      } else {
        const auto again = loops;
        loops.insert(loops.end(), again.begin(), again.end());
      }
      return loops;
    }
    case 2: {  // a double cone over a polygon that crosses itself
      std::vector<IVec3> ring;
      for (int64_t n = random_.integer(3, 6); n > 0; --n) ring.push_back(point());
      const IVec3 top = point(), bottom = point();
      std::vector<Loop> loops;
      for (size_t i = 0; i < ring.size(); ++i) {
        const IVec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        loops.push_back({a, b, top});
        loops.push_back({b, a, bottom});
      }
      return without_slivers(loops);
    }
    case 3: {  // an octahedron with its corners anywhere
      std::array<IVec3, 6> p;
      for (auto& q : p) q = point();
      std::vector<Loop> loops;
      constexpr int kFaces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
      for (const auto& f : kFaces) loops.push_back({p[f[0]], p[f[1]], p[f[2]]});
      return without_slivers(loops);
    }
    case 4:
      return touching_wedges();
    default: {  // a cube of triangles, some corners moved anywhere
      auto loops = box_loops({0, 0, 0}, {size_, size_, size_});
      const IVec3 from{size_, size_, size_}, from_too{0, size_, 0};
      const IVec3 to = point(), to_too = point();
      std::vector<Loop> triangles;
      for (Loop& loop : loops) {
        for (IVec3& p : loop) p = p == from ? to : p == from_too ? to_too : p;
        triangles.push_back({loop[0], loop[1], loop[2]});
        triangles.push_back({loop[0], loop[2], loop[3]});
      }
      return without_slivers(triangles);
    }
  }
}

std::vector<Loop> FuzzMaker::touching_wedges() {
  std::vector<IVec3> spokes;
  while (spokes.size() < 4) {
    const IVec3 s{random_.integer(1, size_), random_.integer(-size_, size_), 0};
    const bool is_new = std::none_of(spokes.begin(), spokes.end(),
                                     [&](const IVec3& t) { return s[0] * t[1] == s[1] * t[0]; });
    if (is_new) spokes.push_back(s);
  }
  std::sort(spokes.begin(), spokes.end(),
            [](const IVec3& s, const IVec3& t) { return s[1] * t[0] < t[1] * s[0]; });
  const int axis = static_cast<int>(random_.integer(0, 2));
  const bool mirrored = one_in(2), back = one_in(2);
  const IVec3 at = point();
  const int64_t height = random_.integer(1, size_);
  const auto place = [&](const IVec3& spoke, int64_t z) {
    IVec3 p = at;
    p[(axis + 1) % 3] += mirrored ? -spoke[0] : spoke[0];
    p[(axis + 2) % 3] += back ? -spoke[1] : spoke[1];
    p[axis] += z;
    return p;
  };
  std::vector<Loop> loops;
  for (const size_t i : {0u, 2u}) {
    std::array<IVec3, 3> triangle{IVec3{0, 0, 0}, spokes[i], spokes[i + 1]};
    if (mirrored != back) std::swap(triangle[1], triangle[2]);
    Loop floor, lid;
    for (size_t k = 0; k < 3; ++k) {
      const IVec3 &a = triangle[k], &b = triangle[(k + 1) % 3];
      loops.push_back({place(a, 0), place(b, 0), place(b, height), place(a, height)});
      floor.insert(floor.begin(), place(a, 0));
      lid.push_back(place(a, height));
    }
    loops.push_back(floor);
    loops.push_back(lid);
  }
  return loops;
}

std::vector<Loop> FuzzMaker::without_slivers(std::vector<Loop> loops) {
  for (const Loop& l : loops) {
    if (cross_of(sub(l[1], l[0]), sub(l[2], l[0])) == IVec3{0, 0, 0}) return {};
  }
  return loops;
}

FuzzNode FuzzMaker::node(const FuzzCase& c, int first, int last) {
  FuzzNode n;
  if (first == last) {
    n.leaf = first;
  } else {
    n.op = static_cast<BooleanOp>(random_.integer(0, 3));
    for (int at = first; at <= last;) {
      // At least two children: the first never takes everything.
      const int end = static_cast<int>(random_.integer(at, at == first ? last - 1 : last));
      n.children.push_back(node(c, at, end));
      at = end + 1;
    }
  }
  // The reference cuts space by all planes below a hull.
  size_t faces = 0;
  for (int i = first; i <= last; ++i) faces += c.leaves[static_cast<size_t>(i)].faces.size();
  if (!kinds_.hulls || faces > 20 || !one_in(14)) return n;
  FuzzNode hull;
  hull.hull = OuterHull{one_in(2), one_in(2)};
  hull.children.push_back(std::move(n));
  return hull;
}

}  // namespace csgrun::test

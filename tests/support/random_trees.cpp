#include "tests/support/random_trees.h"

#include <algorithm>
#include <cmath>

#include "engine/mesh/opposite_edges.h"

namespace csgrun::test {

RandomTree TreeMaker::make(const TreeShape& shape) {
  shape_ = shape;
  RandomTree tree;
  for (int o = 0; o < shape.operands; ++o) {
    Operand operand;
    // Now and then the same leaf again: equal or merely moved.
    if (o > 0 && one_in(6))
      operand = tree.operands[random_.integer(0, o - 1)];
    else
      operand.leaf = leaf();
    operand.first_source = static_cast<uint32_t>(o);
    for (int64_t& t : operand.translation) t = one_in(4) ? random_.integer(-1, 1) * shape.unit : 0;
    if (shape.frames && !one_in(3)) operand.frame = frame();
    tree.operands.push_back(operand);
  }
  add_node(tree, shape.depth, true);
  tree.region = region_of(tree.operands);
  return tree;
}

GridBox TreeMaker::region_of(const std::vector<Operand>& operands) {
  GridBox box{{INT64_MAX, INT64_MAX, INT64_MAX}, {INT64_MIN, INT64_MIN, INT64_MIN}};
  for (const Operand& o : operands) {
    for (const IVec3& q : o.leaf->vertices) {
      const auto p = world(o, q);
      for (int k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], static_cast<int64_t>(std::floor(p[k])) - 1);
        box.hi[k] = std::max(box.hi[k], static_cast<int64_t>(std::ceil(p[k])) + 1);
      }
    }
  }
  return box;
}

std::array<double, 3> TreeMaker::world(const Operand& o, const IVec3& q) {
  std::array<double, 3> r{};
  for (int k = 0; k < 3; ++k) r[k] = static_cast<double>(q[k] + o.translation[k]);
  if (o.frame.is_identity) return r;
  std::array<std::array<double, 3>, 3> m{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m[i][j] = static_cast<double>(o.frame.matrix[i][j]) * 0x1p-40;
  }
  const auto minor = [&](int i, int j) {
    const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
  std::array<double, 3> p{};
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) p[k] += minor(j, k) * r[j] / det;
  }
  return p;
}

IVec3 TreeMaker::minus(const IVec3& a, const IVec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

int64_t TreeMaker::det(const IVec3& a, const IVec3& b, const IVec3& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

void TreeMaker::add_faces(LeafGeometry& leaf, const std::vector<IVec3>& points, Loops loops,
                          bool reverse) {
  const auto first = static_cast<uint32_t>(leaf.vertices.size());
  for (const IVec3& p : points) {
    leaf.vertices.push_back({p[0] * shape_.unit, p[1] * shape_.unit, p[2] * shape_.unit});
  }
  for (auto& loop : loops) {
    if (reverse) std::reverse(loop.begin(), loop.end());
    for (const uint32_t c : loop) leaf.corners.push_back(first + c);
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  }
}

void TreeMaker::add_prism(LeafGeometry& leaf, const IVec3& origin, const IVec3& u, const IVec3& v,
                          const IVec3& w, const std::vector<std::array<int64_t, 2>>& base,
                          const Loops& pieces, bool reverse) {
  std::vector<IVec3> points;
  const auto n = static_cast<uint32_t>(base.size());
  for (int top = 0; top < 2; ++top) {
    for (const auto& [s, t] : base) {
      IVec3 p;
      for (int k = 0; k < 3; ++k) p[k] = origin[k] + s * u[k] + t * v[k] + top * w[k];
      points.push_back(p);
    }
  }
  Loops loops;
  for (const auto& piece : pieces) {
    loops.emplace_back(piece.rbegin(), piece.rend());
    loops.push_back(piece);
    for (uint32_t& c : loops.back()) c += n;
  }
  for (uint32_t i = 0; i < n; ++i) loops.push_back({i, (i + 1) % n, (i + 1) % n + n, i + n});
  add_faces(leaf, points, loops, (det(u, v, w) < 0) != reverse);
}

void TreeMaker::add_box(LeafGeometry& leaf, const IVec3& lo, const IVec3& hi, bool reverse) {
  add_prism(leaf, lo, {hi[0] - lo[0], 0, 0}, {0, hi[1] - lo[1], 0}, {0, 0, hi[2] - lo[2]},
            {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2, 3}}, reverse);
}

std::pair<IVec3, IVec3> TreeMaker::box() {
  IVec3 lo, hi;
  for (int k = 0; k < 3; ++k) {
    lo[k] = random_.integer(0, shape_.size - 1);
    hi[k] = random_.integer(lo[k] + 1, shape_.size);
  }
  return {lo, hi};
}

void TreeMaker::fill(LeafGeometry& leaf) {
  switch (random_.integer(0, 6)) {
    case 0:
    case 1: {
      const auto [lo, hi] = box();
      add_box(leaf, lo, hi, false);
      return;
    }
    case 2: {  // tetrahedron
      std::vector<IVec3> p{vector(), vector(), vector(), vector()};
      const int64_t d = det(minus(p[1], p[0]), minus(p[2], p[0]), minus(p[3], p[0]));
      if (d) add_faces(leaf, p, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, d < 0);
      return;
    }
    case 3: {  // two tetrahedra glued together: possibly not convex, possibly coplanar neighbours
      std::vector<IVec3> p{vector(), vector(), vector(), vector(), vector()};
      const int64_t d = det(minus(p[1], p[0]), minus(p[2], p[0]), minus(p[3], p[0]));
      const int64_t e = det(minus(p[1], p[0]), minus(p[2], p[0]), minus(p[4], p[0]));
      if (d == 0 || e == 0 || (d < 0) == (e < 0)) return;
      add_faces(leaf, p, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}}, d < 0);
      return;
    }
    case 4: {  // box with a cavity
      const auto [lo, hi] = box();
      for (int k = 0; k < 3; ++k) {
        if (hi[k] - lo[k] < 3) return;
      }
      add_box(leaf, lo, hi, false);
      add_box(leaf, {lo[0] + 1, lo[1] + 1, lo[2] + 1}, {hi[0] - 1, hi[1] - 1, hi[2] - 1}, true);
      return;
    }
    default: {  // oblique prism
      const IVec3 origin = vector();
      const IVec3 u{random_.integer(-2, 2), random_.integer(-2, 2), random_.integer(-2, 2)};
      const IVec3 v{random_.integer(-2, 2), random_.integer(-2, 2), random_.integer(-2, 2)};
      const IVec3 w{random_.integer(-4, 4), random_.integer(-4, 4), random_.integer(-4, 4)};
      if (det(u, v, w) == 0) return;
      switch (random_.integer(0, 3)) {
        case 0:
          add_prism(leaf, origin, u, v, w, {{0, 0}, {1, 0}, {0, 1}}, {{0, 1, 2}}, false);
          break;
        case 1:
          add_prism(leaf, origin, u, v, w, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {{0, 1, 2, 3}}, false);
          break;
        case 2:
          add_prism(leaf, origin, u, v, w, {{0, 0}, {1, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 1}},
                    {{0, 1, 2, 3, 4, 5}}, false);
          break;
        default:
          add_prism(leaf, origin, u, v, w, {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
                    {{0, 1, 2, 3}, {0, 3, 4, 5}}, false);
      }
      for (const IVec3& p : leaf.vertices) {
        for (const int64_t c : p) {
          if (c < 0 || c > shape_.size * shape_.unit) leaf.corners.clear();
        }
      }
    }
  }
}

std::shared_ptr<const LeafGeometry> TreeMaker::leaf() {
  auto leaf = std::make_shared<LeafGeometry>();
  while (leaf->corners.empty()) {
    *leaf = LeafGeometry();
    fill(*leaf);
  }
  if (one_in(2)) leaf->facet = FaceNumbers::ascending(1);
  if (shape_.known) {
    leaf->opposite = pair_edges(*leaf).opposite;
    leaf->convex = is_convex(*leaf);
    leaf->may_touch = false;
  }
  return leaf;
}

bool TreeMaker::is_convex(const LeafGeometry& leaf) {
  for (uint32_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t* corner = &leaf.corners[leaf.face_starts[f]];
    const IVec3& at = leaf.vertices[corner[0]];
    const IVec3 u = minus(leaf.vertices[corner[1]], at), v = minus(leaf.vertices[corner[2]], at);
    for (const IVec3& p : leaf.vertices) {
      if (det(u, v, minus(p, at)) > 0) return false;
    }
  }
  return true;
}

Frame TreeMaker::frame() {
  static constexpr double kMaps[][3][3] = {
      {{0.8, 0.6, 0}, {-0.6, 0.8, 0}, {0, 0, 1}},  // about z
      {{1, 0, 0}, {0, 0.8, -0.6}, {0, 0.6, 0.8}},  // about x
      {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},          // mirrored
      {{1. / 3, 2. / 3, 2. / 3}, {2. / 3, 1. / 3, -2. / 3}, {-2. / 3, 2. / 3, -1. / 3}},
      {{1, 0.5, 0}, {0, 1, 0}, {0, 0, 1}},  // sheared
  };
  const auto& m = kMaps[random_.integer(0, 4)];
  Frame f;
  f.is_identity = false;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) f.matrix[i][j] = std::llround(m[i][j] * 0x1p40);
  }
  return f;
}

uint32_t TreeMaker::add_node(RandomTree& tree, int depth, bool root) {
  Expression& e = tree.expression;
  const auto count = static_cast<int64_t>(tree.operands.size());
  std::vector<uint32_t> children;
  if (root) {  // every operand at least once
    next_operand_ = 0;
  }
  if (depth == 0 || (!root && one_in(4))) {
    const int64_t o = next_operand_ < count ? next_operand_++ : random_.integer(0, count - 1);
    e.nodes.push_back({true, BooleanOp::kUnion, static_cast<uint32_t>(o), 0, 0});
    return static_cast<uint32_t>(e.nodes.size() - 1);
  }
  const int64_t wanted = random_.integer(2, 3);
  for (int64_t c = 0; c < wanted || (root && next_operand_ < count); ++c) {
    children.push_back(add_node(tree, depth - 1, false));
  }
  const auto op = static_cast<BooleanOp>(random_.integer(0, 3));
  e.nodes.push_back({false, op, 0, static_cast<uint32_t>(e.children.size()),
                     static_cast<uint32_t>(children.size())});
  e.children.insert(e.children.end(), children.begin(), children.end());
  return static_cast<uint32_t>(e.nodes.size() - 1);
}

}  // namespace csgrun::test

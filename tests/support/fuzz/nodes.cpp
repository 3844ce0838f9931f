#include "tests/support/fuzz/nodes.h"

#include <cmath>
#include <map>

namespace csgrun::test {

const std::vector<Matrix>& rational_turns() {
  static const std::vector<Matrix> turns{
      {{{0.6, -0.8, 0}, {0.8, 0.6, 0}, {0, 0, 1}}},
      {{{1, 0, 0}, {0, 5. / 13, 12. / 13}, {0, -12. / 13, 5. / 13}}},
      {{{1. / 3, 2. / 3, 2. / 3}, {2. / 3, 1. / 3, -2. / 3}, {-2. / 3, 2. / 3, -1. / 3}}},
      {{{-0.8, 0.6, 0}, {0.6, 0.8, 0}, {0, 0, 1}}},  // with a mirror
      {{{0, 0, -1}, {1, 0, 0}, {0, 1, 0}}},
  };
  return turns;
}

void put_in_turned_frames(Random& random, FuzzCase& c) {
  if (random.integer(0, 1) == 0) return;
  for (int64_t n = random.integer(1, 2); n > 0; --n) {
    const auto& turn = rational_turns()[static_cast<size_t>(
        random.integer(0, static_cast<int64_t>(rational_turns().size()) - 1))];
    Matrix inverse{};
    for (size_t i = 0; i < 3; ++i) {
      for (size_t j = 0; j < 3; ++j) inverse[i][j] = turn[j][i];
    }
    c.frames.push_back(frame_of(inverse));
  }
  for (FuzzLeaf& l : c.leaves) {
    l.frame = static_cast<uint32_t>(random.integer(0, static_cast<int64_t>(c.frames.size()) - 1));
  }
}

NodePtr leaf_node_of(const FuzzCase& c, const FuzzLeaf& l) {
  auto mesh = std::make_shared<PolygonMesh>();
  std::map<IVec3, uint32_t> numbers;
  for (const Loop& loop : l.faces) {
    std::vector<uint32_t> corners;
    for (const IVec3& p : loop) {
      const auto [at, is_new] = numbers.emplace(p, static_cast<uint32_t>(mesh->points.size()));
      if (is_new) {
        mesh->points.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                  static_cast<double>(p[2]));
      }
      corners.push_back(at->second);
    }
    mesh->add_face(corners);
    mesh->appearance_of.push_back(0);
  }
  mesh->appearances = {test_context().appearances[l.appearance]};
  mesh->keep_facets = l.keep_facets;
  mesh->fill = l.fill;
  Affine move;
  for (int k = 0; k < 3; ++k) move.m[k][3] = static_cast<double>(l.move[k]);
  const NodePtr node = Node::transformed(move, Node::leaf(std::move(mesh)));
  if (l.frame == 0) return node;
  Affine turn;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      // A rotation's inverse is its transpose.
      turn.m[i][j] =
          std::ldexp(static_cast<double>(c.frames[l.frame].matrix[j][i]), -Frame::kShift);
    }
  }
  for (const Matrix& exact : rational_turns()) {
    bool same = true;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) same = same && std::fabs(exact[i][j] - turn.m[i][j]) < 1e-9;
    }
    if (!same) continue;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) turn.m[i][j] = exact[i][j];
    }
  }
  return Node::transformed(turn, node);
}

NodePtr node_of(const FuzzCase& c, const FuzzNode& n) {
  if (n.leaf >= 0) return leaf_node_of(c, c.leaves[static_cast<size_t>(n.leaf)]);
  std::vector<NodePtr> children;
  for (const FuzzNode& child : n.children) children.push_back(node_of(c, child));
  if (n.hull) return Node::outer_hull(*n.hull, children[0]);
  return Node::boolean(n.op, std::move(children));
}

NodePtr node_of(const FuzzCase& c) { return node_of(c, c.tree); }

}  // namespace csgrun::test

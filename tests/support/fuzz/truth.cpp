#include "tests/support/fuzz/truth.h"

#include <algorithm>
#include <map>

#include "tests/support/gmp_bridge.h"
#include "tests/support/reference/cells.h"
#include "tests/support/reference/reference.h"

namespace csgrun::test {

ExactMap::ExactMap(const Frame& frame) {
  if (frame.is_identity) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) matrix[i][j] = i == j;
    }
    return;
  }
  std::array<std::array<mpz_class, 3>, 3> m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m[i][j] = mpz_class(frame.matrix[i][j]);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      matrix[i][j] = (m[a][c] * m[b][d] - m[a][d] * m[b][c]) << Frame::kShift;
    }
  }
  denominator = 0;
  for (int j = 0; j < 3; ++j) denominator += m[0][j] * (matrix[j][0] >> Frame::kShift);
  mirrors = denominator < 0;
  mpz_class common = denominator;
  for (const auto& row : matrix) {
    for (const auto& v : row) common = gcd(common, v);
  }
  if (mirrors) common = -common;
  denominator /= common;
  for (auto& row : matrix) {
    for (auto& v : row) v /= common;
  }
}

reference::Point ExactMap::operator()(const IVec3& q) const {
  reference::Point p;
  for (int i = 0; i < 3; ++i) {
    p[i] = 0;
    for (int j = 0; j < 3; ++j) p[i] += matrix[i][j] * mpz_class(q[j]);
  }
  p[3] = denominator;
  return p;
}

namespace {

reference::Leaf reference_leaf(const FuzzCase& c, uint32_t index) {
  const FuzzLeaf& l = c.leaves[index];
  const ExactMap map(c.frames[l.frame]);
  reference::Leaf leaf;
  leaf.rule = l.fill;
  if (l.may_cross) leaf.sources = {index};
  std::map<IVec3, uint32_t> numbers;
  for (size_t f = 0; f < l.faces.size(); ++f) {
    reference::Face& face = leaf.faces.emplace_back();
    face.label = {index, l.keep_facets ? static_cast<uint32_t>(f) + 1 : 0, 0, l.appearance};
    auto& loop = face.loops.emplace_back();
    for (const IVec3& p : l.faces[f]) {
      const auto [at, is_new] = numbers.emplace(p, static_cast<uint32_t>(leaf.points.size()));
      if (is_new)
        leaf.points.push_back(map({p[0] + l.move[0], p[1] + l.move[1], p[2] + l.move[2]}));
      loop.push_back(at->second);
    }
    if (map.mirrors) std::reverse(loop.begin(), loop.end());
  }
  return leaf;
}

/// Where three planes meet, by Cramer's rule.
reference::Point meeting(const Plane& p, const Plane& q, const Plane& r) {
  const Plane* planes[3] = {&p, &q, &r};
  mpz_class m[3][4];
  for (int i = 0; i < 3; ++i) {
    m[i][0] = to_gmp(planes[i]->a);
    m[i][1] = to_gmp(planes[i]->b);
    m[i][2] = to_gmp(planes[i]->c);
    m[i][3] = to_gmp(planes[i]->d);
  }
  const auto determinant = [&](int a, int b, int c) -> mpz_class {
    return m[0][a] * (m[1][b] * m[2][c] - m[1][c] * m[2][b]) -
           m[0][b] * (m[1][a] * m[2][c] - m[1][c] * m[2][a]) +
           m[0][c] * (m[1][a] * m[2][b] - m[1][b] * m[2][a]);
  };
  reference::Point x{-determinant(3, 1, 2), -determinant(0, 3, 2), -determinant(0, 1, 3),
                     determinant(0, 1, 2)};
  reference::reduce(x);
  return x;
}

}  // namespace

reference::Claim claim_of(const BoundaryMesh& mesh) {
  reference::Claim claim;
  for (const auto& t : mesh.point_planes) {
    claim.points.push_back(meeting(mesh.planes[t[0]], mesh.planes[t[1]], mesh.planes[t[2]]));
  }
  for (const BoundaryMesh::Face& f : mesh.faces) {
    reference::Face& face = claim.faces.emplace_back();
    face.label = {f.label.source, f.label.facet, f.label.surface, f.label.appearance};
    for (uint32_t l = f.first_loop; l < f.first_loop + f.loop_count; ++l) {
      auto& loop = face.loops.emplace_back();
      for (uint32_t c = mesh.loop_starts[l]; c < mesh.loop_starts[l + 1]; ++c) {
        loop.push_back(mesh.corners[c].point);
      }
    }
  }
  return claim;
}

namespace {

class TruthMaker {
 public:
  TruthMaker(const FuzzCase& c, reference::Fault fault) : case_(c), fault_(fault) {
    truth_.tree = tree(c.tree);
  }
  [[nodiscard]] Truth take() { return std::move(truth_); }

 private:
  static reference::Tree mention(size_t leaf) {
    reference::Tree t;
    t.leaf = static_cast<int>(leaf);
    return t;
  }
  reference::Tree add(reference::Leaf leaf) {
    truth_.leaves.push_back(std::move(leaf));
    return mention(truth_.leaves.size() - 1);
  }

  reference::Tree tree(const FuzzNode& n) {
    if (n.leaf >= 0) return add(reference_leaf(case_, static_cast<uint32_t>(n.leaf)));
    if (n.hull) return hull(*n.hull, n.children[0]);
    reference::Tree t;
    t.op = n.op;
    for (const FuzzNode& c : n.children) t.children.push_back(tree(c));
    return t;
  }

  /// Of a leaf: of its surface as it is, whatever its fill rule; with voids kept it is a fill rule.
  /// Of anything else: its solid with voids filled, or as it is.
  reference::Tree hull(const OuterHull& options, const FuzzNode& child) {
    if (child.leaf >= 0) {
      const auto index = static_cast<uint32_t>(child.leaf);
      reference::Leaf leaf = reference_leaf(case_, index);
      leaf.rule = options.orientation_sensitive ? FillRule::kPositive : FillRule::kNonZero;
      leaf.sources = {index};
      if (options.keep_voids) return add(std::move(leaf));
      return flooded(
          {std::move(leaf)}, mention(0),
          options.orientation_sensitive ? reference::Reach::kFronts : reference::Reach::kSurface,
          {index});
    }
    if (options.keep_voids) return tree(child);
    // Its leaves are numbered apart.
    std::vector<reference::Leaf> outer;
    std::swap(outer, truth_.leaves);
    const reference::Tree inner = tree(child);
    std::swap(outer, truth_.leaves);
    std::vector<uint32_t> sources;
    collect(child, sources);
    return flooded(std::move(outer), inner, reference::Reach::kSolid, std::move(sources));
  }

  reference::Tree flooded(const std::vector<reference::Leaf>& leaves, const reference::Tree& tree,
                          reference::Reach reach, std::vector<uint32_t> sources) {
    auto leaf = reference::hull(leaves, tree, reach, fault_);
    if (!leaf) {
      truth_.fault = "windings of cells contradict each other";
      leaf.emplace();
    }
    leaf->sources = std::move(sources);
    return add(*std::move(leaf));
  }

  static void collect(const FuzzNode& n, std::vector<uint32_t>& leaves) {
    if (n.leaf >= 0) leaves.push_back(static_cast<uint32_t>(n.leaf));
    for (const FuzzNode& c : n.children) collect(c, leaves);
  }

  const FuzzCase& case_;
  reference::Fault fault_;
  Truth truth_;
};

}  // namespace

Truth truth_of(const FuzzCase& c, reference::Fault fault) { return TruthMaker(c, fault).take(); }

}  // namespace csgrun::test

// Trees of small polyhedra on a grid where everything meets, evaluated in several ways that must
// give the same solid: cells of another size and place, the paper's literal cells, one Boolean at a
// time.
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include <csgrun/engine/validate.h>

#include "tests/fuzz/decoder.h"
#include "tests/fuzz/evaluate_small.h"

namespace {

using csgrun::BooleanOp;
using csgrun::Node;
using csgrun::NodePtr;
using csgrun::PolygonMesh;
using csgrun::fuzz::Decoder;

constexpr int kReach = 4;
constexpr size_t kMostLeaves = 6;

glm::dvec3 point(Decoder& in) {
  const uint32_t code = in.choose(125);  // one byte: all of {0..4}^3
  return {code % 5, code / 5 % 5, code / 25};
}

/// Closed surfaces by their faces; corners may lie anywhere, so that they cross themselves too.
using Faces = std::vector<std::vector<uint32_t>>;
const Faces kTetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
const Faces kOctahedron{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                        {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
const Faces kBox{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                 {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

NodePtr leaf_of(std::vector<glm::dvec3> points, const Faces& faces, uint8_t fill) {
  auto mesh = std::make_shared<PolygonMesh>();
  mesh->points = std::move(points);
  for (const auto& face : faces) mesh->add_face(face);
  mesh->fill = static_cast<csgrun::FillRule>(fill % 3);
  csgrun::weld_points(*mesh);
  if (!csgrun::check_mesh(*mesh).ok()) return Node::empty();
  if (csgrun::signed_volume(*mesh) < 0) csgrun::reverse_faces(*mesh);
  return Node::leaf(std::move(mesh));
}

NodePtr box(Decoder& in) {
  const glm::dvec3 a = point(in), b = point(in);
  if (a.x == b.x || a.y == b.y || a.z == b.z) return Node::empty();
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? std::max(a.x, b.x) : std::min(a.x, b.x),
                         i & 2 ? std::max(a.y, b.y) : std::min(a.y, b.y),
                         i & 4 ? std::max(a.z, b.z) : std::min(a.z, b.z));
  return leaf_of(std::move(corners), kBox, 0);
}

NodePtr free_surface(Decoder& in, const Faces& faces, size_t count) {
  std::vector<glm::dvec3> points;
  const uint8_t fill = in.byte();
  for (size_t i = 0; i < count; ++i) points.push_back(point(in));
  return leaf_of(std::move(points), faces, fill);
}

/// A signed permutation with a translation, or a shear: all keep the grid.
csgrun::Affine map(Decoder& in) {
  constexpr std::array<std::array<int, 3>, 6> kOrders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  const uint8_t what = in.byte();
  csgrun::Affine result;
  for (size_t row = 0; row < 3; ++row) {
    result.m[row] = {0, 0, 0, static_cast<double>(in.integer(-kReach, kReach))};
    const bool mirrored = (what / 6 >> row & 1) != 0;
    result.m[row][static_cast<size_t>(kOrders[what % 6][row])] = mirrored ? -1 : 1;
  }
  if (what >= 192) result.m[what % 3][(what / 3) % 3] += 1;
  return result;
}

/// Reverse Polish: leaves push, maps and hulls change the top, Booleans take the two or three
/// above.
NodePtr decode(Decoder& in) {
  std::vector<NodePtr> stack;
  size_t leaves = 0;
  while (!in.done() && leaves <= kMostLeaves) {
    const uint8_t what = in.byte();
    switch (what % 8) {
      case 0:
      case 1:
        stack.push_back(box(in));
        ++leaves;
        break;
      case 2:
        stack.push_back(free_surface(in, kTetrahedron, 4));
        ++leaves;
        break;
      case 3:
        stack.push_back(free_surface(in, what & 8 ? kOctahedron : kBox, what & 8 ? 6 : 8));
        ++leaves;
        break;
      case 4:
        if (!stack.empty()) stack.back() = Node::transformed(map(in), stack.back());
        break;
      case 5:
        if (!stack.empty() && leaves < kMostLeaves) {
          stack.push_back(stack[in.choose(static_cast<uint32_t>(stack.size()))]);  // shared
          ++leaves;
        }
        break;
      case 6:
        if (!stack.empty() && (what & 192) == 192) {
          const csgrun::OuterHull hull{(what & 8) != 0, (what & 16) != 0};
          stack.back() = Node::outer_hull(hull, stack.back());
          break;
        }
        [[fallthrough]];
      default: {
        const size_t take = std::min<size_t>(what & 32 ? 3 : 2, stack.size());
        if (take < 2) break;
        std::vector<NodePtr> operands(stack.end() - static_cast<std::ptrdiff_t>(take), stack.end());
        stack.resize(stack.size() - take);
        stack.push_back(Node::boolean(static_cast<BooleanOp>(what / 8 % 4), std::move(operands)));
      }
    }
  }
  if (stack.empty()) return Node::empty();
  return stack.size() == 1 ? stack[0] : Node::boolean(BooleanOp::kSymmetricDifference, stack);
}

csgrun::EvaluateOptions options_of(uint8_t variant) {
  csgrun::EvaluateOptions options;
  options.threads = 1;
  options.cache_bytes = 1 << 20;
  options.grid.numerator = 1;
  constexpr std::array<uint32_t, 4> kLimits{1, 3, 9, 40};
  if (variant > 0) {
    options.cell_limit = kLimits[variant % 4];
    options.octree_shift = {variant / 4u % 4, variant / 16u % 4, variant / 64u % 4};
  }
  return options;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  Decoder in(data, size);
  const uint8_t variant = in.byte();
  const NodePtr tree = decode(in);

  std::array<EvaluateOptions, 4> ways{options_of(0), options_of(variant), options_of(0),
                                      options_of(variant)};
  ways[2].literal_cells = true;
  ways[3].flatten = false;
  const auto expected = Evaluator(ways[0]).evaluate(tree);
  if (expected) {
    fuzz::expect_closed(**expected);
  } else {
    fuzz::expect_users_fault(expected.error());
  }
  for (size_t i = 1; i < ways.size(); ++i) {
    const std::string way = "way " + std::to_string(i);
    const auto other = Evaluator(ways[i]).evaluate(tree);
    fuzz::expect(expected.has_value() == other.has_value(), way + " ends otherwise");
    if (!expected) continue;
    const Solid &a = **expected, &b = **other;
    fuzz::expect(a.canonical_hash == b.canonical_hash, way + " has another hash");
    fuzz::expect(a.positions == b.positions && a.triangles == b.triangles,
                 way + " has other triangles");
  }
  return 0;
}

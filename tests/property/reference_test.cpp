// The reference itself: against truths in closed form, which must notice each of its deliberate
// faults; and its eye for claims that are wrong.
#include "tests/support/reference/reference.h"

#include <gtest/gtest.h>

#include "tests/support/fuzz/case.h"
#include "tests/support/fuzz/check.h"
#include "tests/support/fuzz/maker.h"
#include "tests/support/fuzz/truth.h"
#include "tests/support/kernel_checks.h"
#include "tests/support/random_frames.h"
#include "tests/support/random_solids.h"

namespace csgrun::reference_test {
namespace {

using namespace test;  // NOLINT: a test
using reference::Fault;
using reference::Measured;

FuzzLeaf plain(std::vector<Loop> faces) {
  FuzzLeaf l;
  l.faces = std::move(faces);
  return l;
}
FuzzNode mention(int leaf) {
  FuzzNode n;
  n.leaf = leaf;
  return n;
}
FuzzNode apply(BooleanOp op, std::vector<FuzzNode> children) {
  FuzzNode n;
  n.op = op;
  n.children = std::move(children);
  return n;
}

// --- Boxes on unit cells: membership, volume, and the area by plane, side and leaf, by counting.

constexpr int64_t kSize = 4;

struct Boxes {
  FuzzCase c;
  std::vector<std::array<IVec3, 2>> corners;
};

Boxes random_boxes(Random& random) {
  Boxes b;
  const int64_t n = random.integer(1, 5);
  for (int64_t i = 0; i < n; ++i) {
    IVec3 lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = random.integer(0, kSize - 1);
      hi[k] = random.integer(lo[k] + 1, kSize);
    }
    b.corners.push_back({lo, hi});
    b.c.leaves.push_back(plain(box_loops(lo, hi)));
    b.c.leaves.back().fill = static_cast<FillRule>(random.integer(0, 2));
    FuzzNode next = mention(static_cast<int>(i));
    b.c.tree = i == 0 ? next
                      : apply(static_cast<BooleanOp>(random.integer(0, 3)),
                              random.bits() & 1 ? std::vector<FuzzNode>{b.c.tree, next}
                                                : std::vector<FuzzNode>{next, b.c.tree});
  }
  return b;
}

/// The leaf that gives the boundary between two unit cells its label, or -1: of each node, the
/// first child that has boundary there. All operations here are binary.
int label_between(const Boxes& b, const FuzzNode& n, const IVec3& p, const IVec3& q, bool& at_p,
                  bool& at_q) {
  if (n.leaf >= 0) {
    const auto& [lo, hi] = b.corners[static_cast<size_t>(n.leaf)];
    at_p = at_q = true;
    for (int k = 0; k < 3; ++k) {
      at_p = at_p && lo[k] <= p[k] && p[k] < hi[k];
      at_q = at_q && lo[k] <= q[k] && q[k] < hi[k];
    }
    return at_p != at_q ? n.leaf : -1;
  }
  bool p0, q0, p1, q1;
  const int first = label_between(b, n.children[0], p, q, p0, q0);
  const int second = label_between(b, n.children[1], p, q, p1, q1);
  switch (n.op) {
    case BooleanOp::kUnion:
      at_p = p0 || p1, at_q = q0 || q1;
      break;
    case BooleanOp::kIntersection:
      at_p = p0 && p1, at_q = q0 && q1;
      break;
    case BooleanOp::kDifference:
      at_p = p0 && !p1, at_q = q0 && !q1;
      break;
    default:
      at_p = p0 != p1, at_q = q0 != q1;
      break;
  }
  return at_p == at_q ? -1 : first >= 0 ? first : second;
}

/// Empty when the reference measures what the count says.
std::string boxes_differ(const Boxes& b, Fault fault) {
  const Truth truth = truth_of(b.c);
  const Measured m = reference::measure(truth.leaves, truth.tree, fault);
  if (!m.fault.empty()) return m.fault;
  // The reference counts leaves in the order of their mention.
  std::vector<uint32_t> number(truth.leaves.size());
  for (uint32_t l = 0; l < number.size(); ++l) number[truth.leaves[l].faces[0].label[0]] = l;
  int64_t volume = 0;
  std::map<Measured::Side, mpq_class> areas;
  for (int64_t i = 0; i < (kSize + 2) * (kSize + 2) * (kSize + 2); ++i) {
    const IVec3 q{i % (kSize + 2), i / (kSize + 2) % (kSize + 2), i / (kSize + 2) / (kSize + 2)};
    for (int axis = 0; axis < 3; ++axis) {
      IVec3 p = q;
      --p[axis];
      bool below, above;
      const int label = label_between(b, b.c.tree, p, q, below, above);
      if (axis == 0 && above) ++volume;
      if (label < 0) continue;
      Measured::Side side{{}, below, number[static_cast<size_t>(label)]};
      side.plane.c = {0, 0, 0, -mpz_class(q[axis])};
      side.plane.c[axis] = 1;
      side.plane.axis = axis;
      areas[side] += 1;
    }
  }
  if (m.volume != volume) return "volume";
  if (m.areas.size() != areas.size()) return "number of sides";
  for (auto i = m.areas.cbegin(), j = areas.cbegin(); i != m.areas.end(); ++i, ++j) {
    if (i->first < j->first || j->first < i->first || i->second != j->second) return "areas";
  }
  return "";
}

// --- Volumes that a textbook knows.

struct Known {
  FuzzCase c;
  mpq_class volume;
};

std::vector<Known> known_volumes() {
  std::vector<Known> all;
  const auto add = [&](FuzzCase c, const mpq_class& volume) {
    all.push_back({std::move(c), volume});
  };
  /// Plain and orientation-sensitive, without and with voids kept.
  const auto add_hulls = [&](FuzzCase c, const std::array<mpq_class, 4>& volumes) {
    const FuzzNode child = c.tree;
    for (int i = 0; i < 4; ++i) {
      c.tree = FuzzNode();
      c.tree.hull = OuterHull{(i & 1) != 0, (i & 2) != 0};
      c.tree.children = {child};
      add(c, volumes[static_cast<size_t>(i)]);
    }
  };
  {  // the two tetrahedra of a cube of side 4: the star, and the octahedron that both have
    const auto one = hull_loops({{0, 0, 0}, {4, 4, 0}, {4, 0, 4}, {0, 4, 4}});
    const auto other = hull_loops({{4, 4, 4}, {0, 0, 4}, {0, 4, 0}, {4, 0, 0}});
    FuzzCase c;
    c.leaves = {plain(one), plain(other)};
    const mpq_class volumes[4] = {32, mpq_class(32, 3), mpq_class(32, 3), mpq_class(64, 3)};
    for (int op = 0; op < 4; ++op) {
      c.tree = apply(static_cast<BooleanOp>(op), {mention(0), mention(1)});
      add(c, volumes[op]);
    }
    // The same as one surface that crosses itself.
    FuzzCase both;
    both.leaves = {plain(one)};
    both.leaves[0].faces.insert(both.leaves[0].faces.end(), other.begin(), other.end());
    both.leaves[0].may_cross = true;
    both.tree = mention(0);
    for (const FillRule rule : {FillRule::kNonZero, FillRule::kPositive, FillRule::kEvenOdd}) {
      both.leaves[0].fill = rule;
      add(both, rule == FillRule::kEvenOdd ? volumes[3] : volumes[0]);
    }
    // One of them inside out: +1 and -1 cancel where both are.
    auto turned = other;
    turn_over(turned);
    both.leaves[0].faces = one;
    both.leaves[0].faces.insert(both.leaves[0].faces.end(), turned.begin(), turned.end());
    for (const FillRule rule : {FillRule::kNonZero, FillRule::kPositive, FillRule::kEvenOdd}) {
      both.leaves[0].fill = rule;
      add(both, rule == FillRule::kPositive ? volumes[2] : volumes[3]);
    }
    // From behind one comes into the points that are inside out, and from there no further.
    add_hulls(both, {volumes[0], mpq_class(64, 3), volumes[3], volumes[2]});
  }
  {  // a box with a void
    FuzzCase c;
    auto loops = box_loops({0, 0, 0}, {4, 4, 4}), inner = box_loops({1, 1, 1}, {3, 3, 3});
    turn_over(inner);
    loops.insert(loops.end(), inner.begin(), inner.end());
    c.leaves = {plain(loops)};
    c.tree = mention(0);
    add_hulls(c, {64, 64, 56, 56});
    // The same by a difference, and with something in the void.
    c.leaves = {plain(box_loops({0, 0, 0}, {4, 4, 4})), plain(box_loops({1, 1, 1}, {3, 3, 3})),
                plain(box_loops({1, 2, 1}, {2, 3, 2}))};
    c.tree = apply(BooleanOp::kUnion,
                   {apply(BooleanOp::kDifference, {mention(0), mention(1)}), mention(2)});
    add_hulls(c, {64, 64, 57, 57});
    c.tree = apply(BooleanOp::kDifference, {mention(0), mention(1)});
    c.leaves.pop_back();
    c.leaves[1] = plain(box_loops({1, 1, 1}, {3, 3, 4}));
    add_hulls(c, {52, 52, 52, 52});
  }
  {  // an octahedron whose corners a cube cuts off
    FuzzCase c;
    c.leaves = {
        plain(hull_loops({{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0, -3}})),
        plain(box_loops({-2, -2, -2}, {2, 2, 2}))};
    c.tree = apply(BooleanOp::kIntersection, {mention(0), mention(1)});
    add(c, 36 - 6 * mpq_class(2, 3));
    std::swap(c.leaves[0], c.leaves[1]);
    c.tree = apply(BooleanOp::kDifference, {mention(0), mention(1)});
    add(c, 64 - 32);
    // Squeezed to half its width, mirrored, sheared: by the determinant of the way to the world.
    Frame f;
    f.is_identity = false;
    const int64_t one = int64_t{1} << Frame::kShift;
    f.matrix = {{{-2 * one, 0, 0}, {one, one, 0}, {0, 0, one}}};
    c.frames.push_back(f);
    c.leaves[0].frame = c.leaves[1].frame = 1;
    add(c, 16);
  }
  return all;
}

TEST(Reference, BoxesByCounting) {
  Random random(41);
  const int n = cases(400);
  for (int i = 0; i < n; ++i) {
    const Boxes b = random_boxes(random);
    ASSERT_EQ(boxes_differ(b, Fault::kNone), "") << text(b.c);
  }
}

TEST(Reference, VolumesOfTextbooks) {
  for (const Known& k : known_volumes()) {
    const Truth truth = truth_of(k.c);
    EXPECT_EQ(truth.fault, "") << text(k.c);
    const Measured m = reference::measure(truth.leaves, truth.tree);
    EXPECT_EQ(m.fault, "") << text(k.c);
    EXPECT_EQ(m.volume, k.volume) << text(k.c);
    EXPECT_EQ(check_case(k.c).failure, "") << text(k.c);
  }
}

// Volumes of single solids by their loops; of two, by inclusion and exclusion; in any frame.
TEST(Reference, VolumesOfRandomSolids) {
  Random random(42);
  const int n = cases(150);
  for (int i = 0; i < n; ++i) {
    FuzzCase c;
    if (random.bits() & 1) c.frames.push_back(random_frame(random));
    for (int k = 0; k < 2; ++k) {
      c.leaves.push_back(plain(random_loops(random)));
      c.leaves.back().frame = static_cast<uint32_t>(c.frames.size() - 1);
    }
    mpq_class scale = 1;
    if (c.frames.size() > 1) {
      const ExactMap map(c.frames[1]);
      scale = 0;
      for (int j = 0; j < 3; ++j) {
        const int a = (j + 1) % 3, b = (j + 2) % 3;
        const mpz_class minor =
            map.matrix[1][a] * map.matrix[2][b] - map.matrix[1][b] * map.matrix[2][a];
        scale += map.matrix[0][j] * minor;
      }
      scale = abs(scale) / (map.denominator * map.denominator * map.denominator);
    }
    mpq_class volume[6];
    for (int t = 0; t < 6; ++t) {
      c.tree = t < 4 ? apply(static_cast<BooleanOp>(t), {mention(0), mention(1)}) : mention(t - 4);
      const Truth truth = truth_of(c);
      const Measured m = reference::measure(truth.leaves, truth.tree);
      ASSERT_EQ(m.fault, "");
      volume[t] = m.volume;
    }
    for (int k = 0; k < 2; ++k) {
      const mpq_class six(mpz_class(six_volumes(c.leaves[static_cast<size_t>(k)].faces)));
      ASSERT_EQ(volume[4 + k], six / 6 * scale);
    }
    ASSERT_EQ(volume[0] + volume[1], volume[4] + volume[5]);
    ASSERT_EQ(volume[2], volume[4] - volume[1]);
    ASSERT_EQ(volume[3], volume[0] - volume[1]);
  }
}

TEST(Reference, EveryDeliberateFaultIsNoticed) {
  for (const Fault fault : reference::kFaults) {
    Random random(43);
    bool noticed = false;
    for (int i = 0; i < 200 && !noticed; ++i) {
      noticed = !boxes_differ(random_boxes(random), fault).empty();
    }
    bool noticed_by_volume = false;
    for (const Known& k : known_volumes()) {
      const Truth truth = truth_of(k.c, fault);
      const Measured m = reference::measure(truth.leaves, truth.tree, fault);
      noticed_by_volume |= !m.fault.empty() || m.volume != k.volume;
    }
    EXPECT_TRUE(noticed || noticed_by_volume) << "fault " << static_cast<int>(fault);
    std::printf("fault %d: noticed by boxes: %d, by volumes: %d\n", static_cast<int>(fault),
                noticed, noticed_by_volume);
  }
}

// What is right is accepted, and everything that one can do to it is not.
TEST(Reference, WrongClaimsAreNoticed) {
  Random random(44);
  const int n = cases(150);
  int tried = 0;
  for (int i = 0; i < n; ++i) {
    const FuzzCase c = FuzzMaker(random, {true, false, false}).make();
    const auto result = FuzzEvaluator(c).run();
    ASSERT_TRUE(result) << text(result.error());
    const reference::Claim good = claim_of(**result);
    const Truth truth = truth_of(c);
    ASSERT_EQ(reference::difference(truth.leaves, truth.tree, good), "") << text(c);
    if (good.faces.empty()) continue;
    const auto face =
        static_cast<size_t>(random.integer(0, static_cast<int64_t>(good.faces.size()) - 1));
    const auto refused = [&](const char* what, auto&& change) {
      reference::Claim bad = good;
      change(bad, bad.faces[face]);
      EXPECT_NE(reference::difference(truth.leaves, truth.tree, bad), "") << what << "\n"
                                                                          << text(c);
      ++tried;
    };
    using reference::Claim;
    using reference::Face;
    refused("a face is missing", [&](Claim& b, Face&) {
      b.faces.erase(b.faces.begin() + static_cast<std::ptrdiff_t>(face));
    });
    refused("a face is there twice", [&](Claim& b, Face& f) { b.faces.push_back(Face(f)); });
    refused("a face is turned over", [](Claim&, Face& f) {
      for (auto& loop : f.loops) std::reverse(loop.begin(), loop.end());
    });
    refused("a face from elsewhere", [](Claim&, Face& f) { ++f.label[0]; });
    refused("a face of another facet", [](Claim&, Face& f) { ++f.label[1]; });
    refused("a corner is left out", [](Claim&, Face& f) { f.loops.back().pop_back(); });
    refused("a face is moved", [](Claim& b, Face& f) {
      for (auto& loop : f.loops) {
        for (uint32_t& p : loop) {
          reference::Point moved = b.points[p];
          moved[0] += moved[3];
          p = static_cast<uint32_t>(b.points.size());
          b.points.push_back(moved);
        }
      }
    });
  }
  EXPECT_GT(tried, n);
}

}  // namespace
}  // namespace csgrun::reference_test

// What planes cut of solids, against the faces of solids that end there.
#include <map>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::section_test {
namespace {

using namespace testing;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The area on the left of segments; they must be closed.
double area_of(const std::vector<SectionSegment>& section) {
  double area = 0;
  std::map<std::pair<double, double>, int> ends;
  for (const auto& [from, to, noise] : section) {
    EXPECT_GT(noise, 0);
    EXPECT_NE(from, to);
    area += cross(from, to) / 2;
    ++ends[{from.x, from.y}];
    --ends[{to.x, to.y}];
  }
  for (const auto& [point, balance] : ends) EXPECT_EQ(balance, 0) << point.first << point.second;
  return area;
}

struct Bottom {
  double area = 0;
  size_t edges = 0;
};

/// The faces at a height of what of a solid is above it.
Bottom bottom_of(Evaluator& evaluator, const NodePtr& solid, double z) {
  const SolidPtr above = *evaluator.evaluate(intersect({box({-50, -50, z}, {50, 50, 50}), solid}));
  Bottom bottom;
  for (size_t f = 0; f < above->faces.size(); ++f) {
    const Solid::Face& face = above->faces[f];
    for (uint32_t l = face.first_loop; l < face.first_loop + face.loop_count; ++l) {
      const uint32_t begin = above->loop_starts[l], end = above->loop_starts[l + 1];
      const auto at = [&](uint32_t c) {
        const glm::dvec3& p = above->positions[above->loop_vertices[c < end ? c : begin]];
        return glm::dvec2(p.x, p.y);
      };
      if (above->face_normals[f].z >= 0 || above->positions[above->loop_vertices[begin]].z != z ||
          above->face_normals[f].x != 0 || above->face_normals[f].y != 0) {
        continue;
      }
      bottom.edges += end - begin;
      for (uint32_t c = begin; c < end; ++c) bottom.area -= cross(at(c), at(c + 1)) / 2;
    }
  }
  return bottom;
}

TEST(Section, OfACubeIsItsOutline) {
  Evaluator evaluator{EvaluateOptions()};
  const NodePtr part = cube(4);
  for (const double z : {0.0, 1.0, 3.999}) {
    const auto section = evaluator.section(part, z);
    ASSERT_TRUE(section);
    EXPECT_EQ(section->size(), 4u);
    EXPECT_EQ(area_of(*section), 16);
  }
  for (const double z : {-0.001, 4.0, 1e9, -1e9}) EXPECT_TRUE(evaluator.section(part, z)->empty());
  EXPECT_TRUE(evaluator.section(subtract({part, part}), 1)->empty());
  EXPECT_FALSE(evaluator.section(part, HUGE_VAL));
}

// Faces of different leaves that lie in one plane are one side of the section.
TEST(Section, HasOneSegmentForAPlane) {
  Evaluator evaluator{EvaluateOptions()};
  const NodePtr part = unite({cube(4), moved(4, 0, 0, cube(4)), moved(2, 0, 2, cube(4))});
  EXPECT_EQ(evaluator.section(part, 1)->size(), 4u);
  EXPECT_EQ(evaluator.section(part, 3)->size(), 4u);
  // Two that are apart have two segments in the plane.
  const NodePtr apart = unite({cube(4), moved(5, 0, 0, cube(4))});
  EXPECT_EQ(evaluator.section(apart, 1)->size(), 8u);
}

TEST(Section, IsTheBottomOfWhatIsAbove) {
  std::mt19937 random(17);
  const auto number = [&](double from, double to) {
    return from + (to - from) * static_cast<double>(random() % 4096) / 4096;  // on the grid below
  };
  size_t found = 0;
  for (int round = 0; round < 60; ++round) {
    const auto body = [&] {
      const NodePtr base = random() % 2 == 0 ? cube(1 + random() % 4)
                                             : prism(3 + random() % 6, number(1, 3), number(1, 5));
      const NodePtr there = moved(random() % 4, random() % 4, random() % 4, base);
      if (random() % 3 != 0) return there;
      Affine turn;  // 3-4-5, about X or Z
      if (random() % 2 == 0) {
        turn.m = {{{0.6, -0.8, 0, number(0, 2)}, {0.8, 0.6, 0, 0}, {0, 0, 1, 0}}};
      } else {
        turn.m = {{{1, 0, 0, 0}, {0, 0.6, -0.8, 0}, {0, 0.8, 0.6, number(0, 2)}}};
      }
      return Node::transformed(turn, there);
    };
    NodePtr part = body();
    for (size_t i = 0, count = 2 + random() % 5; i < count; ++i) {
      const size_t kind = random() % 5;
      part = kind < 2   ? unite({part, body()})
             : kind < 4 ? subtract({part, body()})
                        : symmetric({part, body()});
    }
    EvaluateOptions options;
    options.grid = *GridStep::parse("2^-20mm");  // heights are on it
    options.whole_faces = round % 4 != 0;
    Evaluator evaluator(options);
    for (const double z :
         {1.0, 2.0, number(0, 5), number(0, 5), static_cast<double>(random() % 6)}) {
      const auto section = evaluator.section(part, z);
      ASSERT_TRUE(section) << section.error().message;
      const Bottom bottom = bottom_of(evaluator, part, z);
      EXPECT_NEAR(area_of(*section), bottom.area, 1e-5) << "round " << round << ", z " << z;
      EXPECT_LE(section->size(), bottom.edges);
      found += section->empty() ? 0 : 1;
    }
    if (HasFailure()) FAIL() << "round " << round;
  }
  EXPECT_GT(found, 150u);
}

// However the boundary was come by.
TEST(Section, OfChainsIsThatOfAFreshEvaluation) {
  std::mt19937 random(18);
  Evaluator evaluator{EvaluateOptions()};
  NodePtr part = cube(10);
  for (int step = 0; step < 30; ++step) {
    const auto at = [&] { return static_cast<double>(random() % 31) / 3; };
    const double x = at(), y = at(), z = at(), height = at();
    part = subtract({part, moved(x, y, z, prism(7, 1.5, 3))});
    ASSERT_TRUE(evaluator.extent(part));
    const auto section = evaluator.section(part, height);
    Evaluator fresh{EvaluateOptions()};
    const auto again = fresh.section(part, height);
    ASSERT_TRUE(section && again);
    const auto sorted = [](const std::vector<SectionSegment>& all) {
      std::vector<std::array<double, 5>> result;
      for (const auto& [a, b, noise] : all) result.push_back({a.x, a.y, b.x, b.y, noise});
      std::sort(result.begin(), result.end());
      return result;
    };
    EXPECT_EQ(sorted(*section), sorted(*again)) << step;
  }
}

}  // namespace
}  // namespace csgrun::section_test

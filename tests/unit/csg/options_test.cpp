// What evaluations refuse of options and appearances, and how they are stopped.
#include <atomic>
#include <limits>

#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>

#include "test_meshes.h"

namespace csgrun::options_test {
namespace {

using namespace testing;

TEST(Options, StepsMadeByHandAreAsParsedOnes) {
  const auto problem = [](int64_t numerator, int64_t denominator, int exponent) {
    return GridStep{numerator, denominator, exponent}.problem();
  };
  EXPECT_EQ(problem(0, 1, 0), "");
  for (const char* text : {"0.001", "1e-3mm", "2^-20mm", "0.1", "3", "7e5", "0.0000127"}) {
    const auto step = GridStep::parse(text);
    ASSERT_TRUE(step) << text;
    EXPECT_EQ(step->problem(), "") << text;
  }
  EXPECT_EQ(problem(1, 0, 0), "is not positive");
  EXPECT_EQ(problem(-1, 1000, 0), "is not positive");
  EXPECT_EQ(problem(1, -1, 0), "is not positive");
  EXPECT_EQ(problem(1, 1000, 0), "is not in lowest terms");  // 1 / 125 * 2^-3
  EXPECT_EQ(problem(1, 125, -3), "");
  EXPECT_EQ(problem(3, 9, 0), "is not in lowest terms");
  EXPECT_EQ(problem(1, 1, 201), "is out of range");
  EXPECT_EQ(problem(1, 1, std::numeric_limits<int>::max()), "is out of range");
  EXPECT_EQ(problem(1, 1, std::numeric_limits<int>::min()), "is out of range");
  EXPECT_EQ(problem((int64_t{1} << 53) + 1, 1, 0), "has too many digits");

  EvaluateOptions options;
  options.grid = {1, 1000, 0};
  Evaluator evaluator(options);
  const auto solid = evaluator.evaluate(cube(1));
  ASSERT_FALSE(solid);
  EXPECT_EQ(solid.error().code, ErrorCode::kInvalidArgument);
  EXPECT_NE(solid.error().message.find("lowest terms"), std::string::npos);
  EXPECT_EQ(evaluator.extent(cube(1)).error().code, ErrorCode::kInvalidArgument);
}

TEST(Options, NumbersOfAppearancesAreFromZeroToOne) {
  const auto code_of = [](const NodePtr& node) {
    Evaluator evaluator({});
    const auto solid = evaluator.evaluate(node);
    return solid ? ErrorCode{} : solid.error().code;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (float Appearance::*part :
       {&Appearance::red, &Appearance::green, &Appearance::blue, &Appearance::alpha,
        &Appearance::metallic, &Appearance::roughness}) {
    for (const float bad : {nan, -0.25f, 1.25f, 255.0f, std::numeric_limits<float>::infinity()}) {
      Appearance appearance;
      appearance.*part = bad;
      EXPECT_EQ(code_of(Node::painted(appearance, cube(1))), ErrorCode::kInvalidArgument);
      PolygonMesh mesh = *cube(1)->mesh();
      mesh.appearances = {appearance};
      mesh.appearance_of.assign(mesh.face_count(), 0);
      EXPECT_EQ(code_of(Node::leaf(std::make_shared<const PolygonMesh>(mesh))),
                ErrorCode::kInvalidMesh);
    }
    for (const float good : {0.0f, -0.0f, 1.0f}) {
      Appearance appearance;
      appearance.*part = good;
      EXPECT_EQ(code_of(Node::painted(appearance, cube(1))), ErrorCode{});
    }
  }
}

TEST(Options, OpenLeavesAreRefusedWithPlaces) {
  PolygonMesh mesh = *cube(2)->mesh();
  mesh.face_starts.pop_back();
  mesh.loop_starts.pop_back();
  mesh.corners.resize(mesh.loop_starts.back());
  mesh.surface.resize(mesh.face_count());
  mesh.kind = "lid";
  const SourceRef where{std::make_shared<const std::string>("box.cpp"), 12};
  Evaluator evaluator({});
  const auto solid = evaluator.evaluate(leaf(mesh, FillRule::kNonZero, where));
  ASSERT_FALSE(solid);
  EXPECT_EQ(solid.error().code, ErrorCode::kInvalidMesh);
  EXPECT_EQ(solid.error().where.text(), "box.cpp:12");
  EXPECT_EQ(solid.error().message.rfind("'lid' is not closed: 4 open edges (first: (", 0), 0u)
      << solid.error().message;
}

/// Stopped at any time that it tells how far it is, an evaluation gives no result.
TEST(Options, WhatIsCancelledGivesNoResult) {
  const auto stopped_at = [](int call, int& calls) {
    std::atomic<bool> cancel = false;
    EvaluateOptions options;
    options.threads = 1;
    options.cancel = &cancel;
    calls = 0;
    options.progress = [&](uint64_t, uint64_t) { cancel = ++calls == call || cancel; };
    Evaluator evaluator(options);
    return evaluator.evaluate(subtract({prism(2000, 4, 4), turned(40, {1, 1, 0}, cube(5))}));
  };
  int calls = 0;
  EXPECT_TRUE(stopped_at(-1, calls));
  const int all = calls;
  ASSERT_GT(all, 0);
  for (int call = 1; call <= all; ++call) {
    const auto solid = stopped_at(call, calls);
    ASSERT_FALSE(solid) << call << " of " << all;
    EXPECT_EQ(solid.error().code, ErrorCode::kCancelled);
  }
}

}  // namespace
}  // namespace csgrun::options_test

// Meshes refined, smoothed and bent, level sets, rounded boxes: closed forms and closedness.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <csgrun/engine/evaluate.h>
#include <csgrun/engine/validate.h>
#include <csgrun/primitives/freeform.h>

namespace csgrun::freeform_test {
namespace {

SolidPtr evaluated(PolygonMesh mesh) {
  Evaluator evaluator(EvaluateOptions{});
  auto solid = evaluator.evaluate(Node::leaf(std::make_shared<PolygonMesh>(std::move(mesh))));
  EXPECT_TRUE(solid) << solid.error().message;
  return solid ? *solid : std::make_shared<Solid>();
}

PolygonMesh box(double x, double y, double z) {
  return mesh_of_solid(*evaluated(*make_cube({x, y, z})), "box");
}

double longest_edge(const PolygonMesh& mesh) {
  double longest = 0;
  for (size_t f = 0; f < mesh.face_count(); ++f) {
    for (size_t i = 0; i < 3; ++i) {
      const glm::dvec3 a = mesh.points[mesh.corners[3 * f + i]];
      const glm::dvec3 b = mesh.points[mesh.corners[3 * f + (i + 1) % 3]];
      longest = std::max(longest, glm::length(b - a));
    }
  }
  return longest;
}

TEST(Refine, DividesAndKeepsTheSolid) {
  for (const double length : {20.0, 4.0, 1.5, 0.7}) {
    const auto mesh = refine_mesh(box(8, 4, 2), length);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_LE(longest_edge(*mesh), length);
    EXPECT_TRUE(check_mesh(*mesh).ok()) << check_mesh(*mesh).text();
    EXPECT_EQ(signed_volume(*mesh), 64);
  }
  EXPECT_EQ(refine_mesh(box(8, 4, 2), 20)->face_count(), 12u);
  EXPECT_EQ(refine_mesh(box(1, 1, 1), 0).error().message, "refine: length must be positive, got 0");
  EXPECT_EQ(refine_mesh(box(1, 1, 1), 1e-6).error().code, ErrorCode::kLimit);
  // Ten halvings of ten millimetres, each with four triangles for one: 12 x 4^10 / 2 points.
  EXPECT_EQ(refine_mesh(box(10, 10, 10), 0.01).error().message,
            "refine: makes more than 4194304 points");
}

/// An octahedron: each corner has four neighbours whose mean is the centre, each edge two corners
/// beside it whose mean is the centre, too.
TEST(Smooth, OfAnOctahedron) {
  PolygonMesh mesh;
  mesh.points = {{8, 0, 0}, {-8, 0, 0}, {0, 8, 0}, {0, -8, 0}, {0, 0, 8}, {0, 0, -8}};
  for (const auto& f : std::vector<std::array<uint32_t, 3>>{{0, 2, 4},
                                                            {2, 1, 4},
                                                            {1, 3, 4},
                                                            {3, 0, 4},
                                                            {2, 0, 5},
                                                            {1, 2, 5},
                                                            {3, 1, 5},
                                                            {0, 3, 5}}) {
    mesh.add_face(f);
    mesh.appearance_of.push_back(0);
  }
  mesh.appearances.emplace_back();
  const auto smoothed = smooth_mesh(mesh, 1);
  ASSERT_TRUE(smoothed);
  EXPECT_EQ(smoothed->face_count(), 32u);
  EXPECT_EQ(smoothed->points[0], glm::dvec3(8 * 5.0 / 8, 0, 0));
  for (size_t p = 6; p < smoothed->points.size(); ++p) {
    EXPECT_EQ(glm::dot(glm::abs(smoothed->points[p]), glm::dvec3(1)), 6);  // 3/8 of 8 twice
  }
  const auto again = smooth_mesh(mesh, 3);
  EXPECT_TRUE(check_mesh(*again).ok());
  EXPECT_GT(signed_volume(*again), 0);
  EXPECT_LT(signed_volume(*again), signed_volume(mesh));
  EXPECT_EQ(smooth_mesh({}, 1000000000)->face_count(), 0u);
  EXPECT_EQ(smooth_mesh(mesh, 0).error().message, "smooth: rounds must be at least 1");
}

TEST(Warp, MovesPoints) {
  const auto sheared = warp_mesh(box(2, 2, 2), [](const glm::dvec3& p) {
    return Result<glm::dvec3>(glm::dvec3(p.x + p.z, p.y, 3 * p.z));
  });
  ASSERT_TRUE(sheared);
  EXPECT_EQ(signed_volume(*sheared), 24);
  const auto mirrored = warp_mesh(box(2, 2, 2), [](const glm::dvec3& p) {
    return Result<glm::dvec3>(glm::dvec3(-p.x, p.y, p.z));
  });
  EXPECT_EQ(signed_volume(*mirrored), 8);  // turned over
  // Two lobes that cancel in the sum: what is there is for the fill rule to say.
  const auto lobes = warp_mesh(box(2, 2, 2), [](const glm::dvec3& p) {
    return Result<glm::dvec3>(glm::dvec3(p.x * (p.z - 1), p.y, p.z));
  });
  ASSERT_TRUE(lobes);
  EXPECT_EQ(signed_volume(*lobes), 0);
}

LevelSetOptions options(double reach, double step) {
  LevelSetOptions result;
  result.low = glm::dvec3(-reach);
  result.high = glm::dvec3(reach);
  result.step = step;
  return result;
}

TEST(LevelSet, OfABall) {
  const auto ball = [](const glm::dvec3& p) { return Result<double>(glm::length(p) - 8); };
  double before = 1;
  for (const double step : {2.0, 1.0, 0.5}) {
    const auto mesh = make_level_set(ball, options(9, step));
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(check_mesh(*mesh).ok()) << check_mesh(*mesh).text();
    const double error = std::fabs(signed_volume(*mesh) / (4.0 / 3 * 3.14159265358979 * 512) - 1);
    EXPECT_LT(error, before / 3);  // falls with the square of the step
    before = error;
    const SolidPtr solid = evaluated(*mesh);
    EXPECT_EQ(solid->measures.components, 1);
    EXPECT_EQ(solid->measures.genus, 0);
    EXPECT_NEAR(solid->measures.volume, signed_volume(*mesh), 1e-3);
  }
}

/// A plane is met exactly by straight lines between samples; samples on it are 0.
TEST(LevelSet, OfPlanesAndSamplesOnTheSurface) {
  const auto half = [](const glm::dvec3& p) { return Result<double>(p.z - 0.25); };
  const auto mesh = make_level_set(half, options(2, 1));
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(check_mesh(*mesh).ok());
  EXPECT_NEAR(signed_volume(*mesh), 16 * 2.25, 1e-12);
  const auto cube = [](const glm::dvec3& p) {
    return Result<double>(std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) - 1);
  };
  const auto touching = make_level_set(cube, options(3, 1));
  ASSERT_TRUE(touching);
  EXPECT_TRUE(check_mesh(*touching).ok());
  EXPECT_NEAR(signed_volume(*touching), 8, 1e-12);  // its corners lie on the lattice
  const auto all = make_level_set([](const glm::dvec3&) { return Result<double>(-1.0); },
                                  options(1.5, 1));  // cut off at the bounds
  ASSERT_TRUE(all);
  EXPECT_TRUE(check_mesh(*all).ok());
  EXPECT_NEAR(signed_volume(*all), 27, 1e-12);
  const auto nothing = [](const glm::dvec3&) { return Result<double>(1.0); };
  EXPECT_EQ(make_level_set(nothing, options(2, 1))->face_count(), 0u);
  EXPECT_EQ(make_level_set(nothing, options(200, 0.01)).error().code, ErrorCode::kLimit);
  // One flat layer alone would take gigabytes.
  EXPECT_EQ(make_level_set(nothing, {{0, 0, 0}, {8000, 8000, 1}, 1}).error().message,
            "levelset: the bounds hold more than 8388608 samples of one height at this step");
  EXPECT_EQ(make_level_set(nothing, options(2, -1)).error().message,
            "levelset: step must be positive, got -1");
}

/// Samples that are 0 but for rounding. Each function has all its values with either sign at as
/// many places, so the solid is half of what it is cut from, or it has a volume that is known.
TEST(LevelSet, OfSamplesThatAreNoise) {
  struct Case {
    std::function<double(const glm::dvec3&)> f;
    LevelSetOptions options;
    double volume, tolerance;
  };
  const auto sine = [](double turns) { return std::sin(2 * 3.14159265358979323846 * turns); };
  const auto cosine = [](double turns) { return std::cos(2 * 3.14159265358979323846 * turns); };
  const auto gyroid = [=](const glm::dvec3& p) {
    const glm::dvec3 t = p / 10.0;
    return sine(t.x) * cosine(t.y) + sine(t.y) * cosine(t.z) + sine(t.z) * cosine(t.x);
  };
  const auto sines = [=](const glm::dvec3& p) {
    return sine(p.x / 9) + sine(p.y / 9) + sine(p.z / 9);
  };
  const LevelSetOptions small{{-1, -1, -1}, {1, 1, 1}, 0.1};
  const Case cases[] = {
      {gyroid, {{0, 0, 0}, {10, 10, 10}, 1}, 500, 1e-9},
      {sines, {{0, 0, 0}, {9, 9, 9}, 1}, 364.5, 1e-9},
      {[](const glm::dvec3& p) { return p.x - 0.3; }, small, 5.2, 1e-9},
      {[](const glm::dvec3& p) { return p.x + 1e-17; }, small, 4, 1e-9},
      {[](const glm::dvec3& p) { return p.x > 0.01 ? 1e308 : -1e308; }, small, 4.2, 1e-9},
      {[](const glm::dvec3& p) {
         return std::max(std::hypot(p.x, p.y) - 0.5, std::fabs(p.z) - 0.8);
       },
       small, 1.6 * 3.14159265 * 0.25, 0.03},
  };
  for (const Case& c : cases) {
    const auto mesh =
        make_level_set([&](const glm::dvec3& p) { return Result<double>(c.f(p)); }, c.options);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(check_mesh(*mesh).ok()) << check_mesh(*mesh).text();
    EXPECT_NEAR(signed_volume(*mesh), c.volume, c.tolerance);
    EXPECT_NEAR(evaluated(*mesh)->measures.volume, c.volume, c.tolerance + 1e-4);
  }
}

TEST(Rounded, HaveTheirExtents) {
  const double pi = 3.14159265358979;
  const SolidPtr cube = evaluated(*make_rounded_cube({10, 20, 30}, 2, {true, false, false}, {64}));
  EXPECT_EQ(cube->measures.bbox[0], glm::dvec3(-5, 0, 0));
  EXPECT_EQ(cube->measures.bbox[1], glm::dvec3(5, 20, 30));
  // Steiner's formula for the box inside, grown by a ball.
  const glm::dvec3 s(6, 16, 26);
  const double steiner = s.x * s.y * s.z + 2 * 2 * (s.x * s.y + s.y * s.z + s.z * s.x) +
                         pi * 4 * (s.x + s.y + s.z) + 4.0 / 3 * pi * 8;
  EXPECT_NEAR(cube->measures.volume / steiner, 1, 1e-3);
  EXPECT_LT(cube->measures.volume, steiner);
  const SolidPtr ball = evaluated(*make_rounded_cube({2, 2, 2}, 1, {}, {8}));
  EXPECT_EQ(ball->measures.bbox[1], glm::dvec3(2));
  const SolidPtr pill = evaluated(*make_rounded_cylinder(10, 3, 3, true, {96}));
  EXPECT_EQ(pill->measures.bbox[1].z, 5);
  EXPECT_NEAR(pill->measures.volume / (pi * 9 * 4 + 4.0 / 3 * pi * 27), 1, 5e-3);
  EXPECT_EQ(make_rounded_cube({2, 4, 6}, 1.5, {}, {8}).error().message,
            "cube: r must be at most half of the shortest side, 1, got 1.5");
  EXPECT_EQ(make_rounded_cylinder(2, 4, 1.5, false, {8}).error().message,
            "cylinder: round must be at most r and half of h, 1, got 1.5");
}

}  // namespace
}  // namespace csgrun::freeform_test

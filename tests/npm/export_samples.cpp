// Writes models for the validators: what the writers find hard, and in `faulty` files that are
// wrong.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

#include <csgrun/export/write.h>

#include "tests/unit/export/hand_made.h"

namespace {

using csgrun::testing::HandMade;

csgrun::Appearance colour(float red, float green, float blue, float alpha) {
  csgrun::Appearance a;
  a.red = red;
  a.green = green;
  a.blue = blue;
  a.alpha = alpha;
  a.is_default = false;
  return a;
}

csgrun::SolidPtr coloured_boxes() {
  HandMade made;
  const auto red = made.appearance(colour(0.9f, 0.1f, 0.1f, 1));
  const auto glass = made.appearance(colour(0.2f, 0.5f, 0.9f, 0.3f));
  made.box({0, 0, 0}, {0.1, 0.2, 0.3}, red);
  made.box({10, 0, 0}, {10.3, 0.7, 12345.678}, glass);
  made.box({-3, -3, -3}, {-2, -2, -2});
  return made.share();
}

csgrun::SolidPtr wheel(int corners) {
  std::vector<std::pair<double, double>> outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / corners;
    outline.emplace_back(20 * std::cos(angle), 20 * std::sin(angle));
  }
  HandMade made;
  made.prism(outline, 5, 1);
  return made.share();
}

bool write(const std::filesystem::path& path, const std::vector<csgrun::Part>& parts) {
  const auto report = csgrun::write_model(path.string(), parts);
  if (!report) std::cerr << report.error().message << '\n';
  return report.has_value();
}

/// Overwrites the first occurrence of `from` in a file by `to`, of the same length.
void corrupt(const std::filesystem::path& path, const std::string& from, const std::string& to) {
  std::ifstream in(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  bytes.replace(bytes.find(from), from.size(), to);
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "faulty");
  csgrun::Affine moved, turned;
  moved.m[0][3] = 100;
  turned.m = {{{0.8, -0.6, 0, 5}, {0.6, 0.8, 0, 6}, {0, 0, 1, 7}}};
  csgrun::Affine mirrored, sheared;
  mirrored.m[2][2] = -1;
  sheared.m[0][1] = 0.5;
  HandMade sheet;
  sheet.box({100, 0, 0}, {100 + 1e-9, 1, 1});
  const auto cube = csgrun::testing::cube(10);

  bool good = write(folder / "cube.glb", {{"cube", cube, {}}});
  good &= write(folder / "cube.gltf", {{"cube", cube, {}}});
  good &= write(folder / "colours.glb", {{"colours", coloured_boxes(), {}}});
  good &= write(folder / "wheel.glb", {{"wheel", wheel(64), {}}});
  good &= write(folder / "large.glb", {{"large", wheel(40000), {}}});
  good &=
      write(folder / "touching.glb", {{"touching", csgrun::testing::edge_touching_cubes(), {}}});
  good &= write(folder / "dumbbell.glb", {{"dumbbell", csgrun::testing::dumbbell(0.25), {}}});
  good &= write(folder / "collapsed.glb", {{"collapsed", csgrun::testing::dumbbell(1e-9), {}}});
  good &= write(folder / "parts.glb", {{"case/lid", cube, {}},
                                       {"case/box", cube, moved},
                                       {"turned", cube, turned},
                                       {"mirrored", cube, mirrored},
                                       {"sheared", cube, sheared},
                                       {"vanished", sheet.share(), {}}});
  good &= write(folder / "nothing.glb", {{"vanished", sheet.share(), {}}});

  good &= write(folder / "faulty" / "bounds.glb", {{"cube", cube, {}}});
  corrupt(folder / "faulty" / "bounds.glb", "[10.0,", "[11.0,");
  good &= write(folder / "faulty" / "manifold.glb", {{"cube", cube, {}}});
  corrupt(folder / "faulty" / "manifold.glb", "mergeIndices", "mergeNothing");
  return good ? 0 : 1;
}

// Meshes of any kind, also such as no file can describe: the checks of leaves, their repair, and
// what follows.
#include <array>
#include <limits>
#include <memory>

#include <csgrun/engine/repair.h>
#include <csgrun/engine/validate.h>
#include <csgrun/primitives/mesh_file.h>

#include "tests/fuzz/decoder.h"
#include "tests/fuzz/evaluate_small.h"

namespace {

using csgrun::fuzz::Decoder;

double coordinate(Decoder& in) {
  const uint8_t byte = in.byte();
  constexpr std::array<double, 8> kOdd{0.1,
                                       -0.0,
                                       1e300,
                                       -1e-300,
                                       0x1p-1074,
                                       std::numeric_limits<double>::infinity(),
                                       std::numeric_limits<double>::quiet_NaN(),
                                       1e12};
  return byte < 240 ? byte % 4 : kOdd[byte % kOdd.size()];
}

csgrun::PolygonMesh decode(Decoder& in) {
  csgrun::PolygonMesh mesh;
  const uint32_t points = in.choose(16);
  for (uint32_t i = 0; i < points; ++i) {
    const double x = coordinate(in), y = coordinate(in), z = coordinate(in);
    mesh.points.emplace_back(x, y, z);
  }
  const auto corner = [&] {
    const uint8_t byte = in.byte();
    if (byte == 255) return UINT32_MAX;
    return points == 0 ? 0u : byte % (points + (byte >= 250 ? 1 : 0));
  };
  while (!in.done() && mesh.face_count() < 40) {
    const uint8_t shape = in.byte();
    if (shape == 255) {  // lists that do not fit together
      mesh.loop_starts.push_back(in.byte());
      mesh.face_starts.push_back(in.byte());
      continue;
    }
    const uint32_t loops = 1 + (shape % 8 == 7 ? 1 : 0);
    for (uint32_t l = 0; l < loops; ++l) {
      for (uint32_t n = shape / 8 % 8 == 0 ? 3 : shape / 8 % 8; n > 0; --n)
        mesh.corners.push_back(corner());
      mesh.loop_starts.push_back(static_cast<uint32_t>(mesh.corners.size()));
    }
    mesh.face_starts.push_back(static_cast<uint32_t>(mesh.loop_count()));
    mesh.surface.push_back(shape == 200 ? 1 : 0);
  }
  return mesh;
}

csgrun::RepairOptions repair_options(uint8_t byte) {
  csgrun::RepairOptions options;
  constexpr std::array<double, 4> kDistances{0, 1e-6, 0.5, 2};
  options.weld = kDistances[byte % 4];
  options.drop_degenerate = (byte & 4) == 0;
  options.drop_duplicates = (byte & 8) == 0;
  options.orient = (byte & 16) == 0;
  options.fill_holes = (byte & 32) != 0;
  return options;
}

void use(csgrun::PolygonMesh mesh) {
  using namespace csgrun;
  std::string note;
  auto solid = make_solid_mesh(std::move(mesh), &note);
  if (!solid) {
    fuzz::expect_users_fault(solid.error());
    return;
  }
  fuzz::expect_leaf(*solid);
  fuzz::evaluate_small({Node::leaf(std::make_shared<const PolygonMesh>(*std::move(solid)))});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace csgrun;
  Decoder in(data, size);
  const RepairOptions options = repair_options(in.byte());
  PolygonMesh mesh = decode(in);
  mesh.fill = static_cast<FillRule>(size % 3);
  const MeshReport report = check_mesh(mesh);
  fuzz::expect(report.ok() == report.text().empty(), "a report without words");
  RepairReport repairs;
  auto repaired = repair_mesh(mesh, options, &repairs);
  if (repaired) {
    fuzz::expect_leaf(*repaired);
    for (const RepairStep& step : repairs.steps)
      fuzz::expect(step.count > 0 && !step.text().empty(), "a step that did nothing");
    use(*std::move(repaired));
  } else {
    fuzz::expect_users_fault(repaired.error());
  }
  use(std::move(mesh));
  return 0;
}

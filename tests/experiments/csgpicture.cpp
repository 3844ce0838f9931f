// csgpicture MESH OUT.ppm [options]: a picture of a mesh, for docs/experiments.md.
//
//   --size W H           pixels (480 400)
//   --view TURN TILT     degrees about the up axis and above the horizon (30 20)
//   --zoom X Y Z HEIGHT  what is in the middle, and how much is seen, in shares of the bounding box
//   --cut X Y Z SHARE    cut away what lies beyond this share of the extent along the direction;
//   the
//                        curves of the cut are drawn yellow
//   --cells FILE         boxes (lo, hi in the mesh's units), in which the surface is yellow
//   --curves FILE        a mesh: edges between vertices that it does not have are drawn yellow
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <csgrun/primitives/mesh_file.h>

#include "tests/experiments/picture.h"

namespace csgrun::experiments {
namespace {

constexpr Colour kFront{0.62, 0.70, 0.80}, kBack{0.80, 0.47, 0.38}, kYellow{1.0, 0.85, 0.1};

[[noreturn]] void fail(const std::string& message) {
  std::fprintf(stderr, "csgpicture: %s\n", message.c_str());
  std::exit(1);
}

PolygonMesh read(const std::string& path) {
  auto mesh = read_mesh_file(path);
  if (!mesh) fail(mesh.error().message);
  return *std::move(mesh);
}

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Boxes that are found by a place: in bins of a regular grid.
class Boxes {
 public:
  explicit Boxes(const std::string& path) {
    std::ifstream file(path);
    if (!file) fail("cannot read " + path);
    Box b;
    while (file >> b.lo.x >> b.lo.y >> b.lo.z >> b.hi.x >> b.hi.y >> b.hi.z) {
      for (int k = 0; k < 3; ++k) bin_ = std::max(bin_, b.hi[k] - b.lo[k]);
      boxes_.push_back(b);
    }
    for (size_t i = 0; i < boxes_.size(); ++i) {
      const Bin lo = bin_of(boxes_[i].lo), hi = bin_of(boxes_[i].hi);
      for (int x = lo[0]; x <= hi[0]; ++x) {
        for (int y = lo[1]; y <= hi[1]; ++y) {
          for (int z = lo[2]; z <= hi[2]; ++z) bins_[{x, y, z}].push_back(i);
        }
      }
    }
  }
  [[nodiscard]] bool hold(const glm::dvec3& p) const {
    const auto found = bins_.find(bin_of(p));
    if (found == bins_.end()) return false;
    return std::any_of(found->second.begin(), found->second.end(), [&](size_t i) {
      const Box& b = boxes_[i];
      return p.x >= b.lo.x && p.y >= b.lo.y && p.z >= b.lo.z && p.x <= b.hi.x && p.y <= b.hi.y &&
             p.z <= b.hi.z;
    });
  }

 private:
  struct Box {
    glm::dvec3 lo{}, hi{};
  };
  using Bin = std::array<int, 3>;
  [[nodiscard]] Bin bin_of(const glm::dvec3& p) const {
    const auto at = [&](double c) { return static_cast<int>(std::floor(c / bin_)); };
    return {at(p.x), at(p.y), at(p.z)};
  }
  std::vector<Box> boxes_;
  double bin_ = 1e-9;
  std::map<Bin, std::vector<size_t>> bins_;
};

struct Request {
  std::string mesh, out, cells, curves;
  int width = 480, height = 400;
  double turn = 30, tilt = 20;
  std::array<double, 4> zoom{0.5, 0.5, 0.5, 0};
  std::optional<std::array<double, 4>> cut;
};

Request parse(int argc, char** argv) {
  Request r;
  if (argc < 3)
    fail("usage: csgpicture MESH OUT.ppm [--size|--view|--zoom|--cut|--cells|--curves]");
  r.mesh = argv[1];
  r.out = argv[2];
  int i = 3;
  const auto next = [&]() -> const char* {
    if (i >= argc) fail("an option's value is missing");
    return argv[i++];
  };
  while (i < argc) {
    const std::string option = next();
    if (option == "--size") {
      r.width = std::atoi(next());
      r.height = std::atoi(next());
    } else if (option == "--view") {
      r.turn = std::atof(next());
      r.tilt = std::atof(next());
    } else if (option == "--zoom") {
      for (double& v : r.zoom) v = std::atof(next());
    } else if (option == "--cut") {
      r.cut.emplace();
      for (double& v : *r.cut) v = std::atof(next());
    } else if (option == "--cells") {
      r.cells = next();
    } else if (option == "--curves") {
      r.curves = next();
    } else {
      fail("unknown option " + option);
    }
  }
  return r;
}

using Triangle = std::array<uint32_t, 3>;

std::vector<Triangle> triangles_of(const PolygonMesh& mesh) {
  std::vector<Triangle> triangles;
  for (size_t l = 0; l < mesh.loop_count(); ++l) {
    for (uint32_t c = mesh.loop_starts[l] + 1; c + 1 < mesh.loop_starts[l + 1]; ++c) {
      triangles.push_back(
          {mesh.corners[mesh.loop_starts[l]], mesh.corners[c], mesh.corners[c + 1]});
    }
  }
  return triangles;
}

/// The edges between points that the other mesh does not have.
void draw_curves(Picture& picture, const PolygonMesh& mesh, const std::vector<Triangle>& triangles,
                 const PolygonMesh& before, const std::optional<CutPlane>& cut) {
  std::set<std::array<double, 3>> known;
  for (const glm::dvec3& p : before.points) known.insert({p.x, p.y, p.z});
  const auto is_new = [&](uint32_t v) {
    const glm::dvec3& p = mesh.points[v];
    return !known.contains({p.x, p.y, p.z}) && !(cut && dot(cut->normal, p) > cut->offset);
  };
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t a = t[k], b = t[(k + 1) % 3];
      if (a < b && is_new(a) && is_new(b)) {
        picture.line(mesh.points[a], mesh.points[b], 1.4, kYellow);
      }
    }
  }
}

/// The curves in which a plane cuts the triangles.
void draw_section(Picture& picture, const PolygonMesh& mesh, const std::vector<Triangle>& triangles,
                  const CutPlane& cut) {
  for (const Triangle& t : triangles) {
    std::vector<glm::dvec3> ends;
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 &a = mesh.points[t[k]], &b = mesh.points[t[(k + 1) % 3]];
      const double da = dot(cut.normal, a) - cut.offset, db = dot(cut.normal, b) - cut.offset;
      if ((da < 0) != (db < 0)) ends.push_back(a + (b - a) * (da / (da - db)));
    }
    if (ends.size() == 2) picture.line(ends[0], ends[1], 1.6, kYellow);
  }
}

void draw(const Request& request) {
  const PolygonMesh mesh = read(request.mesh);
  if (mesh.points.empty()) fail("an empty mesh");
  const std::vector<Triangle> triangles = triangles_of(mesh);
  glm::dvec3 lo(HUGE_VAL), hi(-HUGE_VAL);
  for (const glm::dvec3& p : mesh.points) {
    for (int k = 0; k < 3; ++k) lo[k] = std::min(lo[k], p[k]), hi[k] = std::max(hi[k], p[k]);
  }
  View view;
  view.turn = request.turn;
  view.tilt = request.tilt;
  for (int k = 0; k < 3; ++k) {
    view.middle[k] = lo[k] + (hi[k] - lo[k]) * request.zoom[static_cast<size_t>(k)];
  }
  const glm::dvec3 size = hi - lo;
  const double diagonal = std::sqrt(dot(size, size));
  view.height = diagonal * (request.zoom[3] > 0 ? request.zoom[3] : 1.02);
  std::optional<CutPlane> cut;
  if (request.cut) {
    const auto& c = *request.cut;
    cut = CutPlane{{c[0], c[1], c[2]}, 0};
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (const glm::dvec3& p : mesh.points) {
      least = std::min(least, dot(cut->normal, p));
      most = std::max(most, dot(cut->normal, p));
    }
    cut->offset = least + c[3] * (most - least);
  }
  std::optional<Boxes> boxes;
  if (!request.cells.empty()) boxes.emplace(request.cells);

  Picture picture(request.width, request.height, view);
  for (const Triangle& t : triangles) {
    picture.triangle({mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]}, cut,
                     [&](const glm::dvec3& place, bool back) {
                       if (back) return kBack;
                       return boxes && boxes->hold(place) ? kYellow : kFront;
                     });
  }
  if (cut) draw_section(picture, mesh, triangles, *cut);
  if (!request.curves.empty()) {
    draw_curves(picture, mesh, triangles, read(request.curves), cut);
  }
  if (!picture.write(request.out)) fail("cannot write " + request.out);
}

}  // namespace
}  // namespace csgrun::experiments

int main(int argc, char** argv) {
  csgrun::experiments::draw(csgrun::experiments::parse(argc, argv));
  return 0;
}

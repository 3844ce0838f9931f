// cgal_boolean nef|corefine union|intersection|difference once|each OUT.off IN.off...: the same by
// CGAL, with its Nef polyhedra, which the paper compares itself with, or by corefinement of surface
// meshes with exact points; one mesh after the other. `each` asks for the box and the volume of
// every result, which only corefinement can. One JSON line with the CPU seconds from arrays of
// doubles to CGAL's meshes, of the operation, and from its result to arrays of doubles by CGAL's
// own conversion, as csgbench counts them; and the peak of memory. Files are not counted. Built
// only where CGAL is installed; nothing else needs it.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/boost/graph/helpers.h>
#include <sys/resource.h>
#include <time.h>

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
namespace pmp = CGAL::Polygon_mesh_processing;

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

/// The double nearest to an exact number: CGAL's own conversion may be off by a unit in the last
/// place, which would turn over every tie when it is rounded further.
double nearest(const Kernel::FT& number) {
  const auto& exact = CGAL::exact(number);
  using Exact = std::decay_t<decltype(exact)>;
  const auto distance = [&](double d) { return CGAL::abs(Exact(exact - Exact(d))); };
  const double guess = CGAL::to_double(exact);
  double best = guess;
  for (const double d : {std::nextafter(guess, -HUGE_VAL), std::nextafter(guess, HUGE_VAL)}) {
    if (distance(d) < distance(best)) best = d;
  }
  return best;
}

struct Arrays {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<uint32_t, 3>> triangles;
};

Arrays read(const char* path) {
  Arrays arrays;
  std::ifstream file(path);
  std::string word;
  size_t points = 0, faces = 0, edges = 0, corners = 3;
  file >> word >> points >> faces >> edges;
  arrays.points.resize(file ? points : 0);
  arrays.triangles.resize(file ? faces : 0);
  for (auto& point : arrays.points) file >> point[0] >> point[1] >> point[2];
  for (auto& t : arrays.triangles) {
    if (!(file >> corners >> t[0] >> t[1] >> t[2]) || corners != 3) break;
  }
  if (!file || corners != 3) {
    std::fprintf(stderr, "cgal_boolean: %s cannot be read as triangles\n", path);
    std::exit(1);
  }
  return arrays;
}

/// A closed manifold, or the program ends.
Mesh mesh_of(const Arrays& arrays) {
  using Vertex = Mesh::Vertex_index;
  Mesh mesh;
  mesh.reserve(arrays.points.size(), 3 * arrays.triangles.size() / 2, arrays.triangles.size());
  for (const auto& [x, y, z] : arrays.points) mesh.add_vertex(Kernel::Point_3(x, y, z));
  bool is_manifold = true;
  for (const auto& [a, b, c] : arrays.triangles) {
    is_manifold &= mesh.add_face(Vertex(a), Vertex(b), Vertex(c)) != Mesh::null_face();
  }
  if (!is_manifold || !CGAL::is_closed(mesh)) {
    std::fprintf(stderr, "cgal_boolean: an input is no closed manifold to CGAL\n");
    std::exit(1);
  }
  return mesh;
}

/// What was taken out of a mesh keeps its place there: the vertices are counted anew.
Arrays arrays_of(const Mesh& mesh) {
  Arrays arrays;
  std::vector<uint32_t> number(mesh.num_vertices());
  for (const auto v : mesh.vertices()) {
    number[v.idx()] = static_cast<uint32_t>(arrays.points.size());
    const auto& p = mesh.point(v);
    arrays.points.push_back(
        {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())});
  }
  for (const auto f : mesh.faces()) {
    auto& triangle = arrays.triangles.emplace_back();
    size_t corner = 0;
    for (const auto v : vertices_around_face(mesh.halfedge(f), mesh)) {
      triangle.at(corner++) = number[v.idx()];
    }
  }
  return arrays;
}

Mesh by_nef(const std::vector<Mesh>& meshes, const std::string& op) {
  Nef sum(meshes[0]);
  for (size_t i = 1; i < meshes.size(); ++i) {
    const Nef tool(meshes[i]);
    sum = op == "union" ? sum + tool : op == "intersection" ? sum * tool : sum - tool;
  }
  Mesh result;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, result, true);
  return result;
}

/// Changes the meshes. Ends the program where a result is no manifold, which this cannot express.
Mesh by_corefinement(std::vector<Mesh>& meshes, const std::string& op, bool ask_each) {
  Mesh& sum = meshes[0];
  for (size_t i = 1; i < meshes.size(); ++i) {
    Mesh& tool = meshes[i];
    if (!(op == "union"          ? pmp::corefine_and_compute_union(sum, tool, sum)
          : op == "intersection" ? pmp::corefine_and_compute_intersection(sum, tool, sum)
                                 : pmp::corefine_and_compute_difference(sum, tool, sum))) {
      std::fprintf(stderr, "cgal_boolean: a result is no manifold, which CGAL refuses\n");
      std::exit(1);
    }
    if (ask_each && !(CGAL::to_double(pmp::volume(sum)) > 0 && pmp::bbox(sum).xmax() > 0)) {
      std::fprintf(stderr, "cgal_boolean: a result has no volume\n");
      std::exit(1);
    }
  }
  return std::move(sum);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string way = argc > 5 ? argv[1] : "", op = argc > 5 ? argv[2] : "";
  const std::string asking = argc > 5 ? argv[3] : "";
  if ((way != "nef" && way != "corefine") ||
      (op != "union" && op != "intersection" && op != "difference") ||
      (asking != "once" && (asking != "each" || way == "nef"))) {
    std::fprintf(stderr,
                 "usage: cgal_boolean nef|corefine union|intersection|difference once|each OUT.off "
                 "IN.off...\n");
    return 2;
  }
  std::vector<Arrays> inputs;
  for (int i = 5; i < argc; ++i) inputs.push_back(read(argv[i]));
  const double before_mb = peak_mb(), start = cpu_seconds();
  std::vector<Mesh> meshes;
  for (const Arrays& input : inputs) meshes.push_back(mesh_of(input));
  const double imported = cpu_seconds();
  const Mesh result =
      way == "nef" ? by_nef(meshes, op) : by_corefinement(meshes, op, asking == "each");
  const double done = cpu_seconds();
  const Arrays arrays = arrays_of(result);
  const double end = cpu_seconds(), mb = peak_mb() - before_mb;
  std::ofstream file(argv[4]);
  file.precision(17);
  file << "OFF\n" << arrays.points.size() << " " << arrays.triangles.size() << " 0\n";
  for (const auto v : result.vertices()) {
    const auto& point = result.point(v);
    file << nearest(point.x()) << " " << nearest(point.y()) << " " << nearest(point.z()) << "\n";
  }
  for (const auto& [a, b, c] : arrays.triangles) {
    file << "3 " << a << " " << b << " " << c << "\n";
  }
  if (!file) return 1;
  std::printf(
      "{\"cpu_s\":%.3f,\"import_s\":%.3f,\"op_s\":%.3f,\"export_s\":%.3f,\"rss_mb\":%.1f,"
      "\"n_out_tris\":%zu}\n",
      end - start, imported - start, done - imported, end - done, mb, arrays.triangles.size());
  return 0;
}

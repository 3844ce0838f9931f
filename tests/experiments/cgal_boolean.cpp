// cgal_boolean nef|corefine union|difference once|each OUT.off IN.off...: the same by CGAL, with
// its Nef polyhedra, which the paper compares itself with, or by corefinement of surface meshes
// with exact points; one mesh after the other. `each` asks for the box and the volume of every
// result, which only corefinement can. One JSON line with the CPU seconds from CGAL's mesh of the
// input to that of the result and the peak of memory; reading, and exact points to doubles, are not
// counted. Built only where CGAL is installed; nothing else needs it.
#include <cmath>
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

/// A closed manifold, or the program ends.
Mesh read(const char* path) {
  Mesh mesh;
  std::ifstream file(path);
  if (!(file >> mesh)) {
    std::fprintf(stderr, "cgal_boolean: %s cannot be read\n", path);
    std::exit(1);
  }
  if (!CGAL::is_closed(mesh)) {
    std::fprintf(stderr, "cgal_boolean: %s is no closed manifold to CGAL\n", path);
    std::exit(1);
  }
  return mesh;
}

Mesh by_nef(const std::vector<Mesh>& meshes, bool unite) {
  Nef sum(meshes[0]);
  for (size_t i = 1; i < meshes.size(); ++i) {
    const Nef tool(meshes[i]);
    sum = unite ? sum + tool : sum - tool;
  }
  Mesh result;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, result, true);
  return result;
}

/// Changes the meshes. Ends the program where a result is no manifold, which this cannot express.
Mesh by_corefinement(std::vector<Mesh>& meshes, bool unite, bool ask_each) {
  Mesh& sum = meshes[0];
  for (size_t i = 1; i < meshes.size(); ++i) {
    Mesh& tool = meshes[i];
    if (!(unite ? pmp::corefine_and_compute_union(sum, tool, sum)
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
  if ((way != "nef" && way != "corefine") || (op != "union" && op != "difference") ||
      (asking != "once" && (asking != "each" || way == "nef"))) {
    std::fprintf(stderr,
                 "usage: cgal_boolean nef|corefine union|difference once|each OUT.off IN.off...\n");
    return 2;
  }
  std::vector<Mesh> meshes;
  for (int i = 5; i < argc; ++i) meshes.push_back(read(argv[i]));
  const double before_mb = peak_mb(), start = cpu_seconds();
  const Mesh result = way == "nef" ? by_nef(meshes, op == "union")
                                   : by_corefinement(meshes, op == "union", asking == "each");
  const double seconds = cpu_seconds() - start;
  const double mb = peak_mb() - before_mb;
  std::ofstream file(argv[4]);
  file.precision(17);
  file << "OFF\n" << result.number_of_vertices() << " " << result.number_of_faces() << " 0\n";
  // Of what was taken out, a mesh keeps places: the vertices are counted anew.
  std::vector<size_t> number(result.num_vertices());
  size_t count = 0;
  for (const auto v : result.vertices()) {
    number[v.idx()] = count++;
    const auto& point = result.point(v);
    file << nearest(point.x()) << " " << nearest(point.y()) << " " << nearest(point.z()) << "\n";
  }
  for (const auto f : result.faces()) {
    file << result.degree(f);
    for (const auto v : vertices_around_face(result.halfedge(f), result)) {
      file << " " << number[v.idx()];
    }
    file << "\n";
  }
  if (!file) return 1;
  std::printf("{\"cpu_s\":%.3f,\"rss_mb\":%.1f,\"n_out_tris\":%zu}\n", seconds, mb,
              static_cast<size_t>(result.number_of_faces()));
  return 0;
}

// cgal_boolean union|difference A.off B.off OUT.off: the same by CGAL's Nef polyhedra, which the
// paper compares itself with. One JSON line with the seconds from arrays to arrays and the peak of
// memory. Built only where CGAL is installed; nothing else needs it.
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <type_traits>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
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

bool read(const char* path, Mesh& mesh) {
  std::ifstream file(path);
  return static_cast<bool>(file >> mesh);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string op = argc == 5 ? argv[1] : "";
  if (op != "union" && op != "difference") {
    std::fprintf(stderr, "usage: cgal_boolean union|difference A.off B.off OUT.off\n");
    return 2;
  }
  Mesh a, b, result;
  if (!read(argv[2], a) || !read(argv[3], b)) {
    std::fprintf(stderr, "cgal_boolean: a mesh cannot be read\n");
    return 1;
  }
  if (!CGAL::is_closed(a) || !CGAL::is_closed(b)) {
    std::fprintf(stderr, "cgal_boolean: a mesh is no closed manifold to CGAL\n");
    return 1;
  }
  const double before_mb = peak_mb(), start = cpu_seconds();
  const Nef p(a), q(b);
  const Nef r = op == "union" ? p + q : p - q;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(r, result, true);
  const double seconds = cpu_seconds() - start;
  const double mb = peak_mb() - before_mb;
  std::ofstream file(argv[4]);
  file.precision(17);
  file << "OFF\n" << result.number_of_vertices() << " " << result.number_of_faces() << " 0\n";
  for (const auto v : result.vertices()) {
    const auto& point = result.point(v);
    file << nearest(point.x()) << " " << nearest(point.y()) << " " << nearest(point.z()) << "\n";
  }
  for (const auto f : result.faces()) {
    file << result.degree(f);
    for (const auto v : vertices_around_face(result.halfedge(f), result)) file << " " << v.idx();
    file << "\n";
  }
  if (!file) return 1;
  std::printf("{\"cpu_s\":%.3f,\"rss_mb\":%.1f,\"n_out_tris\":%zu}\n", seconds, mb,
              static_cast<size_t>(result.number_of_faces()));
  return 0;
}

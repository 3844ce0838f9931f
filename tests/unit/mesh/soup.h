// Meshes as files have them, whole and damaged, and what repair makes of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <csgrun/engine/repair.h>
#include <csgrun/engine/validate.h>

#include "tests/support/seeded.h"

namespace csgrun::test {

using Face = std::vector<uint32_t>;

/// Points and faces of one loop, as a file has them.
struct Soup {
  std::vector<glm::dvec3> points;
  std::vector<Face> faces;

  [[nodiscard]] PolygonMesh mesh() const;
  void add(const Soup& other);
  void turn();
};

Soup box(const glm::dvec3& lo, const glm::dvec3& hi);

Soup cube();

/// Every face with points of its own.
Soup unwelded(const Soup& soup);

/// A surface of boxes of a grid, triangulated: the cells are those of a random connected walk, so
/// that there are handles, edges in contact and voids. Its volume is the number of cells.
Soup random_cells(Random& random, int size, int count, int64_t& volume);

/// Whether every directed edge occurs as often as its reverse; written anew here.
bool is_balanced(const PolygonMesh& mesh);

std::vector<std::string> lines(const RepairReport& report);

using Lines = std::vector<std::string>;

/// Repairs; the result must be closed. Its volume.
double repaired_volume(const Soup& soup, const RepairOptions& options, Lines* said = nullptr);

std::string refusal(const Soup& soup, const RepairOptions& options);

RepairOptions filling();

}  // namespace csgrun::test

// Results say where they may touch themselves.
#pragma once

#include <string>

namespace csgrun {
struct BoundaryMesh;
}  // namespace csgrun

namespace csgrun::test {

/// A mesh is presented as if it could touch itself anywhere.
void expect_touches_told(const BoundaryMesh& mesh, const std::string& what);

}  // namespace csgrun::test

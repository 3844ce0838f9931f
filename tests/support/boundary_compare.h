// Compares two boundaries in canonical order: everything that is part of a result's value.
#pragma once

#include <string>

namespace csgrun {
struct BoundaryMesh;
}  // namespace csgrun

namespace csgrun::test {

/// The first difference between two boundaries as text, or an empty string. Which plane names an
/// edge or a point is not compared: that is a matter of how, not of what.
std::string first_difference(const BoundaryMesh& a, const BoundaryMesh& b);

}  // namespace csgrun::test

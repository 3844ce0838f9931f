// The text of DXF files for tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace csgrun::testing {

/// Groups of a code and a value.
std::string pairs(const std::vector<std::pair<int, std::string>>& groups);
/// A whole file with these in its sections.
std::string entities(const std::string& content, const std::string& blocks = "");
/// A POLYLINE with these flags through (0, 0), (4, 0) and (4, 4).
std::string dxf_old_triangle(const std::string& flags);
std::string dxf_line(double x0, double y0, double x1, double y1, const std::string& layer = "0");

}  // namespace csgrun::testing

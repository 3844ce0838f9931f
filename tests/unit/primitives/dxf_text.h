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
std::string dxf_line(double x0, double y0, double x1, double y1, const std::string& layer = "0");

}  // namespace csgrun::testing

// Warnings for people: of many that say the same of other places the first few.
#pragma once

#include <string>
#include <vector>

namespace csgrun {

/// The first three of those that are alike but for numbers and their place (`file:line:`), and
/// after these how many more there are. They stay in their order. O(n log n).
std::vector<std::string> few_alike(const std::vector<std::string>& warnings);

}  // namespace csgrun

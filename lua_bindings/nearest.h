// "Did you mean ...?": the nearest of a set of names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace csgrun {

/// The name nearest to `word` by edit distance (insert, delete, replace, swap of neighbours; case
/// counts half), or empty when none is near enough to be meant. Ties go to the first in byte order.
/// What other programs call one of the names goes before ("subtract": difference), the last half of
/// one after ("extrude": linear_extrude).
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// " (did you mean 'x'?)", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace csgrun

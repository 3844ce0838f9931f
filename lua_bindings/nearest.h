// "Did you mean ...?": the nearest of a set of names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace csgrun {

/// The name nearest to `word` by edit distance (insert, delete, replace, swap of neighbours; case
/// counts half), or empty when none is near enough to be meant. Ties go to the first in byte order.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// " (did you mean 'x'?)", or nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace csgrun

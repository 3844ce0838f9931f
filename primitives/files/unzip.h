// Files out of a zip file in memory.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <csgrun/engine/error.h>

namespace csgrun {

/// The bytes of the entry `entry`; nothing when the archive has none of that name. `name` stands in
/// messages. Errors: kMalformedFile; kLimit for an entry that unpacks to far more than a file of
/// its kind would: told before memory is taken for it.
Result<std::optional<std::string>> unzip_entry(const std::string& name, std::string_view archive,
                                               const std::string& entry);

/// The same of the first entry whose name ends so.
Result<std::optional<std::string>> unzip_first(const std::string& name, std::string_view archive,
                                               const std::string& ending);

}  // namespace csgrun

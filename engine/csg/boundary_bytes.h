// Results as bytes, for other runs.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/csg/appearance_table.h"
#include "engine/csg/result_cache.h"

namespace csgrun {

/// The boundary of a result and where it stands, with the leaves that it has faces of, and its
/// appearances by value, whose numbers are those of a run. Exact: a boundary that is read is the
/// one that was written, bit by bit. REQUIRES: there is a boundary. O(n).
std::string to_bytes(const StoredBoundary& stored, const AppearanceTable& appearances);

/// The result under a key, its appearances under their numbers in this run. Nothing if the bytes
/// are not of a result.
std::optional<StoredBoundary> from_bytes(std::string_view bytes, const Key& key,
                                         AppearanceTable& appearances);

}  // namespace csgrun

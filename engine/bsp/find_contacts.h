// All pairs of polygons of different operands that meet.
#pragma once

#include <cstdint>
#include <vector>

#include <csgrun/engine/evaluate.h>

#include "engine/base/raw_vector.h"
#include "engine/bsp/covered_polygons.h"
#include "engine/bsp/pair_test.h"

namespace csgrun {

struct Contacts {
  RawVector<Contact> contacts;  ///< in no order that means anything, the same on every run
  /// Per vertex of the job: it may be on another operand's surface.
  std::vector<uint8_t> touched;
  /// Per polygon: it has a corner in common with a coplanar one, and nothing else. That is no
  /// contact.
  std::vector<uint8_t> in_flat_corner;
};

/// Divides space into cells of pairs and looks at each pair; planes are made where doubles and
/// 128-bit integers do not tell. Pairs of two covered polygons, or of a hidden one, are left out.
/// `stats` is added to. Parallel; incomplete when cancelled.
Contacts find_contacts(Job& job, const PlainlyCovered& plainly, const KernelOptions& options,
                       EvaluateStats& stats);

}  // namespace csgrun

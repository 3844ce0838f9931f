// What a run or a file measures, as JSON on standard output or as text on standard error.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "lua_bindings/cli/run_model.h"
#include "lua_bindings/measure/part_measures.h"

namespace csgrun {

/// The object of --stats=json, on one line.
std::string stats_json(const RunReport& report);
/// The same for people.
std::string stats_text(const RunReport& report);

/// How many self-intersections a file has.
struct CountedCrossings {
  uint64_t count = 0;
  bool at_least = false;  ///< counting ended there
};

/// The object of `csgrun info --json`, or text.
std::string info_json(const std::string& file, const std::vector<PartMeasures>& parts,
                      const CountedCrossings& crossings, const std::vector<std::string>& warnings);
std::string info_text(const std::string& file, const std::vector<PartMeasures>& parts,
                      const CountedCrossings& crossings, const std::vector<std::string>& warnings);

}  // namespace csgrun

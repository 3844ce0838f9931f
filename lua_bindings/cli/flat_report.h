// 2D results: what they measure, as JSON and as text.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include <csgrun/primitives/shape2d.h>

namespace csgrun {

/// A named shape as a result.
struct FlatResult {
  std::string name;
  Shape2D shape;
};

/// {"name", "outlines", "vertices", "area", "perimeter", "bbox", "components", "holes"}.
nlohmann::ordered_json flat_json(const FlatResult& part);
std::string flat_text(const FlatResult& part);

/// What `csgrun info` prints of a drawing.
std::string flat_info_json(const std::string& file, const FlatResult& part,
                           const std::vector<std::string>& warnings);
std::string flat_info_text(const std::string& file, const FlatResult& part,
                           const std::vector<std::string>& warnings);

}  // namespace csgrun

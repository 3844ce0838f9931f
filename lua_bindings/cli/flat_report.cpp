#include "lua_bindings/cli/flat_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <csgrun/primitives/shape_operations.h>

namespace csgrun {
namespace {

size_t vertices_of(const Shape2D& shape) {
  size_t count = 0;
  for (const Shape2D::Loop& loop : shape.loops()) count += loop.size();
  return count;
}

}  // namespace

nlohmann::ordered_json flat_json(const FlatResult& part) {
  using Json = nlohmann::ordered_json;
  const Shape2D& shape = part.shape;
  Json box = nullptr;  // nothing has no box
  if (!shape.empty()) {
    const auto [low, high] = shape.bounds();
    box = Json::array({Json::array({low.x, low.y}), Json::array({high.x, high.y})});
  }
  return {{"name", part.name},
          {"outlines", shape.loops().size()},
          {"vertices", vertices_of(shape)},
          {"area", shape.area()},
          {"perimeter", perimeter_of(shape)},
          {"bbox", box},
          {"components", shape.regions().size()},
          {"holes", shape.loops().size() - shape.regions().size()}};
}

std::string flat_text(const FlatResult& part) {
  const Shape2D& shape = part.shape;
  const auto plural = [](size_t n) { return n == 1 ? "" : "s"; };
  const size_t outlines = shape.loops().size(), pieces = shape.regions().size();
  std::string text = fmt::format(
      "{}: {} outline{}, {} vertices, area {:.10g} mm^2, perimeter {:.10g} mm\n", part.name,
      outlines, plural(outlines), vertices_of(shape), shape.area(), perimeter_of(shape));
  if (!shape.empty()) {
    const auto [low, high] = shape.bounds();
    text += fmt::format("  from ({:.10g}, {:.10g}) to ({:.10g}, {:.10g}) mm\n", low.x, low.y,
                        high.x, high.y);
  }
  return text + fmt::format("  {} component{}, {} hole{}\n", pieces, plural(pieces),
                            outlines - pieces, plural(outlines - pieces));
}

std::string flat_info_json(const std::string& file, const FlatResult& part,
                           const std::vector<std::string>& warnings) {
  const nlohmann::ordered_json json = {{"file", file},
                                       {"parts", nlohmann::ordered_json::array({flat_json(part)})},
                                       {"self_intersections", 0},
                                       {"warnings", warnings}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string flat_info_text(const std::string& file, const FlatResult& part,
                           const std::vector<std::string>& warnings) {
  std::string text = file + "\n" + flat_text(part);
  for (const std::string& warning : warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace csgrun

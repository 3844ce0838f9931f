#include <cmath>

#include <glm/common.hpp>

#include <csgrun/primitives/file_ending.h>
#include <csgrun/primitives/flat_file.h>

#include "primitives/base/text.h"
#include "primitives/files/flat_formats.h"

namespace csgrun {

std::string flat_file_format_of(const std::string& path) {
  for (const char* format : {"svg", "dxf"}) {
    if (has_ending(path, std::string(".") + format)) return format;
  }
  return {};
}

Result<FlatFile> parse_flat(const std::string& name, std::string_view bytes,
                            const FlatFileOptions& options) {
  const std::string format = flat_file_format_of(name);
  if (format.empty()) return invalid_argument(name + ": the ending is none of .svg, .dxf");
  // Every curve may take as many points.
  constexpr double kMostFragments = 1 << 17;
  if (!(options.facets.fn <= kMostFragments)) {
    return invalid_argument("import: fn must be at most " + number_text(kMostFragments) + ", got " +
                            number_text(options.facets.fn));
  }
  if (format == "svg" && (!(options.dpi > 0) || !std::isfinite(options.dpi)))
    return not_positive("import", "dpi", options.dpi);
  if (format == "svg" && options.as_openscad) return parse_svg_as_openscad(name, bytes, options);
  Result<FlatFile> file =
      format == "svg" ? parse_svg(name, bytes, options) : parse_dxf(name, bytes, options);
  if (!file || !options.center) return file;
  std::vector<Shape2D*> shapes;
  if (!file->shape.empty()) shapes.push_back(&file->shape);
  for (FlatFilePart& part : file->parts) shapes.push_back(&part.shape);
  if (shapes.empty()) return file;
  auto [low, high] = shapes[0]->bounds();
  for (const Shape2D* shape : shapes) {
    low = glm::min(low, shape->bounds()[0]);
    high = glm::max(high, shape->bounds()[1]);
  }
  Affine map;
  map.m[0][3] = -(low.x + high.x) / 2;
  map.m[1][3] = -(low.y + high.y) / 2;
  for (Shape2D* shape : shapes) {
    Result<Shape2D> moved = shape->transformed(map);
    if (!moved) return moved.error();
    *shape = *std::move(moved);
  }
  return file;
}

}  // namespace csgrun

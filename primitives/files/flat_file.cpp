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
  Result<FlatFile> file =
      format == "svg" ? parse_svg(name, bytes, options) : parse_dxf(name, bytes, options);
  if (!file || !options.center || file->shape.empty()) return file;
  const auto [low, high] = file->shape.bounds();
  Affine map;
  map.m[0][3] = -(low.x + high.x) / 2;
  map.m[1][3] = -(low.y + high.y) / 2;
  Result<Shape2D> moved = file->shape.transformed(map);
  if (!moved) return moved.error();
  file->shape = *std::move(moved);
  return file;
}

}  // namespace csgrun

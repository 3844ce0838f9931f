// One reader a format of 2D drawings.
#pragma once

#include <string>
#include <string_view>

#include <csgrun/primitives/flat_file.h>

namespace csgrun {

Result<FlatFile> parse_svg(const std::string& name, std::string_view bytes,
                           const FlatFileOptions& options);
/// With `as_openscad`: centred, if that is asked for, where OpenSCAD does it.
Result<FlatFile> parse_svg_as_openscad(const std::string& name, std::string_view bytes,
                                       const FlatFileOptions& options);
Result<FlatFile> parse_dxf(const std::string& name, std::string_view bytes,
                           const FlatFileOptions& options);

}  // namespace csgrun

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <png.h>

#include <csgrun/primitives/height_map.h>

#include "primitives/base/text.h"
#include "primitives/files/byte_order.h"
#include "primitives/files/formats.h"
#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

constexpr size_t kMostHeights = size_t{1} << 21;

Error too_many(const std::string& name) {
  return Error{ErrorCode::kLimit,
               name + ": a surface has at most " + std::to_string(kMostHeights) + " points",
               {}};
}

Result<HeightMap> parse_table(const std::string& name, std::string_view bytes) {
  std::vector<std::vector<double>> rows;
  TextScanner scanner(bytes, '#');
  size_t columns = 0, count = 0;
  double least = 1;
  do {
    std::vector<double> row;
    for (auto word = scanner.word(); !word.empty(); word = scanner.word()) {
      const auto value = parse_finite(word);
      if (!value) {
        return malformed(name, scanner.place(), "expected a number, got " + quoted(word));
      }
      row.push_back(*value);
      if (count + row.size() > kMostHeights) return too_many(name);
      least = std::min(least, *value);
    }
    if (row.empty()) continue;
    columns = std::max(columns, row.size());
    count += row.size();
    rows.push_back(std::move(row));
    if (rows.size() > kMostHeights / columns) return too_many(name);
  } while (scanner.next_line());
  HeightMap map{columns, rows.size(), {}, least - 1};
  map.heights.reserve(columns * rows.size());
  for (std::vector<double>& row : rows) {
    row.resize(columns, 0);
    map.heights.insert(map.heights.end(), row.begin(), row.end());
  }
  return map;
}

/// What of a PNG is pixels.
struct PngPixels {
  size_t bytes = 0;  ///< of the chunks that hold them
  std::string file;  ///< without the chunks that say how they are to be shown
};
PngPixels pixels_of(std::string_view bytes) {
  constexpr size_t kSignatureSize = 8, kFrame = 12;  // length, type and checksum of a chunk
  constexpr std::array<std::string_view, 5> kShown{"gAMA", "cHRM", "sRGB", "iCCP", "cICP"};
  PngPixels pixels{0, std::string(bytes.substr(0, kSignatureSize))};
  size_t at = kSignatureSize;
  while (at + kFrame <= bytes.size()) {
    const size_t length = read_unsigned<4>(bytes, at, true);
    if (length > bytes.size() - at - kFrame) break;
    const std::string_view type = bytes.substr(at + 4, 4);
    if (type == "IDAT") pixels.bytes += length;
    if (std::find(kShown.begin(), kShown.end(), type) == kShown.end()) {
      pixels.file += bytes.substr(at, kFrame + length);
    }
    at += kFrame + length;
  }
  pixels.file += bytes.substr(at);
  return pixels;
}

/// By libpng's simplified interface: no jumps, and no more memory than the picture's 8-bit pixels.
Result<HeightMap> parse_png(const std::string& name, std::string_view bytes, bool invert) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto fail = [&] {
    const std::string message = image.message;
    png_image_free(&image);
    return malformed(name, "", "the PNG cannot be read: " + message);
  };
  const PngPixels pixels_only = pixels_of(bytes);
  const std::string& file = pixels_only.file;
  if (png_image_begin_read_from_memory(&image, file.data(), file.size()) == 0) return fail();
  if (image.width == 0 || image.height == 0 || image.width > kMostHeights / image.height) {
    png_image_free(&image);
    return too_many(name);
  }
  // What is compressed is hardly larger than what it unpacks to. More would be unpacked and thrown
  // away, a thousandfold.
  constexpr size_t kMostOfPixel = 8, kOfRow = 16, kOfFile = 1024;
  const size_t most = size_t{image.height} * (image.width * kMostOfPixel + kOfRow) + kOfFile;
  if (pixels_only.bytes > most) {
    png_image_free(&image);
    return malformed(name, "", "the PNG has more data than its size needs");
  }
  // Values as they are in the file.
  image.format = PNG_FORMAT_RGBA;
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  const size_t columns = image.width, rows = image.height;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) return fail();
  HeightMap map{columns, rows, std::vector<double>(columns * rows)};
  for (size_t y = 0; y < rows; ++y) {
    for (size_t x = 0; x < columns; ++x) {
      const png_byte* p = &pixels[(y * columns + x) * 4];
      const double luminance = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
      map.heights[(rows - 1 - y) * columns + x] =
          100.0 / 255 * (invert ? 1 - luminance : luminance);
    }
  }
  return map;
}

}  // namespace

bool is_png(std::string_view bytes) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  return bytes.starts_with(kSignature);
}

Result<HeightMap> parse_height_map(const std::string& name, std::string_view bytes, bool invert) {
  if (is_png(bytes)) return parse_png(name, bytes, invert);
  return parse_table(name, bytes);
}

MeshResult make_surface(const HeightMap& map, bool center) {
  const size_t columns = map.columns, rows = map.rows;
  if (columns < 2 || rows < 2) {
    return invalid_argument("surface: needs at least 2 rows and 2 columns of heights, got " +
                            std::to_string(rows) + " and " + std::to_string(columns));
  }
  for (const double h : map.heights) {
    if (!std::isfinite(h)) return not_finite("surface", "a height", h);
  }
  const double floor =
      map.floor.value_or(*std::min_element(map.heights.begin(), map.heights.end()) - 1);
  const double x0 = center ? -static_cast<double>(columns - 1) / 2 : 0;
  const double y0 = center ? -static_cast<double>(rows - 1) / 2 : 0;
  PolygonMesh mesh;
  mesh.kind = "surface";
  // Points of the table, means of the squares, then the rim of the floor.
  const auto at = [&](size_t row, size_t column) {
    return static_cast<uint32_t>(row * columns + column);
  };
  for (size_t r = 0; r < rows; ++r) {
    for (size_t c = 0; c < columns; ++c) {
      mesh.points.emplace_back(x0 + static_cast<double>(c), y0 + static_cast<double>(r),
                               map.heights[at(r, c)]);
    }
  }
  for (size_t r = 0; r + 1 < rows; ++r) {
    for (size_t c = 0; c + 1 < columns; ++c) {
      const double mean = (map.heights[at(r, c)] + map.heights[at(r, c + 1)] +
                           map.heights[at(r + 1, c)] + map.heights[at(r + 1, c + 1)]) /
                          4;
      const auto middle = static_cast<uint32_t>(mesh.points.size());
      mesh.points.emplace_back(x0 + static_cast<double>(c) + 0.5, y0 + static_cast<double>(r) + 0.5,
                               mean);
      const std::array<uint32_t, 4> around{at(r, c), at(r, c + 1), at(r + 1, c + 1), at(r + 1, c)};
      for (size_t i = 0; i < 4; ++i) {
        mesh.add_face(std::array<uint32_t, 3>{around[i], around[(i + 1) % 4], middle}, 1);
      }
    }
  }
  std::vector<uint32_t> rim;  // counter-clockwise from above
  for (size_t c = 0; c + 1 < columns; ++c) rim.push_back(at(0, c));
  for (size_t r = 0; r + 1 < rows; ++r) rim.push_back(at(r, columns - 1));
  for (size_t c = columns - 1; c > 0; --c) rim.push_back(at(rows - 1, c));
  for (size_t r = rows - 1; r > 0; --r) rim.push_back(at(r, 0));
  const auto first = static_cast<uint32_t>(mesh.points.size());
  for (const uint32_t p : rim) {
    mesh.points.emplace_back(mesh.points[p].x, mesh.points[p].y, floor);
  }
  const auto count = static_cast<uint32_t>(rim.size());
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t next = (i + 1) % count;
    mesh.add_face(std::array<uint32_t, 4>{first + i, first + next, rim[next], rim[i]});
  }
  std::vector<uint32_t> bottom;
  for (uint32_t i = count; i-- > 0;) bottom.push_back(first + i);
  mesh.add_face(bottom);
  return mesh;
}

}  // namespace csgrun

// Tables of heights as solids: volumes in closed form, pictures from bytes made here.
#include <cmath>

#include <gtest/gtest.h>
#include <png.h>

#include <csgrun/engine/validate.h>
#include <csgrun/primitives/height_map.h>

namespace csgrun::height_map_test {
namespace {

std::string message(const Result<HeightMap>& map) { return map ? "no error" : map.error().message; }

TEST(HeightMap, OfText) {
  const auto map = parse_height_map("h.dat", "# heights\n1 2.5\t3\n\n -4 5e-1 # last\n", false);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->columns, 3u);
  EXPECT_EQ(map->rows, 2u);
  EXPECT_EQ(map->heights, (std::vector<double>{1, 2.5, 3, -4, 0.5, 0}));
  EXPECT_EQ(message(parse_height_map("h.dat", "1 2\n3 x\n", false)),
            "h.dat:2: expected a number, got \"x\"");
  // Short rows after a long one: few numbers, many points.
  std::string comb(8000, ' ');
  for (size_t i = 0; i < comb.size(); i += 2) comb[i] = '1';
  for (int i = 0; i < 4000; ++i) comb += "\n1";
  EXPECT_EQ(message(parse_height_map("h.dat", comb, false)),
            "h.dat: a surface has at most 2097152 points");
}

/// A picture of 8-bit RGB rows, top first.
std::string picture(uint32_t width, uint32_t height, const std::vector<png_byte>& pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

TEST(HeightMap, OfAPicture) {
  const std::string png = picture(2, 2, {255, 255, 255, 255, 0, 0, 0, 0, 0, 0, 255, 0});
  const auto map = parse_height_map("h.png", png, false);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_NEAR(map->heights[0], 0, 1e-12);  // the lowest row of the picture is the first
  EXPECT_NEAR(map->heights[1], 71.52, 1e-12);
  EXPECT_NEAR(map->heights[2], 100, 1e-12);
  EXPECT_NEAR(map->heights[3], 21.26, 1e-12);
  const auto inverted = parse_height_map("h.png", png, true);
  ASSERT_TRUE(inverted);
  EXPECT_NEAR(inverted->heights[2], 100.0 / 255 * (1 - 255), 1e-12);
  EXPECT_NE(message(parse_height_map("h.png", png.substr(0, png.size() / 2), false))
                .find("h.png: the PNG cannot be read"),
            std::string::npos);
}

/// Four bytes, the first one the highest.
std::string big_endian(uint32_t value) {
  std::string bytes;
  for (int k = 0; k < 4; ++k) bytes += static_cast<char>(value >> (24 - 8 * k));
  return bytes;
}

/// The check sum of a chunk: CRC-32 of its type and data.
std::string check_sum(std::string_view type_and_data) {
  uint32_t crc = ~0u;
  for (const char c : type_and_data) {
    crc ^= static_cast<uint8_t>(c);
    for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return big_endian(~crc);
}

TEST(HeightMap, IsNoMatterOfHowAPictureIsShown) {
  std::vector<png_byte> pixels;
  for (int i = 0; i < 48; ++i) pixels.push_back(static_cast<png_byte>(i * 37));
  const std::string plain = picture(4, 4, pixels);
  const auto truth = parse_height_map("h.png", plain, false);
  ASSERT_TRUE(truth);
  constexpr size_t kHeaderEnd = 33;  // where chunks about colour begin
  for (const uint32_t gamma : {45455u, 55556u, 100000u, 220000u}) {
    const std::string chunk = "gAMA" + big_endian(gamma);
    std::string png = plain;
    png.insert(kHeaderEnd, big_endian(4) + chunk + check_sum(chunk));
    const auto map = parse_height_map("h.png", png, false);
    ASSERT_TRUE(map);
    EXPECT_EQ(map->heights, truth->heights) << gamma;
  }
}

/// The same picture with another size in its header: what a bomb looks like.
TEST(HeightMap, PicturesThatPromiseTooMuch) {
  std::string png = picture(2, 2, std::vector<png_byte>(12, 7));
  for (const size_t at : {16, 20}) png.replace(at, 4, std::string("\0\1\0\0", 4));
  png.replace(29, 4, check_sum(png.substr(12, 17)));
  EXPECT_EQ(message(parse_height_map("bomb.png", png, false)),
            "bomb.png: a surface has at most 2097152 points");
}

TEST(Surface, IsClosedAndHasItsVolume) {
  // Each square has the volume of its mean height: the pyramid over four points has it exactly.
  const HeightMap map{3, 2, {0, 1, 2, 4, 8, 0}};
  const auto mesh = make_surface(map, false);
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_TRUE(check_mesh(*mesh).ok()) << check_mesh(*mesh).text();
  const auto square = [](double a, double b, double c, double d) {
    return (a + b + c + d) / 4 + 1;
  };
  EXPECT_NEAR(signed_volume(*mesh), square(0, 1, 4, 8) + square(1, 2, 8, 0), 1e-12);
  const auto centred = make_surface(map, true);
  ASSERT_TRUE(centred);
  EXPECT_EQ(centred->points[0], glm::dvec3(-1, -0.5, 0));
}

TEST(Surface, OfATextStandsOnZeroUnlessItGoesBelow) {
  const auto bottom = [](const std::string& text) {
    const auto map = parse_height_map("h.dat", text, false);
    EXPECT_TRUE(map);
    const auto mesh = make_surface(*map, false);
    EXPECT_TRUE(mesh);
    return mesh->points.back().z;
  };
  EXPECT_EQ(bottom("9 6 7\n6 8 9\n5 3 2\n"), 0);
  EXPECT_EQ(bottom("1 6\n6 8\n"), 0);
  EXPECT_EQ(bottom("9 6\n0.5 8\n"), -0.5);
  EXPECT_EQ(bottom("9 -6\n5 8\n"), -7);
  // What a short row lacks has the height 0, and moves no floor.
  EXPECT_EQ(bottom("9 6 7\n6 8 9\n2\n"), 0);
}

TEST(Surface, Mistakes) {
  EXPECT_EQ(make_surface({3, 1, {1, 2, 3}}, false).error().message,
            "surface: needs at least 2 rows and 2 columns of heights, got 1 and 3");
  EXPECT_EQ(make_surface({2, 2, {1, 2, 3, std::nan("")}}, false).error().message,
            "surface: a height must be finite, got nan");
}

}  // namespace
}  // namespace csgrun::height_map_test

#include "primitives/files/face_colours.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <csgrun/primitives/model_file.h>

#include "primitives/files/text_scanner.h"

namespace csgrun {
namespace {

constexpr size_t kMostColours = 4096;  // each becomes a material of a written file
constexpr float kFine = 255;
/// Steps of each channel, where there are more: the last of these is few enough for six channels.
constexpr float kCoarser[] = {15, 7, 3};

Rgba rounded(const Rgba& colour, float steps) {
  Rgba result{};
  for (size_t i = 0; i < 4; ++i) result[i] = std::round(colour[i] * steps) / steps;
  return result;
}

}  // namespace

Appearance appearance_of(const Rgba& colour) {
  Appearance look;
  look.red = colour[0];
  look.green = colour[1];
  look.blue = colour[2];
  look.alpha = colour[3];
  look.is_default = false;
  return look;
}

bool is_named_default(const Appearance& look) {
  const auto bytes = [](const Appearance& x) {
    const auto byte = [](float c) { return std::lround(kFine * c); };
    return std::tuple(byte(x.red), byte(x.green), byte(x.blue), byte(x.alpha));
  };
  return look.name == "default" && bytes(look) == bytes(Appearance());
}

bool LookOrder::operator()(const Appearance& a, const Appearance& b) const {
  const auto key = [](const Appearance& x) {
    return std::tie(x.red, x.green, x.blue, x.alpha, x.metallic, x.roughness, x.name, x.is_default);
  };
  return key(a) < key(b);
}

void limit_appearances(PolygonMesh& mesh, std::vector<std::string>* notes) {
  const std::vector<Appearance> fine = mesh.appearances;
  const auto is_coloured = [](const Appearance& look) { return !look.is_default; };
  const auto before = std::count_if(fine.begin(), fine.end(), is_coloured);
  if (static_cast<size_t>(before) <= kMostColours) return;
  std::vector<uint32_t> number(fine.size());
  for (const float steps : kCoarser) {
    std::map<Appearance, uint32_t, LookOrder> known;
    mesh.appearances.clear();
    for (size_t i = 0; i < fine.size(); ++i) {
      Appearance look = fine[i];
      if (is_coloured(look)) {
        for (float* channel :
             {&look.red, &look.green, &look.blue, &look.alpha, &look.metallic, &look.roughness}) {
          *channel = std::round(*channel * steps) / steps;
        }
        look.name.clear();
      }
      const auto [entry, is_new] =
          known.emplace(look, static_cast<uint32_t>(mesh.appearances.size()));
      if (is_new) mesh.appearances.push_back(look);
      number[i] = entry->second;
    }
    if (mesh.appearances.size() <= kMostColours + 1) break;
  }
  for (uint32_t& each : mesh.appearance_of) each = number[each];
  const auto after = std::count_if(mesh.appearances.begin(), mesh.appearances.end(), is_coloured);
  if (notes != nullptr) {
    notes->push_back(std::to_string(before) + " colours of faces were rounded to " +
                     std::to_string(after));
  }
}

std::optional<Rgba> FaceColours::of_corners(const PolygonMesh& mesh, size_t face) const {
  if (vertices_.empty()) return std::nullopt;
  const auto corner = [&](uint32_t i) {
    const uint32_t vertex = mesh.corners[i];
    return vertex < vertices_.size() ? vertices_[vertex] : std::nullopt;
  };
  const uint32_t begin = mesh.loop_starts[mesh.face_starts[face]];
  const uint32_t end = mesh.loop_starts[mesh.face_starts[face + 1]];
  Rgba sum{};
  bool are_equal = true;
  for (uint32_t i = begin; i < end; ++i) {
    const std::optional<Rgba> colour = corner(i);
    if (!colour) return std::nullopt;
    are_equal &= *colour == *corner(begin);
    for (size_t k = 0; k < 4; ++k) sum[k] += (*colour)[k];
  }
  if (are_equal) return corner(begin);
  for (float& channel : sum) channel /= static_cast<float>(end - begin);
  return rounded(sum, kFine);
}

void FaceColours::apply(PolygonMesh& mesh, std::vector<std::string>* notes) const {
  std::vector<std::optional<Rgba>> colours(mesh.face_count());
  std::map<Rgba, uint32_t> numbers;
  for (size_t f = 0; f < colours.size(); ++f) {
    colours[f] = f < faces_.size() && faces_[f] ? faces_[f] : of_corners(mesh, f);
    if (colours[f]) numbers.emplace(*colours[f], 0);
  }
  if (numbers.empty()) return;
  // Numbered as they first occur, and 0 for faces without one.
  mesh.appearances.assign(1, {});
  for (const std::optional<Rgba>& colour : colours) {
    uint32_t number = 0;
    if (colour) {
      uint32_t& known = numbers[*colour];
      if (known == 0) {
        known = static_cast<uint32_t>(mesh.appearances.size());
        mesh.appearances.push_back(appearance_of(*colour));
      }
      number = known;
    }
    mesh.appearance_of.push_back(number);
  }
  limit_appearances(mesh, notes);
}

std::optional<Rgba> colour_of_words(std::span<const std::string_view> words) {
  if (words.size() != 3 && words.size() != 4) return std::nullopt;
  const bool is_whole = std::none_of(words.begin(), words.end(), [](std::string_view word) {
    return word.find_first_of(".eE") != std::string_view::npos;
  });
  Rgba colour{0, 0, 0, 1};
  for (size_t i = 0; i < words.size(); ++i) {
    const auto value = parse_finite(words[i]);
    if (!value || *value < 0 || *value > (is_whole ? 255 : 1)) return std::nullopt;
    colour[i] = static_cast<float>(is_whole ? *value / 255 : *value);
  }
  return colour;
}

}  // namespace csgrun

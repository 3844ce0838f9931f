// Colours that a mesh file gives its vertices and faces, as appearances of faces.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <csgrun/engine/polygon_mesh.h>

namespace csgrun {

using Rgba = std::array<float, 4>;  ///< red, green, blue and alpha from 0 to 1

class FaceColours {
 public:
  /// Of the next vertex, or of the next face; all of them in their order, with a colour or without.
  void add_vertex(const std::optional<Rgba>& colour) { vertices_.push_back(colour); }
  void add_face(const std::optional<Rgba>& colour) { faces_.push_back(colour); }

  /// Gives the faces of the mesh, in the order of add_face, their colours: their own, else the mean
  /// of those of their corners, if all have one; nothing where no face has any. More colours than a
  /// model would have are rounded to 16 steps of each channel, and a note says so.
  void apply(PolygonMesh& mesh, std::vector<std::string>* notes) const;

 private:
  [[nodiscard]] std::optional<Rgba> of_corners(const PolygonMesh& mesh, size_t face) const;

  std::vector<std::optional<Rgba>> vertices_, faces_;
};

/// Three or four numbers of a text file: whole numbers count to 255, others to 1. Nothing for what
/// is no colour.
std::optional<Rgba> colour_of_words(std::span<const std::string_view> words);

}  // namespace csgrun

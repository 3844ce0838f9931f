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

/// What has that colour, and nothing else to tell.
Appearance appearance_of(const Rgba& colour);

/// An order of appearances, any.
struct LookOrder {
  bool operator()(const Appearance& a, const Appearance& b) const;
};

/// Each appearance becomes a material of a written file: where a mesh has more than a model would
/// (4096), they are rounded to 16 steps of each channel, or fewer, and lose their names. `notes`,
/// if given, gets what was done. O(faces log appearances).
void limit_appearances(PolygonMesh& mesh, std::vector<std::string>* notes);

class FaceColours {
 public:
  /// Of a vertex, or of a face, by its index in the mesh. Others have none.
  void set_vertex(size_t index, const Rgba& colour) { set(vertices_, index, colour); }
  void set_face(size_t index, const Rgba& colour) { set(faces_, index, colour); }

  /// Gives the faces of the mesh their colours: their own, else the mean of those of their corners,
  /// if all have one; nothing where no face has any. They are limited as above.
  void apply(PolygonMesh& mesh, std::vector<std::string>* notes) const;

 private:
  using Colours = std::vector<std::optional<Rgba>>;  ///< up to the last one that has one
  static void set(Colours& colours, size_t index, const Rgba& colour) {
    if (colours.size() <= index) colours.resize(index + 1);
    colours[index] = colour;
  }
  [[nodiscard]] std::optional<Rgba> of_corners(const PolygonMesh& mesh, size_t face) const;

  Colours vertices_, faces_;
};

/// Three or four numbers of a text file: whole numbers count to 255, others to 1. Nothing for what
/// is no colour.
std::optional<Rgba> colour_of_words(std::span<const std::string_view> words);

}  // namespace csgrun

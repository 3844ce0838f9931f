// The geometry of a leaf as a user gives it: polygons over double coordinates, in millimetres.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace csgrun {

/// Colour and material of faces. Colour components are sRGB, alpha is linear coverage. All numbers
/// are in [0,1]: trees with others are refused (kInvalidArgument, kInvalidMesh).
struct Appearance {
  float red = 0.976f, green = 0.843f, blue = 0.173f, alpha = 1.0f;
  float metallic = 0.0f, roughness = 0.6f;
  std::string name;        ///< material name, may be empty
  bool is_default = true;  ///< no colour was asked for

  bool operator==(const Appearance&) const = default;
};

/// What is inside a surface that crosses itself, by its winding number w: how often it wraps around
/// a point, counter-clockwise surface counted up, inverted surface down.
enum class FillRule : uint8_t {
  kNonZero,   ///< w != 0: whatever is enclosed, inverted parts too
  kPositive,  ///< w > 0: inverted parts are cut away
  kEvenOdd,   ///< w odd: overlaps cancel
};

/// A closed, oriented polygon mesh. A face is one outer loop, counter-clockwise seen from outside,
/// followed by its holes (clockwise). Neighbouring faces share points by index.
///
/// Faces need not be convex, and need not be exactly planar: what is not planar after quantisation
/// is triangulated (Campen & Kobbelt 2010, section 3.3).
struct PolygonMesh {
  std::vector<glm::dvec3> points;
  std::vector<uint32_t> corners;         ///< point indices of all loops, one after another
  std::vector<uint32_t> loop_starts{0};  ///< loop i is corners[loop_starts[i] .. loop_starts[i+1])
  std::vector<uint32_t> face_starts{0};  ///< face i is loops[face_starts[i] .. face_starts[i+1])
  /// Per face: 0 = flat, k > 0 = the k-th curved surface, whose facets are shaded as one.
  /// May be empty: all flat.
  std::vector<uint32_t> surface;
  /// Per face: index into `appearances`. May be empty: no colour of its own.
  std::vector<uint32_t> appearance_of;
  std::vector<Appearance> appearances;
  /// Facets of imported meshes are kept apart where nothing touches them; coplanar facets of
  /// primitives are one face.
  bool keep_facets = false;
  /// What is inside where the surface crosses itself. No matter for a surface that does not.
  FillRule fill = FillRule::kNonZero;
  /// It is meant to cross itself: there is no note about it.
  bool overlaps = false;
  /// Known to be convex; verified after rounding.
  bool convex = false;
  /// The solid is the convex hull of `points`, which is made of them on the grid; there are no
  /// faces. `appearances` may have one entry, for all of it.
  bool hull_of_points = false;
  std::string kind;  ///< "cube", "sphere", a file's name ...: for messages and source maps

  [[nodiscard]] size_t face_count() const { return face_starts.size() - 1; }
  [[nodiscard]] size_t loop_count() const { return loop_starts.size() - 1; }

  /// Appends one face of one loop.
  template <class Range>
  void add_face(const Range& loop, uint32_t surface_id = 0) {
    corners.insert(corners.end(), loop.begin(), loop.end());
    loop_starts.push_back(static_cast<uint32_t>(corners.size()));
    face_starts.push_back(static_cast<uint32_t>(loop_count()));
    surface.push_back(surface_id);
  }
};

}  // namespace csgrun

#include <utility>

#include <csgrun/primitives/mesh_file.h>

namespace csgrun {
namespace {

/// Which number something of the whole has in the piece that is being made.
class Numbers {
 public:
  explicit Numbers(size_t size) : entries_(size) {}
  /// The number in `piece`, and whether it is `next`: a new one.
  std::pair<uint32_t, bool> number(uint32_t index, uint32_t piece, size_t next) {
    Entry& entry = entries_[index];
    const bool is_new = entry.piece != piece + 1;
    if (is_new) entry = {piece + 1, static_cast<uint32_t>(next)};
    return {entry.number, is_new};
  }

 private:
  struct Entry {
    uint32_t piece = 0, number = 0;  ///< piece: 0 is none
  };
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<PolygonMesh> split_mesh(const PolygonMesh& mesh,
                                    const std::vector<uint32_t>& piece_of_face, uint32_t count) {
  std::vector<std::vector<uint32_t>> faces(count);
  for (uint32_t f = 0; f < mesh.face_count(); ++f) faces[piece_of_face[f]].push_back(f);
  std::vector<PolygonMesh> pieces(count);
  Numbers points(mesh.points.size()), looks(mesh.appearances.size());
  for (uint32_t p = 0; p < count; ++p) {
    PolygonMesh& piece = pieces[p];
    piece.kind = mesh.kind;
    piece.keep_facets = mesh.keep_facets;
    piece.fill = mesh.fill;
    for (const uint32_t f : faces[p]) {
      for (uint32_t l = mesh.face_starts[f]; l < mesh.face_starts[f + 1]; ++l) {
        for (uint32_t i = mesh.loop_starts[l]; i < mesh.loop_starts[l + 1]; ++i) {
          const auto [corner, is_new] = points.number(mesh.corners[i], p, piece.points.size());
          if (is_new) piece.points.push_back(mesh.points[mesh.corners[i]]);
          piece.corners.push_back(corner);
        }
        piece.loop_starts.push_back(static_cast<uint32_t>(piece.corners.size()));
      }
      piece.face_starts.push_back(static_cast<uint32_t>(piece.loop_count()));
      if (!mesh.surface.empty()) piece.surface.push_back(mesh.surface[f]);
      if (mesh.appearance_of.empty()) continue;
      const uint32_t look = mesh.appearance_of[f];
      const auto [number, is_new] = looks.number(look, p, piece.appearances.size());
      if (is_new) piece.appearances.push_back(mesh.appearances[look]);
      piece.appearance_of.push_back(number);
    }
  }
  return pieces;
}

}  // namespace csgrun

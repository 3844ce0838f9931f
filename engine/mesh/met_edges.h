// For each of many faces the edges of others that may touch its plane near it, and the faces that
// pass through the plane there: many at a time, by doubles alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/in_order.h"
#include "engine/base/per_thread.h"
#include "engine/bsp/regions.h"
#include "engine/mesh/box_tree.h"

namespace csgrun {

struct FaceEdge {
  DirectedEdge edge;
  uint32_t face;
};

/// On which sides of a face's plane another face has edges near it.
struct SidesOfPlane {
  bool front = false, back = false;
  void note(int from, int to) {
    front |= from > 0 || to > 0;
    back |= from < 0 || to < 0;
  }
  [[nodiscard]] bool both() const { return front && back; }
};

class MetEdges {
 public:
  /// An edge with an end that may be in the plane, and the sides on which edges of its face are
  /// that have none.
  struct Met {
    uint32_t edge;
    SidesOfPlane sides;
  };

  /// Edges of faces together, face after face, with their boxes and a tree of these.
  MetEdges(std::span<const FaceEdge> edges, const std::vector<Box>& boxes, const BoxTree& tree,
           const CellGeometry& geometry);
  MetEdges(const MetEdges&) = delete;
  MetEdges& operator=(const MetEdges&) = delete;

  [[nodiscard]] size_t face_count() const { return starts_.size() - 1; }
  [[nodiscard]] uint32_t face(size_t place) const { return edges_[starts_[place]].face; }
  /// The edges of a face are [start(place), start(place + 1)).
  [[nodiscard]] uint32_t start(size_t place) const { return starts_[place]; }
  [[nodiscard]] const Box& box(size_t place) const { return face_boxes_[place]; }

  /// Calls take(place, met) for one face after another, while others are looked at: what was met,
  /// by edges. Pairs of faces of which one is known to have edges on both sides of the other's
  /// plane are appended to `straddling`, the lower first, some twice: at least those that pass
  /// through each other, as an edge of one crosses the other there, or ends on it. `plane_of(face)`
  /// is the approximate plane; it must not change. O(n log n) and the pairs of faces and edges
  /// whose boxes meet, along the axes and along the directions of a part that stands aslant
  /// (box_frame.h).
  template <class PlaneOf, class Take>
  void each(PlaneOf&& plane_of, Take&& take,
            std::vector<std::pair<uint32_t, uint32_t>>& straddling) const {
    constexpr size_t kEach = 64;
    const size_t parts = part_count(face_count(), kEach);
    std::vector<Part> ring(std::min(parts, parts_ahead()));
    PerThread seen([] { return Seen(); });
    make_parts_in_order(
        parts,
        [&](size_t number) {
          Part& part = ring[number % ring.size()];
          part = {};
          const size_t end = std::min(face_count(), (number + 1) * kEach);
          for (size_t place = number * kEach; place < end; ++place) {
            find(place, plane_of(face(place)), part, seen.local());
          }
        },
        [&](size_t number) {
          const Part& part = ring[number % ring.size()];
          straddling.insert(straddling.end(), part.straddling.begin(), part.straddling.end());
          size_t first = 0;
          for (size_t i = 0; i < part.ends.size(); ++i) {
            take(number * kEach + i, std::span(part.met).subspan(first, part.ends[i] - first));
            first = part.ends[i];
          }
        });
  }

 private:
  struct Part {
    std::vector<Met> met;
    std::vector<size_t> ends;  ///< of what each face met
    std::vector<std::pair<uint32_t, uint32_t>> straddling;
  };
  /// Per face, the sides that were seen, and the place of the face of whose plane.
  struct Seen {
    struct Entry {
      uint32_t of = ~0u;
      SidesOfPlane sides;
    };
    std::vector<Entry> entries;
  };

  void find_frame();
  void find(size_t place, const std::array<double, 4>& plane, Part& part, Seen& seen) const;
  [[nodiscard]] Box box_of_edge(uint32_t e) const;

  std::span<const FaceEdge> edges_;
  const BoxTree& tree_;
  /// Boxes along a frame, if there is one that makes them small.
  struct Framed {
    std::vector<Box> edges, faces;
    std::optional<BoxTree> tree;
  };
  std::optional<Framed> framed_;
  std::vector<std::array<std::array<double, 3>, 2>> ends_;  ///< of edges, rounded
  std::vector<uint32_t> starts_;
  std::vector<Box> face_boxes_;
  uint32_t faces_ = 0;  ///< numbers are below
};

}  // namespace csgrun

#include "engine/mesh/met_edges.h"

#include <algorithm>
#include <cmath>

#include "engine/exact/predicates.h"
#include "engine/mesh/box_frame.h"

namespace csgrun {

MetEdges::MetEdges(std::span<const FaceEdge> edges, const std::vector<Box>& boxes,
                   const BoxTree& tree, const CellGeometry& geometry)
    : edges_(edges), tree_(tree) {
  ends_.reserve(edges.size());
  for (uint32_t e = 0; e < edges.size(); ++e) {
    const DirectedEdge& edge = edges[e].edge;
    ends_.push_back({geometry.point(edge.from).rounded, geometry.point(edge.to).rounded});
    if (e == 0 || edges[e].face != edges[e - 1].face) {
      starts_.push_back(e);
      face_boxes_.push_back(boxes[e]);
    }
    face_boxes_.back().include(boxes[e]);
    faces_ = std::max(faces_, edges[e].face + 1);
  }
  starts_.push_back(static_cast<uint32_t>(edges.size()));
  find_frame();
}

/// Of boxes along the directions of a sample of the faces.
void MetEdges::find_frame() {
  std::vector<std::array<Vec3d, 3>> sample;
  for (size_t place = 0, step = face_count() / kFrameSample + 1; place < face_count();
       place += step) {
    const uint32_t first = start(place);
    if (start(place + 1) - first < 3) continue;
    sample.push_back({ends_[first][0], ends_[first][1], ends_[first + 1][1]});
  }
  const std::optional<BoxFrame> frame = find_box_frame(sample);
  if (!frame) return;
  double reach = 0;
  for (const Box& box : face_boxes_) {
    for (size_t k = 0; k < 3; ++k) {
      reach = std::max({reach, std::fabs(box.lo[k]), std::fabs(box.hi[k])});
    }
  }
  framed_.emplace();
  framed_->edges.reserve(edges_.size());
  for (const auto& ends : ends_) framed_->edges.push_back(box_along(*frame, ends, reach));
  for (size_t place = 0; place < face_count(); ++place) {
    framed_->faces.push_back(framed_->edges[start(place)]);
    for (uint32_t e = start(place) + 1; e < start(place + 1); ++e) {
      framed_->faces.back().include(framed_->edges[e]);
    }
  }
  framed_->tree.emplace(framed_->edges);
}

Box MetEdges::box_of_edge(uint32_t e) const {
  Box box{ends_[e][0], ends_[e][0]};
  box.include({ends_[e][1], ends_[e][1]});
  return box;
}

void MetEdges::find(size_t place, const std::array<double, 4>& plane, Part& part,
                    Seen& seen) const {
  seen.entries.resize(faces_);
  const uint32_t f = face(place);
  const size_t first = part.met.size();
  const auto meet = [&](uint32_t e) {
    const uint32_t g = edges_[e].face;
    if (g == f) return;
    const int from = filter_side(plane, ends_[e][0]), to = filter_side(plane, ends_[e][1]);
    if (from == 0 || to == 0) {
      part.met.push_back({e, {}});
      return;
    }
    Seen::Entry& entry = seen.entries[g];
    if (entry.of != place) entry = {static_cast<uint32_t>(place), {}};
    if (entry.sides.both()) return;
    entry.sides.note(from, to);
    if (entry.sides.both()) part.straddling.push_back(std::minmax(f, g));
  };
  if (framed_) {
    framed_->tree->visit_all(framed_->faces[place], [&](uint32_t e) {
      if (box_of_edge(e).overlaps(face_boxes_[place])) meet(e);
    });
  } else {
    tree_.visit_all(face_boxes_[place], meet);
  }
  // In the order of edges: nothing may depend on the tree.
  std::sort(part.met.begin() + static_cast<long>(first), part.met.end(),
            [](const Met& a, const Met& b) { return a.edge < b.edge; });
  for (size_t i = first; i < part.met.size(); ++i) {
    const Seen::Entry& entry = seen.entries[edges_[part.met[i].edge].face];
    if (entry.of == place) part.met[i].sides = entry.sides;
  }
  part.ends.push_back(part.met.size());
}

}  // namespace csgrun

#include "tests/support/leaf_ways.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "engine/bsp/corner_walk.h"
#include "engine/csg/convex_leaf.h"
#include "engine/csg/flat_sides.h"
#include "engine/csg/leaf_faces.h"
#include "engine/csg/quantise.h"

namespace csgrun::test {

std::vector<IVec3> stretched(std::vector<IVec3> points, int64_t by) {
  for (IVec3& p : points) {
    for (int64_t& x : p) x *= by;
  }
  return points;
}

bool nothing_in_front(const LeafGeometry& leaf) {
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f];
    CornerPlane plane;
    if (!corner_plane(leaf.vertices, &leaf.corners[begin], leaf.face_starts[f + 1] - begin,
                      plane)) {
      return false;
    }
    for (const IVec3& v : leaf.vertices) {
      if (plane.side(v) > 0) return false;
    }
  }
  return true;
}

bool has_one_face_in_each_plane(const LeafGeometry& leaf) {
  for (size_t f = 0; f < leaf.face_count(); ++f) {
    const uint32_t begin = leaf.face_starts[f], count = leaf.face_starts[f + 1] - begin;
    CornerPlane plane;
    if (!corner_plane(leaf.vertices, &leaf.corners[begin], count, plane)) return false;
    if (std::count_if(leaf.vertices.begin(), leaf.vertices.end(),
                      [&](const IVec3& v) { return plane.side(v) == 0; }) != count) {
      return false;
    }
  }
  return true;
}

void expect_same_both_ways(const PolygonMesh& mesh, const std::vector<IVec3>& points, bool turn,
                           Tally& tally, int64_t stretch) {
  const std::vector<uint32_t> appearance(mesh.face_count(), 3);
  const PreparedLeaf quick = prepare_leaf(mesh, points, turn, appearance);
  const PreparedLeaf slow = prepare_leaf(mesh, stretched(points, stretch), turn, appearance);
  if (const auto taken = take_convex_faces(mesh, points, turn, appearance)) {
    ++tally.quick;
    tally.merged += taken->merged;
  }
  ASSERT_EQ(quick.status, slow.status);
  EXPECT_EQ(quick.crossings, slow.crossings);
  EXPECT_EQ(quick.connected, slow.connected);
  tally.good += quick.status == PreparedLeaf::Status::kGood;
  tally.tangled += quick.status == PreparedLeaf::Status::kTangled;
  tally.flat += quick.status == PreparedLeaf::Status::kFlat;
  tally.open += quick.status == PreparedLeaf::Status::kOpen;
  tally.crossings += quick.crossings.size();
  ASSERT_EQ(quick.geometry == nullptr, slow.geometry == nullptr);
  if (!quick.geometry) return;
  EXPECT_EQ(stretched({quick.box.lo, quick.box.hi}, stretch),
            (std::vector<IVec3>{slow.box.lo, slow.box.hi}));
  const LeafGeometry& a = *quick.geometry;
  LeafGeometry b = *slow.geometry;
  for (const LeafGeometry* leaf : std::array<const LeafGeometry*, 2>{&a, &b}) {
    if (leaf->opposite.empty()) continue;
    EXPECT_EQ(leaf->has_single_fans, find_vertices_of_fans(*leaf).empty());
  }
  // The general way believes no mesh that does not promise to be convex; sides of convex bodies are
  // one face.
  EXPECT_TRUE(a.convex || !b.convex);
  tally.convex += a.convex && !b.convex;
  if (a.convex && !b.convex) join_flat_faces(b);
  EXPECT_EQ(stretched(a.vertices, stretch), b.vertices);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.face_starts, b.face_starts);
  const size_t faces = a.face_count();
  EXPECT_EQ(a.facet.list(faces), b.facet.list(faces));
  EXPECT_EQ(a.surface.list(faces), b.surface.list(faces));
  EXPECT_EQ(a.appearance.list(faces), b.appearance.list(faces));
  EXPECT_EQ(a.opposite, b.opposite);
  EXPECT_TRUE(!a.convex || nothing_in_front(a));
  tally.sharp += !a.may_have_flat_edges;
  EXPECT_TRUE(a.may_have_flat_edges || (a.convex && has_one_face_in_each_plane(a)));
  EXPECT_EQ(a.may_touch, b.may_touch);
}

}  // namespace csgrun::test

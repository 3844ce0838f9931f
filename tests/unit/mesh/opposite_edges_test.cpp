// Edges and their reverses, against a list of all directed edges by their ends.
#include "engine/mesh/opposite_edges.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_solids.h"

namespace csgrun::opposite_edges_test {
namespace {

using Face = std::vector<uint32_t>;

LeafGeometry leaf_of(const std::vector<Face>& faces) {
  LeafGeometry leaf;
  uint32_t most = 0;
  for (const Face& face : faces) {
    for (const uint32_t v : face) most = std::max(most, v);
    leaf.corners.insert(leaf.corners.end(), face.begin(), face.end());
    leaf.face_starts.push_back(static_cast<uint32_t>(leaf.corners.size()));
  }
  leaf.vertices.resize(most + 1);
  return leaf;
}

/// A prism over a polygon with so many sides, closed by fans around two points, or by polygons.
std::vector<Face> prism(uint32_t sides, bool with_fans, uint32_t first = 0) {
  std::vector<Face> faces;
  const auto low = [&](uint32_t i) { return first + 2 + 2 * (i % sides); };
  const auto high = [&](uint32_t i) { return low(i) + 1; };
  Face floor, roof;
  for (uint32_t i = 0; i < sides; ++i) {
    faces.push_back({low(i), low(i + 1), high(i + 1)});
    faces.push_back({low(i), high(i + 1), high(i)});
    if (with_fans) {
      faces.push_back({first, low(i + 1), low(i)});
      faces.push_back({first + 1, high(i), high(i + 1)});
    }
    floor.insert(floor.begin(), low(i));
    roof.push_back(high(i));
  }
  if (!with_fans) faces.insert(faces.end(), {floor, roof});
  return faces;
}

struct Tally {
  int paired = 0, balanced = 0, open = 0;
};

void expect_pairs(const std::vector<Face>& faces, Tally& tally) {
  const LeafGeometry leaf = leaf_of(faces);
  std::map<std::pair<uint32_t, uint32_t>, std::vector<uint32_t>> by_ends;
  for (size_t f = 0; f < faces.size(); ++f) {
    for (size_t i = 0; i < faces[f].size(); ++i) {
      by_ends[{faces[f][i], faces[f][(i + 1) % faces[f].size()]}].push_back(
          leaf.face_starts[f] + static_cast<uint32_t>(i));
    }
  }
  bool is_balanced = true, all_paired = true;
  std::vector<uint32_t> opposite(leaf.corners.size());
  for (const auto& [ends, edges] : by_ends) {
    const auto reverse = by_ends.find({ends.second, ends.first});
    const size_t count = reverse == by_ends.end() ? 0 : reverse->second.size();
    is_balanced = is_balanced && count == edges.size();
    all_paired = all_paired && count == 1 && edges.size() == 1;
    if (count > 0) opposite[edges[0]] = reverse->second[0];
  }
  const EdgePairing pairing = pair_edges(leaf);
  ASSERT_EQ(pairing.is_balanced, is_balanced);
  if (is_balanced && all_paired) {
    ASSERT_EQ(pairing.opposite, opposite);
  } else {
    ASSERT_TRUE(pairing.opposite.empty());
  }
  ++(!is_balanced ? tally.open : all_paired ? tally.paired : tally.balanced);
}

TEST(OppositeEdges, ArePairedWhereEachIsThereOnce) {
  test::Random random(711);
  Tally tally;
  for (int round = 0; round < 400; ++round) {
    // At a vertex of so many faces edges look for their reverse, or leave it to the other end.
    const auto sides = static_cast<uint32_t>(random.integer(3, round % 3 == 0 ? 300 : 20));
    std::vector<Face> faces = prism(sides, round % 5 != 0);
    switch (random.integer(0, 6)) {
      case 0: {  // another one, with the same vertices: each edge twice
        const std::vector<Face> again = prism(sides, true);
        faces.insert(faces.end(), again.begin(), again.end());
        break;
      }
      case 1: {  // another one that shares two vertices
        const std::vector<Face> other = prism(sides, true, 2 * sides);
        faces.insert(faces.end(), other.begin(), other.end());
        break;
      }
      case 2:  // one missing, there twice, or turned over
        faces.erase(faces.begin() + random.integer(0, static_cast<int64_t>(faces.size()) - 1));
        break;
      case 3:
        faces.push_back(
            faces[static_cast<size_t>(random.integer(0, static_cast<int64_t>(faces.size()) - 1))]);
        break;
      case 4: {
        Face& face =
            faces[static_cast<size_t>(random.integer(0, static_cast<int64_t>(faces.size()) - 1))];
        std::reverse(face.begin(), face.end());
        break;
      }
      case 5: {  // the same number of edges lack their reverse and have two
        Face turned = faces[0];
        std::reverse(turned.begin(), turned.end());
        faces.erase(faces.begin() + 1 + random.integer(0, 2 * sides - 2));
        faces.push_back(turned);
        break;
      }
      default:
        break;
    }
    // In any order, from any corner on, and with any numbers.
    for (size_t i = faces.size(); i > 1; --i) {
      std::swap(faces[i - 1],
                faces[static_cast<size_t>(random.integer(0, static_cast<int64_t>(i) - 1))]);
    }
    std::vector<uint32_t> number(4 * 300 + 8);
    for (uint32_t v = 0; v < number.size(); ++v) number[v] = v;
    for (size_t i = number.size(); i > 1; --i) {
      std::swap(number[i - 1],
                number[static_cast<size_t>(random.integer(0, static_cast<int64_t>(i) - 1))]);
    }
    for (Face& face : faces) {
      std::rotate(face.begin(),
                  face.begin() + random.integer(0, static_cast<int64_t>(face.size()) - 1),
                  face.end());
      for (uint32_t& v : face) v = number[v];
    }
    ASSERT_NO_FATAL_FAILURE(expect_pairs(faces, tally)) << "round " << round;
  }
  EXPECT_GT(tally.paired, 60);
  EXPECT_GT(tally.balanced, 40);
  EXPECT_GT(tally.open, 100);
}

// A face that is there twice, at whose corners so many edges meet that they are looked at in turns:
// nothing else shows that its edges are.
TEST(OppositeEdges, AreNotPairedWhereOneIsHidden) {
  test::Random random(712);
  Tally tally;
  for (int round = 0; round < 200; ++round) {
    // A tetrahedron, faces of which are parted around new points, but for the one that is kept.
    const Face kept{0, 1, 2};
    std::vector<Face> faces{{0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    for (uint32_t v = 4; v < 40; ++v) {
      const auto parted = random.integer(0, static_cast<int64_t>(faces.size()) - 1);
      const Face f = faces[static_cast<size_t>(parted)];
      faces[static_cast<size_t>(parted)] = {f[0], f[1], v};
      faces.push_back({f[1], f[2], v});
      faces.push_back({f[2], f[0], v});
    }
    faces.push_back(kept);
    if (round % 4 != 0) faces.push_back(kept);
    for (size_t i = faces.size(); i > 1; --i) {
      std::swap(faces[i - 1],
                faces[static_cast<size_t>(random.integer(0, static_cast<int64_t>(i) - 1))]);
    }
    ASSERT_NO_FATAL_FAILURE(expect_pairs(faces, tally)) << "round " << round;
  }
  EXPECT_EQ(tally.paired, 50);
  EXPECT_EQ(tally.open, 150);
}

TEST(OppositeEdges, OfNothing) {
  const EdgePairing pairing = pair_edges(leaf_of({}));
  EXPECT_TRUE(pairing.is_balanced);
  EXPECT_TRUE(pairing.opposite.empty());
}

}  // namespace
}  // namespace csgrun::opposite_edges_test

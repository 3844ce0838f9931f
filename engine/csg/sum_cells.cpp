#include "engine/csg/sum_cells.h"

#include <cmath>

#include "engine/csg/wide_normal.h"
#include "engine/exact/fixed_int.h"
#include "engine/mesh/edge_table.h"

namespace csgrun {
namespace {

/// The sign of u (a x b), for u as in the header: of the first coordinate that is not 0.
int turn(const WideNormal& a, const WideNormal& b) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double p = a.near[j] * b.near[k], q = a.near[k] * b.near[j], difference = p - q;
    // Each product is within 2^-50 of itself, and the difference is rounded once more.
    const double bound = (std::fabs(p) + std::fabs(q)) * 0x1p-49;
    if (difference > bound) return 1;
    if (difference < -bound) return -1;
    if (p == 0 && q == 0) continue;
    using Wide = Int<2>;
    // Products are at most 2^166.
    const Int<3> x = multiply<3>(Wide::from_int128(a.exact[j]), Wide::from_int128(b.exact[k]));
    const Int<3> y = multiply<3>(Wide::from_int128(a.exact[k]), Wide::from_int128(b.exact[j]));
    if (const int sign = (x - y).sign(); sign != 0) return sign;
  }
  return 0;
}

/// An edge whose inner angle is less than 180 degrees.
struct ConvexEdge {
  uint32_t low, high;
  uint32_t left, right;  ///< the face that runs it upwards, and the one that runs it down
};

/// What counts of one operand.
class Summand {
 public:
  explicit Summand(const LeafGeometry& leaf) : leaf_(leaf) {
    normals_.resize(leaf.face_count());
    for (uint32_t f = 0; f < leaf.face_count(); ++f) normals_[f] = WideNormal::of(leaf, f);
    const EdgeTable table(leaf);
    leads_up_.assign(leaf.vertices.size(), 0);
    leads_down_.assign(leaf.vertices.size(), 0);
    for (uint32_t low = 0; low < leaf.vertices.size(); ++low) {
      for (const EdgeTable::Edge& run : table.leaving(low)) {
        if (leaf.vertices[run.to] < leaf.vertices[low]) continue;
        leads_up_[low] = leads_down_[run.to] = 1;
        for (const EdgeTable::Edge& back : table.between(run.to, low)) {
          if (turn(normals_[run.face], normals_[back.face]) > 0) {
            edges_.push_back({low, run.to, run.face, back.face});
          }
        }
      }
    }
  }

  [[nodiscard]] const std::vector<WideNormal>& normals() const { return normals_; }
  [[nodiscard]] const std::vector<ConvexEdge>& edges() const { return edges_; }
  [[nodiscard]] IVec3 upwards(const ConvexEdge& edge) const {
    const IVec3 &low = leaf_.vertices[edge.low], &high = leaf_.vertices[edge.high];
    return {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
  }
  [[nodiscard]] std::vector<uint32_t> peaks() const { return those(leads_down_, leads_up_); }
  [[nodiscard]] std::vector<uint32_t> pits() const { return those(leads_up_, leads_down_); }

 private:
  static std::vector<uint32_t> those(const std::vector<uint8_t>& with,
                                     const std::vector<uint8_t>& without) {
    std::vector<uint32_t> result;
    for (uint32_t v = 0; v < with.size(); ++v) {
      if (with[v] != 0 && without[v] == 0) result.push_back(v);
    }
    return result;
  }

  const LeafGeometry& leaf_;
  std::vector<WideNormal> normals_;
  std::vector<ConvexEdge> edges_;
  std::vector<uint8_t> leads_up_, leads_down_;  // per vertex: whether an edge does
};

/// The prisms of edges of one operand and faces of the other.
///
/// Let d be the edge upwards, l and r the normals of its left and right face, with l x r along d,
/// and n that of the other operand's face. For an edge of A, u is to be a sum of l, r and -n. Its
/// weights have the signs of
///   u (n x r),  u (l x n),  -(n d),
/// where the last one is that of u d too, which is positive. An edge of B is met as one of x - B,
/// with normals -l and -r; u is to be a sum of these and n: the first two signs stay and the last
/// one is that of n d. `sense` is +1 for edges of A, -1 for those of B.
std::vector<SumPrism> prisms(const Summand& with_edges, const Summand& with_faces, int sense) {
  std::vector<SumPrism> result;
  const std::vector<WideNormal>& faces = with_faces.normals();
  for (const ConvexEdge& edge : with_edges.edges()) {
    const WideNormal &left = with_edges.normals()[edge.left],
                     &right = with_edges.normals()[edge.right];
    const IVec3 along = with_edges.upwards(edge);
    for (uint32_t f = 0; f < faces.size(); ++f) {
      if (turn(left, faces[f]) <= 0 || turn(faces[f], right) <= 0) continue;
      if (faces[f].side(along) == -sense) result.push_back({edge.low, edge.high, f});
    }
  }
  return result;
}

}  // namespace

SumCells sum_cells(const LeafGeometry& a, const LeafGeometry& b) {
  const Summand of_a(a), of_b(b);
  return {of_a.peaks(), of_b.pits(), prisms(of_a, of_b, 1), prisms(of_b, of_a, -1)};
}

}  // namespace csgrun

#include "tests/support/fuzz/case.h"

#include <sstream>

namespace csgrun::test {

size_t FuzzNode::node_count() const {
  size_t n = 1;
  for (const FuzzNode& c : children) n += c.node_count();
  return n;
}

size_t FuzzNode::leaf_count() const {
  size_t n = leaf >= 0;
  for (const FuzzNode& c : children) n += c.leaf_count();
  return n;
}

LeafGeometry geometry_of(const FuzzLeaf& leaf) {
  return *make_leaf(leaf.faces, leaf.keep_facets, 0, leaf.appearance);
}

void write(std::ostream& out, const FuzzNode& n) {
  if (n.leaf >= 0) {
    out << n.leaf;
    return;
  }
  out << "( " << (n.hull ? "hull" : std::string(1, "+*-^"[static_cast<int>(n.op)]));
  if (n.hull) out << ' ' << n.hull->orientation_sensitive << ' ' << n.hull->keep_voids;
  for (const FuzzNode& c : n.children) {
    out << ' ';
    write(out, c);
  }
  out << " )";
}

std::string text(const FuzzCase& c) {
  std::ostringstream out;
  for (size_t f = 1; f < c.frames.size(); ++f) {
    out << "frame";
    for (const auto& row : c.frames[f].matrix) {
      for (const int64_t v : row) out << ' ' << v;
    }
    out << '\n';
  }
  for (const FuzzLeaf& l : c.leaves) {
    out << "leaf fill " << static_cast<int>(l.fill) << " crosses " << l.may_cross << " facets "
        << l.keep_facets << " appearance " << l.appearance << " move " << l.move[0] << ' '
        << l.move[1] << ' ' << l.move[2] << " frame " << l.frame << '\n';
    for (const Loop& loop : l.faces) {
      out << "  face " << loop.size();
      for (const IVec3& p : loop) out << "  " << p[0] << ' ' << p[1] << ' ' << p[2];
      out << '\n';
    }
  }
  out << "options limit " << c.options.cell_limit << " shift " << c.options.octree_shift[0] << ' '
      << c.options.octree_shift[1] << ' ' << c.options.octree_shift[2] << " literal "
      << c.options.literal_cells << " nest " << c.nest << '\n';
  out << "tree ";
  write(out, c.tree);
  out << '\n';
  return out.str();
}

namespace {

class FuzzCaseReader {
 public:
  explicit FuzzCaseReader(const std::string& given) : in_(given) {}

  /// Nothing when the text is not a case.
  std::optional<FuzzCase> read() {
    FuzzCase c;
    for (std::string word; in_ >> word;) {
      if (word == "frame") {
        Frame& f = c.frames.emplace_back();
        f.is_identity = false;
        for (auto& row : f.matrix) {
          for (int64_t& v : row) in_ >> v;
        }
      } else if (word == "leaf") {
        FuzzLeaf& l = c.leaves.emplace_back();
        int fill = 0;
        skip("fill") >> fill;
        l.fill = static_cast<FillRule>(fill);
        skip("crosses") >> l.may_cross;
        skip("facets") >> l.keep_facets;
        skip("appearance") >> l.appearance;
        skip("move") >> l.move[0] >> l.move[1] >> l.move[2];
        skip("frame") >> l.frame;
      } else if (word == "face" && !c.leaves.empty()) {
        size_t corners = 0;
        in_ >> corners;
        Loop& loop = c.leaves.back().faces.emplace_back(corners < 1000 ? corners : 0);
        for (IVec3& p : loop) in_ >> p[0] >> p[1] >> p[2];
      } else if (word == "options") {
        skip("limit") >> c.options.cell_limit;
        auto& s = c.options.octree_shift;
        skip("shift") >> s[0] >> s[1] >> s[2];
        skip("literal") >> c.options.literal_cells;
        skip("nest") >> c.nest;
      } else if (word == "tree") {
        std::string first;
        in_ >> first;
        if (!node(first, c.tree)) return std::nullopt;
        // The stream ends with the tree, or nothing is wrong with it.
        if (in_.bad() || c.leaves.size() != c.tree.leaf_count()) return std::nullopt;
        return c;
      } else {
        return std::nullopt;
      }
      if (!in_) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  std::istream& skip(const char* expected) {
    std::string word;
    if (in_ >> word && word != expected) in_.setstate(std::ios::failbit);
    return in_;
  }
  bool node(const std::string& word, FuzzNode& n) {
    if (word != "(") {
      n.leaf = std::atoi(word.c_str());
      return !word.empty();
    }
    std::string what, child;
    in_ >> what;
    if (what == "hull") {
      n.hull.emplace();
      in_ >> n.hull->orientation_sensitive >> n.hull->keep_voids;
    } else {
      const size_t op = what.empty() ? std::string::npos : std::string("+*-^").find(what[0]);
      if (op == std::string::npos) return false;
      n.op = static_cast<BooleanOp>(op);
    }
    while (in_ >> child && child != ")") {
      if (!node(child, n.children.emplace_back())) return false;
    }
    return child == ")" && !n.children.empty() && (!n.hull || n.children.size() == 1);
  }

  std::istringstream in_;
};

}  // namespace

std::optional<FuzzCase> read_fuzz_case(const std::string& given) {
  return FuzzCaseReader(given).read();
}

}  // namespace csgrun::test

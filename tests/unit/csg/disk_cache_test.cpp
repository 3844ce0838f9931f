// The cache on disk: what is read is what was written, or nothing; and solids are the same with it.
#include "engine/csg/disk_cache.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/csg/boundary_bytes.h"
#include "test_meshes.h"

namespace csgrun::disk_cache_test {
namespace {

using namespace testing;
namespace fs = std::filesystem;

/// A folder that is gone afterwards.
class DiskCacheTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() /
              ("csgrun_cache_" + std::to_string(::getpid()) + "_" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string folder() const { return folder_.string(); }
  [[nodiscard]] std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    if (!fs::exists(folder_)) return all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.push_back(entry.path());
    std::sort(all.begin(), all.end());
    return all;
  }
  [[nodiscard]] EvaluateOptions options() const {
    EvaluateOptions options;
    options.threads = 1;
    options.disk_cache.folder = folder();
    options.disk_cache.least_seconds = 0;
    return options;
  }

 private:
  fs::path folder_;
};

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

constexpr uint64_t kMuch = 1 << 20;

TEST_F(DiskCacheTest, OthersReadWhatOneWrote) {
  const std::string none, some("a\0b", 3), many(100000, 'x');
  {
    DiskCache cache(folder(), kMuch);
    EXPECT_FALSE(cache.has_entries());
    EXPECT_EQ(cache.read({1, 2}), std::nullopt);
    cache.write({1, 2}, some);
    cache.write({1, 3}, none);
    cache.write({~uint64_t{0}, 0}, many);
    EXPECT_EQ(cache.read({1, 2}), some);
  }
  DiskCache cache(folder(), kMuch);
  EXPECT_TRUE(cache.has_entries());
  EXPECT_EQ(cache.read({1, 2}), some);
  EXPECT_EQ(cache.read({1, 3}), none);
  EXPECT_EQ(cache.read({~uint64_t{0}, 0}), many);
  EXPECT_EQ(cache.read({2, 1}), std::nullopt);
  EXPECT_EQ(files().size(), 3u) << "something unfinished is left";
}

TEST_F(DiskCacheTest, DamagedEntriesAreNone) {
  const Key key{3, 4};
  const std::string value = "what was evaluated";
  DiskCache(folder(), kMuch).write(key, value);
  ASSERT_EQ(files().size(), 1u);
  const fs::path path = files()[0];
  const std::string good = bytes_of(path);
  const auto expect_none = [&](const std::string& damaged) {
    write_bytes(path, damaged);
    EXPECT_EQ(DiskCache(folder(), kMuch).read(key), std::nullopt);
    EXPECT_FALSE(fs::exists(path)) << "it stays in the way";
  };
  for (size_t i = 0; i < good.size(); ++i) {
    for (const char bit : {1, -128}) {
      std::string damaged = good;
      damaged[i] = static_cast<char>(damaged[i] ^ bit);
      expect_none(damaged);
    }
    expect_none(good.substr(0, i));
  }
  expect_none(good + "x");
  // Under another name it is not that entry.
  write_bytes(path, good);
  const std::string name = path.filename().string();
  fs::rename(path, path.parent_path() / (name.substr(0, 31) + "5" + name.substr(32)));
  EXPECT_EQ(DiskCache(folder(), kMuch).read({3, 5}), std::nullopt);
}

TEST_F(DiskCacheTest, TheLeastRecentlyUsedGoFirst) {
  constexpr size_t kEach = 1000, kLimit = 10 * kEach;
  const std::string value(kEach, 'x');
  const auto now = fs::file_time_type::clock::now();
  {
    DiskCache cache(folder(), kLimit);
    for (uint64_t i = 0; i < 9; ++i) cache.write({7, i}, value);
  }
  // Entry 0 is the oldest, 8 the youngest; then 0 is used.
  const std::vector<fs::path> all = files();
  ASSERT_EQ(all.size(), 9u);
  for (size_t i = 0; i < 9; ++i) {
    fs::last_write_time(all[i], now - std::chrono::hours(20 - i));
  }
  write_bytes(folder() + "/notes.txt", std::string(2 * kLimit, 'n'));
  const std::string entry = folder() + "/" + std::string(31, '0') + "a.mesh";
  const std::string left = entry + ".123.unfinished";
  write_bytes(left, "left by a process that was ended");
  const std::vector<std::string> others{folder() + "/novel.unfinished", entry + ".unfinished",
                                        entry + ".1x.unfinished", entry + ".backup.1.unfinished"};
  for (const std::string& other : others) write_bytes(other, "somebody's");
  for (const fs::path& each : files()) {
    if (each.extension() == ".unfinished") fs::last_write_time(each, now - std::chrono::hours(2));
  }
  DiskCache cache(folder(), kLimit);
  EXPECT_EQ(cache.read({7, 0}), value);
  cache.write({7, 9}, value);
  cache.write({7, 10}, value);
  const auto is_there = [&](uint64_t i) { return cache.read({7, i}).has_value(); };
  EXPECT_TRUE(is_there(0));
  EXPECT_FALSE(is_there(1));
  EXPECT_FALSE(is_there(2));
  EXPECT_TRUE(is_there(8));
  EXPECT_TRUE(is_there(10));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(folder() + "/notes.txt")) << "it is not the cache's";
  for (const std::string& other : others) EXPECT_TRUE(fs::exists(other)) << other;
  cache.write({7, 11}, std::string(kLimit, 'x'));
  EXPECT_FALSE(cache.contains({7, 11})) << "larger than it may be";
}

TEST_F(DiskCacheTest, ThereAreNotTooManyEntries) {
  constexpr uint64_t kMost = DiskCache::kMostEntries;
  {
    DiskCache cache(folder(), kMuch * kMuch);
    for (uint64_t i = 0; i < kMost; ++i) cache.write({i, 1}, "x");
    EXPECT_EQ(files().size(), kMost);
    cache.write({kMost, 1}, "x");
  }
  EXPECT_EQ(files().size(), kMost - kMost / 10);
}

TEST_F(DiskCacheTest, APipeIsNoEntry) {
  DiskCache(folder(), kMuch).write({1, 2}, "x");
  const fs::path path = files()[0];
  fs::remove(path);
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(DiskCache(folder(), kMuch).read({1, 2}), std::nullopt);
}

TEST_F(DiskCacheTest, AFolderThatIsNone) {
  fs::create_directories(folder());
  write_bytes(folder() + "/file", "x");
  DiskCache cache(folder() + "/file/cache", kMuch);
  EXPECT_FALSE(cache.has_entries());
  cache.write({1, 1}, "x");
  EXPECT_EQ(cache.read({1, 1}), std::nullopt);
  EXPECT_NE(cache.find_fault(), "");
  EXPECT_EQ(DiskCache(folder() + "/a/b", kMuch).find_fault(), "");
}

/// Of few keys, with much that is removed meanwhile.
TEST_F(DiskCacheTest, ManyAtOnce) {
  const auto value = [](uint64_t i) {
    return std::string(100 + 37 * i, static_cast<char>('a' + i % 20));
  };
  std::vector<std::thread> threads;
  std::atomic<size_t> hits = 0, wrong = 0;
  for (unsigned t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      std::mt19937 random(t);
      for (int round = 0; round < 40; ++round) {
        DiskCache cache(folder(), 20000);
        for (int k = 0; k < 10; ++k) {
          const uint64_t i = random() % 40;
          const auto known = cache.read({9, i});
          if (!known) {
            cache.write({9, i}, value(i));
          } else {
            ++(*known == value(i) ? hits : wrong);
          }
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(hits, 0u);
}

Appearance red(float value) {
  Appearance appearance;
  appearance.red = value;
  appearance.name = "red " + std::to_string(value);
  return appearance;
}

/// No solid: a value that differs from an empty one in each of its fields.
StoredBoundary any_stored(AppearanceTable& appearances) {
  auto leaf = std::make_shared<LeafGeometry>();
  leaf->vertices = {{1, 2, 3}, {-4, 5, int64_t{1} << 40}};
  leaf->corners = {0, 1, 1};
  leaf->face_starts = {0, 3};
  leaf->facet = FaceNumbers::ascending(7);
  leaf->surface = FaceNumbers({9});
  leaf->appearance = FaceNumbers({appearances.intern(red(0.5f))});
  leaf->opposite = {2, 1, 0};
  leaf->convex = leaf->has_single_fans = true;
  leaf->may_have_flat_edges = leaf->may_touch = false;
  UntouchedPart part;
  part.leaf = leaf;
  part.translation = {10, -11, 12};
  Frame frame;
  frame.is_identity = false;
  frame.matrix = {{{1, 2, 3}, {0, 4, 5}, {0, 0, 6}}};
  part.map = FrameMap(frame);
  part.source = 13;
  part.appearance = appearances.intern(red(0.25f));
  part.flipped = true;
  part.faces = {0};
  part.shared = {{1, 14}};
  part.world = {{0.5, -0.0, 1e300}, {1, 2, 3}};
  UntouchedPart other = part;
  other.appearance.reset();
  other.map = FrameMap();
  auto boundary = std::make_shared<BoundaryMesh>();
  boundary->may_touch = false;
  boundary->touches = {{{1, 2, 3}, {4, 5, 6}}};
  boundary->planes.push_back({Int128{1} << 100, -2, 3, -(Int128{1} << 120)});
  boundary->point_planes = {{0, 1, 2}};
  boundary->point_rounded = {{1.5, 2.5, 3.5}};
  boundary->faces.push_back(
      {PlaneId(0, true), {15, 16, 17, appearances.intern(red(0.75f))}, true, 18, 19, false});
  boundary->faces.push_back({PlaneId(0, false), {}, false, 0, 1, true});
  boundary->loop_starts = {0, 2};
  boundary->corners = {{20, 21}, {22, 23}};
  boundary->parts = {part, other};
  StoredBoundary stored;
  stored.boundary = boundary;
  stored.id = {{31, 32}, 0, {{1, 2, 0}, {1, -1, 1}}, {24, -25, 26}, appearances.intern(red(1))};
  return stored;
}

TEST(BoundaryBytes, NothingIsLost) {
  AppearanceTable first, second;
  first.intern(red(0.125f));
  const StoredBoundary stored = any_stored(first);
  const std::string bytes = to_bytes(stored, first);
  const auto read = from_bytes(bytes, stored.id.key, second);
  ASSERT_TRUE(read);
  EXPECT_EQ(to_bytes(*read, second), bytes);
  EXPECT_EQ(read->id.key, stored.id.key);
  EXPECT_EQ(read->id.frame, 0u);
  EXPECT_EQ(read->id.permutation, stored.id.permutation);
  EXPECT_EQ(read->id.origin, stored.id.origin);
  EXPECT_EQ(second.values()[read->id.paint], red(1));
  const BoundaryMesh &a = *stored.boundary, &b = *read->boundary;
  EXPECT_EQ(b.may_touch, a.may_touch);
  EXPECT_EQ(b.planes[0], a.planes[0]);
  for (size_t f = 0; f < 2; ++f) {
    EXPECT_EQ(b.faces[f].plane, a.faces[f].plane);
    EXPECT_EQ(b.faces[f].whole, a.faces[f].whole);
    EXPECT_EQ(b.faces[f].complete, a.faces[f].complete);
    EXPECT_EQ(b.faces[f].loop_count, a.faces[f].loop_count);
    EXPECT_EQ(b.faces[f].label.facet, a.faces[f].label.facet);
    EXPECT_EQ(second.values()[b.faces[f].label.appearance],
              first.values()[a.faces[f].label.appearance]);
    EXPECT_EQ(b.parts[f].flipped, a.parts[f].flipped);
    EXPECT_EQ(b.parts[f].map.frame(), a.parts[f].map.frame());
    EXPECT_EQ(b.parts[f].appearance.has_value(), a.parts[f].appearance.has_value());
  }
  EXPECT_EQ(b.parts[0].leaf, b.parts[1].leaf);
  const LeafGeometry& leaf = *b.parts[0].leaf;
  EXPECT_EQ(leaf.facet[0], 7u);
  EXPECT_TRUE(leaf.facet.count_up());
  EXPECT_EQ(second.values()[leaf.appearance[0]], red(0.5f));
  EXPECT_TRUE(leaf.convex && leaf.has_single_fans);
  EXPECT_FALSE(leaf.may_have_flat_edges || leaf.may_touch);
  EXPECT_EQ(second.values().size(), 5u) << "with the default one, but without what nothing has";
}

TEST(BoundaryBytes, PartsOfItAreNothing) {
  AppearanceTable appearances;
  const std::string bytes = to_bytes(any_stored(appearances), appearances);
  for (size_t size = 0; size < bytes.size(); ++size) {
    AppearanceTable others;
    EXPECT_FALSE(from_bytes(bytes.substr(0, size), {}, others)) << size;
  }
  EXPECT_FALSE(from_bytes(bytes + "x", {}, appearances));
}

bool equal(const Solid::Face& a, const Solid::Face& b) {
  return a.first_loop == b.first_loop && a.loop_count == b.loop_count &&
         a.appearance == b.appearance && a.surface == b.surface && a.source == b.source;
}

/// All that is written of a solid.
void expect_same(const Solid& a, const Solid& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.positions_f32, b.positions_f32);
  EXPECT_EQ(a.point_of, b.point_of);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_face, b.triangle_face);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (size_t f = 0; f < a.faces.size(); ++f) {
    ASSERT_TRUE(equal(a.faces[f], b.faces[f])) << "face " << f;
  }
  EXPECT_EQ(a.loop_starts, b.loop_starts);
  EXPECT_EQ(a.loop_vertices, b.loop_vertices);
  EXPECT_EQ(a.face_normals, b.face_normals);
  EXPECT_EQ(a.appearances, b.appearances);
  EXPECT_EQ(a.exact_points, b.exact_points);
  EXPECT_EQ(a.canonical_hash, b.canonical_hash);
  EXPECT_EQ(a.measures.volume, b.measures.volume);
  EXPECT_EQ(a.measures.centroid, b.measures.centroid);
  EXPECT_EQ(a.measures.genus, b.measures.genus);
  ASSERT_EQ(a.sources.size(), b.sources.size());
  for (size_t s = 0; s < a.sources.size(); ++s) EXPECT_EQ(a.sources[s].kind, b.sources[s].kind);
}

NodePtr painted(float red, NodePtr child) {
  Appearance appearance;
  appearance.red = red;
  appearance.is_default = false;
  return Node::painted(appearance, std::move(child), {});
}

/// Trees of few kinds of leaves, so that parts of them are often equal, turned, mirrored, painted.
class TreeMaker {
 public:
  explicit TreeMaker(unsigned seed) : random_(seed) {}

  NodePtr tree(int depth) {
    if (depth == 0) return placed(leaf());
    std::vector<NodePtr> children;
    for (unsigned i = 0, count = 2 + pick(2); i < count; ++i) {
      children.push_back(pick(4) == 0 && !made_.empty() ? placed(made_[pick(made_.size())])
                                                        : tree(depth - 1));
    }
    NodePtr made = node(std::move(children));
    made_.push_back(made);
    return placed(made);
  }

 private:
  unsigned pick(size_t count) { return static_cast<unsigned>(random_() % count); }

  NodePtr leaf() {
    switch (pick(4)) {
      case 0:
        return prism(5 + static_cast<int>(pick(3)) * 20, 1.5, 2);
      case 1:
        return testing::leaf(
            in_one(box_mesh({0, 0, 0}, {2, 2, 1}), box_mesh({1, 1, -1}, {3, 3, 3})),
            FillRule::kNonZero);
      default:
        return cube(1 + pick(2));
    }
  }

  NodePtr node(std::vector<NodePtr> children) {
    switch (pick(5)) {
      case 0:
        return intersect(std::move(children));
      case 1:
        return symmetric(std::move(children));
      case 2:
        return subtract(std::move(children));
      default:
        return unite(std::move(children));
    }
  }

  NodePtr placed(NodePtr node) {
    if (pick(3) == 0) node = turned(90.0 * pick(4), {0, 0, 1}, node);
    if (pick(6) == 0) node = turned(33, {1, 2, 3}, node);
    if (pick(6) == 0) node = Node::transformed(scaling(-1, 1, 1), node);
    if (pick(5) == 0) node = painted(0.25f * static_cast<float>(pick(3)), node);
    return moved(pick(3), pick(2) * 0.5, pick(2) * 0.5, node);
  }

  std::mt19937 random_;
  std::vector<NodePtr> made_;
};

TEST_F(DiskCacheTest, SolidsAreTheSameFromTheDisk) {
  uint64_t from_disk = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    TreeMaker maker(seed);
    const std::vector<NodePtr> parts{maker.tree(1), maker.tree(2), maker.tree(1)};
    EvaluateOptions without;
    without.threads = 1;
    without.exact_points = true;
    EvaluateOptions with = options();
    with.exact_points = true;
    const auto base = Evaluator(without).evaluate(parts);
    const auto cold = Evaluator(with).evaluate(parts);
    Evaluator again(with);
    const auto warm = again.evaluate(parts);
    ASSERT_TRUE(base && cold && warm);
    for (size_t i = 0; i < parts.size(); ++i) {
      expect_same(*(*base)[i], *(*cold)[i]);
      expect_same(*(*base)[i], *(*warm)[i]);
    }
    from_disk += again.stats().nodes_from_disk;
    if (HasFailure()) return;
  }
  EXPECT_GT(from_disk, 100u);
}

TEST_F(DiskCacheTest, WhatDidNotChangeIsNotEvaluated) {
  EvaluateOptions on_grid;  // which would depend on how far apart the parts are
  on_grid.grid = *GridStep::parse("0.001");
  EvaluateOptions with = options();
  with.grid = on_grid.grid;
  const NodePtr lid = subtract({cube(4), moved(1, 1, 1, prism(60, 1, 9))});
  const NodePtr box = subtract({cube(5), moved(2, 2, 2, prism(30, 1, 9))});
  ASSERT_TRUE(Evaluator(with).evaluate({lid, box}));
  // One part elsewhere, turned and in another colour, beside one that changed.
  const NodePtr same = painted(1, turned(90, {1, 0, 0}, moved(7, 8, 9, lid)));
  const NodePtr other = subtract({cube(5), moved(2, 2, 3, prism(30, 1, 9))});
  Evaluator evaluator(with);
  const auto solids = evaluator.evaluate({same, other});
  ASSERT_TRUE(solids);
  EXPECT_EQ(evaluator.stats().nodes_evaluated, 1u);
  EXPECT_EQ(evaluator.stats().nodes_from_disk, 1u);
  expect_same(*(*solids)[0], *solid_of(same, on_grid));
  expect_same(*(*solids)[1], *solid_of(other, on_grid));
  // What goes on from a result starts there.
  const NodePtr longer = subtract({box, moved(0, 0, 4, cube(1))});
  Evaluator more(with);
  const auto solid = more.evaluate(longer);
  ASSERT_TRUE(solid);
  EXPECT_EQ(more.stats().nodes_from_disk, 1u);
  expect_same(**solid, *solid_of(longer, on_grid));
}

TEST_F(DiskCacheTest, ColoursHaveOtherNumbersInOtherRuns) {
  const NodePtr both = unite({painted(0.5f, cube(2)), moved(1, 1, 1, painted(0.25f, cube(2)))});
  ASSERT_TRUE(Evaluator(options()).evaluate(both));
  Evaluator evaluator(options());
  ASSERT_TRUE(evaluator.evaluate(unite({painted(0.125f, cube(1)), painted(0.25f, cube(3))})));
  const auto solid = evaluator.evaluate(both);
  ASSERT_TRUE(solid);
  EXPECT_EQ(evaluator.stats().nodes_from_disk, 1u);
  expect_same(**solid, *solid_of(both));
}

TEST_F(DiskCacheTest, DamageCostsTimeOnly) {
  const NodePtr part = subtract({cube(4), moved(1, 1, 1, prism(60, 1, 9))});
  ASSERT_TRUE(Evaluator(options()).evaluate(part));
  ASSERT_EQ(files().size(), 1u);
  std::string bytes = bytes_of(files()[0]);
  bytes[bytes.size() / 2] ^= 1;
  write_bytes(files()[0], bytes);
  Evaluator evaluator(options());
  const auto solid = evaluator.evaluate(part);
  ASSERT_TRUE(solid);
  EXPECT_EQ(evaluator.stats().nodes_from_disk, 0u);
  EXPECT_EQ(evaluator.stats().nodes_evaluated, 1u);
  expect_same(**solid, *solid_of(part));
  EXPECT_EQ(files().size(), 1u) << "it was not written again";
}

TEST_F(DiskCacheTest, WhatTookLittleIsNotKept) {
  EvaluateOptions only_slow = options();
  only_slow.disk_cache.least_seconds = 1e6;
  ASSERT_TRUE(Evaluator(only_slow).evaluate(unite({cube(2), moved(1, 1, 1, cube(2))})));
  EXPECT_TRUE(files().empty());
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(DiskCacheTest, AFolderThatWasAskedForIsWarnedOf) {
  fs::create_directories(folder());
  write_bytes(folder() + "/file", "x");
  EvaluateOptions asked = options();
  asked.disk_cache.folder = folder() + "/file";
  asked.disk_cache.warn_if_unusable = true;
  Evaluator evaluator(asked);
  const auto solid = evaluator.evaluate(unite({cube(2), moved(1, 1, 1, cube(2))}));
  ASSERT_TRUE(solid);
  EXPECT_EQ((*solid)->measures.volume, 15);
  ASSERT_EQ(evaluator.warnings().size(), 1u);
  EXPECT_EQ(evaluator.warnings()[0],
            "the cache folder '" + folder() + "/file' cannot be written to: Not a directory");
}

}  // namespace
}  // namespace csgrun::disk_cache_test

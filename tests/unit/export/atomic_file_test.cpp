// A file is complete or not there; what stood there before stays until then.
#include "export/atomic_file.h"

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csgrun/export/write.h>

#include "tests/unit/export/hand_made.h"

namespace csgrun::atomic_file_test {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "csgrun-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] std::string content(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  [[nodiscard]] size_t files() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder_), {}));
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
  }

  fs::path folder_;
  std::vector<Part> parts_{{"box", testing::cube(1), {}}};
};

void expect_cannot_write(const Error& error, int reason) {
  EXPECT_EQ(error.code, ErrorCode::kCannotWrite);
  EXPECT_NE(error.message.find(std::strerror(reason)), std::string::npos) << error.message;
}

TEST_F(AtomicFileTest, AppearsOnlyOnCommit) {
  put("a", "old");
  {
    AtomicFile file;
    ASSERT_TRUE(file.write(path("a"), "new"));
    EXPECT_EQ(content("a"), "old");
    EXPECT_EQ(files(), 2u);
    ASSERT_TRUE(file.commit());
    EXPECT_EQ(content("a"), "new");
  }
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, LeavesNothingWithoutCommit) {
  {
    AtomicFile file;
    ASSERT_TRUE(file.write(path("a"), "new"));
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(AtomicFileTest, WatchdogRemovesWhatIsUnderWay) {
  AtomicFile file;
  ASSERT_TRUE(file.write(path("a"), "new"));
  EXPECT_EQ(files(), 1u);
  remove_temporary_files();
  EXPECT_EQ(files(), 0u);
  const Status status = file.commit();
  ASSERT_FALSE(status);
  expect_cannot_write(status.error(), ENOENT);
}

TEST_F(AtomicFileTest, FinishedFilesAreNotRemoved) {
  ASSERT_TRUE(write_model(path("a.stl"), parts_));
  remove_temporary_files();
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, KeepsModeAndFollowsLinks) {
  put("real.stl", "old");
  ::chmod(path("real.stl").c_str(), 0640);
  fs::create_symlink("real.stl", path("link.stl"));
  ASSERT_TRUE(write_model(path("link.stl"), parts_));
  EXPECT_TRUE(fs::is_symlink(path("link.stl")));
  EXPECT_EQ(fs::file_size(path("real.stl")), 84 + 12 * 50u);
  struct stat info {};
  ASSERT_EQ(::stat(path("real.stl").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
}

TEST_F(AtomicFileTest, LongNamesArePossible) {
  std::string name(251, 'x');
  name += ".stl";
  EXPECT_TRUE(write_model(path(name), parts_));
}

TEST_F(AtomicFileTest, MissingFolder) {
  const auto result = write_model(path("no/such/a.glb"), parts_);
  ASSERT_FALSE(result);
  expect_cannot_write(result.error(), ENOENT);
  EXPECT_NE(result.error().message.find("no/such/a.glb"), std::string::npos);
}

TEST_F(AtomicFileTest, TargetIsAFolder) {
  fs::create_directory(path("a.glb"));
  const auto result = write_model(path("a.glb"), parts_);
  ASSERT_FALSE(result);
  expect_cannot_write(result.error(), EISDIR);
  EXPECT_EQ(files(), 1u);
}

/// Root may write anywhere: such tests run as nobody.
class AsNobody {
 public:
  AsNobody() : root_(::geteuid() == 0) {
    if (root_) {
      EXPECT_EQ(::seteuid(65534), 0);
    }
  }
  ~AsNobody() {
    if (root_) {
      EXPECT_EQ(::seteuid(0), 0);
    }
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool root_;
};

TEST_F(AtomicFileTest, NoPermissionForTheFolder) {
  fs::permissions(folder_, static_cast<fs::perms>(0555));
  const AsNobody nobody;
  const auto result = write_model(path("a.glb"), parts_);
  ASSERT_FALSE(result);
  expect_cannot_write(result.error(), EACCES);
}

TEST_F(AtomicFileTest, NoPermissionForTheFile) {
  put("a.glb", "old");
  ::chmod(path("a.glb").c_str(), 0444);
  fs::permissions(folder_, static_cast<fs::perms>(0777));  // a rename would be possible
  const AsNobody nobody;
  const auto result = write_model(path("a.glb"), parts_);
  ASSERT_FALSE(result);
  expect_cannot_write(result.error(), EACCES);
  EXPECT_EQ(content("a.glb"), "old");
}

TEST_F(AtomicFileTest, FullDevice) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "there is no /dev/full";
  fs::create_symlink("/dev/full", path("full.stl"));
  const auto result = write_model(path("full.stl"), parts_);
  ASSERT_FALSE(result);
  expect_cannot_write(result.error(), ENOSPC);
  EXPECT_TRUE(fs::is_symlink(path("full.stl")));
}

TEST_F(AtomicFileTest, DevicesAreWrittenInPlace) {
  fs::create_symlink("/dev/null", path("null.stl"));
  EXPECT_TRUE(write_model(path("null.stl"), parts_));
  EXPECT_TRUE(fs::is_character_file(path("null.stl")));
}

TEST_F(AtomicFileTest, FailureHalfWayLeavesTheOldFile) {
  put("a.stl", "old");
  struct rlimit old {};
  ::getrlimit(RLIMIT_FSIZE, &old);
  struct rlimit small = old;
  small.rlim_cur = 300;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  const auto result = write_model(path("a.stl"), parts_);
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(result);
  expect_cannot_write(result.error(), EFBIG);
  EXPECT_EQ(content("a.stl"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, ObjComesWithItsMaterials) {
  ASSERT_TRUE(write_model(path("a.obj"), parts_));
  EXPECT_NE(content("a.obj").find("mtllib a.mtl\n"), std::string::npos);
  EXPECT_NE(content("a.obj").find("usemtl default\n"), std::string::npos);
  EXPECT_NE(content("a.mtl").find("newmtl default\n"), std::string::npos);
  EXPECT_EQ(files(), 2u);
}

TEST_F(AtomicFileTest, ObjWithoutRoomForItsMaterialsIsNotWritten) {
  fs::create_directory(path("a.mtl"));
  const auto result = write_model(path("a.obj"), parts_);
  ASSERT_FALSE(result);
  expect_cannot_write(result.error(), EISDIR);
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFileTest, UnknownEndingIsRefused) {
  const auto result = write_model(path("a.step"), parts_);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(files(), 0u);
}

}  // namespace
}  // namespace csgrun::atomic_file_test

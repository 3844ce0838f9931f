#include "engine/csg/disk_cache.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace csgrun {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".mesh", kUnfinished = ".unfinished";
constexpr size_t kKeyDigits = 32;
/// What an ended process left of an entry that it wrote is removed after so many seconds.
constexpr time_t kAbandoned = 3600;
constexpr std::array<char, 8> kMagic{'c', 's', 'g', 'm', 'e', 's', 'h', '1'};

struct Header {
  std::array<char, 8> magic;
  uint64_t size;
  std::array<uint64_t, 2> key, checksum;
};

std::array<uint64_t, 2> checksum_of(std::string_view bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.low64, hash.high64};
}

/// Closes a file when it goes.
class OpenFile {
 public:
  OpenFile(const std::string& path, int flags)
      : number_(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~OpenFile() {
    if (number_ >= 0) ::close(number_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  /// All of the bytes, or false.
  bool read(char* to, size_t size) const {
    while (size > 0) {
      const ssize_t count = ::read(number_, to, size);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      to += count;
      size -= static_cast<size_t>(count);
    }
    return true;
  }
  bool write(const char* from, size_t size) const {
    while (size > 0) {
      const ssize_t count = ::write(number_, from, size);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      from += count;
      size -= static_cast<size_t>(count);
    }
    return true;
  }
  /// In bytes; 0 of what is no file.
  [[nodiscard]] uint64_t size() const {
    struct stat facts {};
    if (::fstat(number_, &facts) != 0 || !S_ISREG(facts.st_mode)) return 0;
    return static_cast<uint64_t>(facts.st_size);
  }
  /// Has it be used now.
  void touch() const { ::futimens(number_, nullptr); }

 private:
  int number_;
};

/// The key in the name of an entry's file.
std::optional<Key> key_in(std::string_view name) {
  if (name.size() != kKeyDigits + kEnding.size() || !name.ends_with(kEnding)) return std::nullopt;
  Key key{};
  for (size_t i = 0; i < kKeyDigits; ++i) {
    const char c = name[i];
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_digit && (c < 'a' || c > 'f')) return std::nullopt;
    uint64_t& half = key[i / 16];
    half = half << 4 | static_cast<uint64_t>(is_digit ? c - '0' : c - 'a' + 10);
  }
  return key;
}

/// Whether an entry's file was to be of this name, by some process.
bool is_unfinished(std::string_view name) {
  constexpr size_t kEntry = kKeyDigits + kEnding.size();
  if (name.size() < kEntry || !key_in(name.substr(0, kEntry))) return false;
  name.remove_prefix(kEntry);
  if (!name.starts_with('.') || !name.ends_with(kUnfinished)) return false;
  name.remove_prefix(1);
  if (name.size() <= kUnfinished.size()) return false;
  name.remove_suffix(kUnfinished.size());
  return name.find_first_not_of("0123456789") == std::string_view::npos;
}

struct Found {
  std::string path;
  std::optional<Key> key;
  uint64_t size;
  timespec used;
};

/// Calls f(name) for what is in a folder. (Paths of std::filesystem would take a hundred times as
/// long for each.)
template <class F>
void each_name(const std::string& folder, F&& f) {
  const auto close = [](DIR* d) { ::closedir(d); };
  const std::unique_ptr<DIR, decltype(close)> open(::opendir(folder.c_str()), close);
  if (!open) return;
  while (const dirent* const entry = ::readdir(open.get())) f(std::string_view(entry->d_name));
}

/// The files of the cache in a folder; others are not looked at.
std::vector<Found> files_in(const std::string& folder) {
  std::vector<Found> files;
  each_name(folder, [&](std::string_view name) {
    const std::optional<Key> key = key_in(name);
    if (!key && !is_unfinished(name)) return;
    std::string path = folder + "/" + std::string(name);
    struct stat facts {};
    if (::lstat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return;
    files.push_back({std::move(path), key, static_cast<uint64_t>(facts.st_size), facts.st_mtim});
  });
  return files;
}

}  // namespace

DiskCache::DiskCache(std::string folder, uint64_t limit)
    : folder_(std::move(folder)), limit_(limit) {}

std::string DiskCache::path_of(const Key& key) const {
  std::array<char, kKeyDigits + 1> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx%016llx",
                static_cast<unsigned long long>(key[0]), static_cast<unsigned long long>(key[1]));
  return folder_ + "/" + digits.data() + std::string(kEnding);
}

void DiskCache::list() {
  if (std::exchange(is_listed_, true)) return;
  each_name(folder_, [&](std::string_view name) {
    if (const auto key = key_in(name)) entries_.insert(*key);
  });
}

bool DiskCache::has_entries() {
  list();
  return !entries_.empty();
}

bool DiskCache::contains(const Key& key) {
  list();
  return entries_.contains(key);
}

std::optional<std::string> DiskCache::read(const Key& key) {
  if (!contains(key)) return std::nullopt;
  const std::string path = path_of(key);
  const OpenFile file(path, O_RDONLY | O_NONBLOCK);  // a pipe of that name has nobody to write
  if (!file.is_open()) {                             // removed by another process
    entries_.erase(key);
    return std::nullopt;
  }
  Header header{};
  std::string bytes;
  const uint64_t size = file.size();
  bool is_good = size >= sizeof header &&
                 file.read(reinterpret_cast<char*>(&header), sizeof header) &&
                 header.magic == kMagic && header.key == key && header.size == size - sizeof header;
  if (is_good) {
    bytes.resize(header.size);
    is_good = file.read(bytes.data(), bytes.size()) && checksum_of(bytes) == header.checksum;
  }
  if (!is_good) {
    ::unlink(path.c_str());
    entries_.erase(key);
    return std::nullopt;
  }
  file.touch();
  return bytes;
}

std::string DiskCache::find_fault() {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (!error && ::access(folder_.c_str(), R_OK | W_OK | X_OK) != 0) {
    error = {errno, std::generic_category()};
  }
  return error ? error.message() : std::string();
}

void DiskCache::write(const Key& key, std::string_view bytes) {
  if (!may_write_ || bytes.size() > most_bytes() || contains(key)) return;
  may_write_ = find_fault().empty();
  if (!may_write_) return;
  const std::string path = path_of(key);
  const std::string unfinished = path + "." + std::to_string(::getpid()) + std::string(kUnfinished);
  const Header header{kMagic, bytes.size(), key, checksum_of(bytes)};
  {
    const OpenFile file(unfinished, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
    may_write_ = file.is_open() &&
                 file.write(reinterpret_cast<const char*>(&header), sizeof header) &&
                 file.write(bytes.data(), bytes.size());
  }
  if (may_write_) may_write_ = ::rename(unfinished.c_str(), path.c_str()) == 0;
  if (!may_write_) {
    ::unlink(unfinished.c_str());
    return;
  }
  entries_.insert(key);
  // The first time others' files are counted, and then what is written here.
  if (bytes_) *bytes_ += sizeof header + bytes.size();
  if (!bytes_ || *bytes_ > limit_ || entries_.size() > kMostEntries) make_room();
}

/// Counts what is there. Of more than the limits it removes what was not used for the longest time,
/// until nine tenths of each are left.
void DiskCache::make_room() {
  std::vector<Found> files = files_in(folder_);
  const time_t now = ::time(nullptr);
  uint64_t bytes = 0;
  entries_.clear();
  for (const Found& file : files) {
    if (file.key) {
      bytes += file.size;
      entries_.insert(*file.key);
    } else if (now - file.used.tv_sec > kAbandoned) {
      ::unlink(file.path.c_str());
    }
  }
  if (bytes > limit_ || entries_.size() > kMostEntries) {
    std::sort(files.begin(), files.end(), [](const Found& a, const Found& b) {
      if (a.used.tv_sec != b.used.tv_sec) return a.used.tv_sec < b.used.tv_sec;
      if (a.used.tv_nsec != b.used.tv_nsec) return a.used.tv_nsec < b.used.tv_nsec;
      return a.path < b.path;
    });
    const auto most = [](uint64_t limit) { return limit - limit / 10; };
    for (const Found& file : files) {
      if (bytes <= most(limit_) && entries_.size() <= most(kMostEntries)) break;
      if (!file.key) continue;
      ::unlink(file.path.c_str());
      entries_.erase(*file.key);
      bytes -= file.size;
    }
  }
  bytes_ = bytes;
}

}  // namespace csgrun

#include "export/atomic_file.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csgrun/export/write.h>

namespace csgrun {
namespace {

/// Names of temporary files, in static memory that a signal handler may read: a slot's name is
/// complete before `used` is set, and does not change while it is.
struct Slot {
  std::atomic<bool> taken{false}, used{false};
  char path[PATH_MAX]{};
};
constinit std::array<Slot, 16> registry;  // no code of the start touches its 64 kB
static_assert(std::atomic<bool>::is_always_lock_free, "the registry is read in signal handlers");

int register_temporary(const std::string& path) {
  if (path.size() >= sizeof Slot::path) return -1;
  for (size_t i = 0; i < registry.size(); ++i) {
    if (registry[i].taken.exchange(true)) continue;
    std::memcpy(registry[i].path, path.c_str(), path.size() + 1);
    registry[i].used.store(true);
    return static_cast<int>(i);
  }
  return -1;
}

void unregister_temporary(int slot) {
  if (slot < 0) return;
  registry[static_cast<size_t>(slot)].used.store(false);
  registry[static_cast<size_t>(slot)].taken.store(false);
}

Error cannot_write(const std::string& path, int reason) {
  return {ErrorCode::kCannotWrite, "cannot write '" + path + "': " + std::strerror(reason), {}};
}

int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return 0;
}

/// Writes and closes; 0 or the reason of the first failure.
int write_and_close(int file, std::string_view bytes) {
  const int failed = write_all(file, bytes);
  const int closed = ::close(file) == 0 ? 0 : errno;
  return failed != 0 ? failed : closed;
}

std::string followed(const std::string& path) {
  char* resolved = ::realpath(path.c_str(), nullptr);
  if (resolved == nullptr) return path;
  std::string result = resolved;
  std::free(resolved);
  return result;
}

/// The name does not grow with the target's, which may be as long as the file system allows.
std::string temporary_name(const std::string& target, unsigned attempt) {
  const size_t slash = target.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : target.substr(0, slash + 1);
  return folder + ".csgrun-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".tmp";
}

}  // namespace

Status AtomicFile::write(const std::string& target, std::string_view bytes) {
  shown_ = target;
  struct stat info {};
  const bool exists = ::stat(target.c_str(), &info) == 0;
  if (exists && S_ISDIR(info.st_mode)) return cannot_write(target, EISDIR);
  if (exists && !S_ISREG(info.st_mode)) {
    const int file = ::open(target.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (file < 0) return cannot_write(target, errno);
    const int reason = write_and_close(file, bytes);
    if (reason != 0) return cannot_write(target, reason);
    return std::monostate{};
  }
  // A rename would replace a file that one may not write to, if only the folder allows it.
  if (exists && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0)
    return cannot_write(target, errno);

  target_ = exists ? followed(target) : target;
  const mode_t mode = exists ? info.st_mode & 07777 : 0666;
  int file = -1;
  for (unsigned attempt = 0; file < 0; ++attempt) {
    temporary_ = temporary_name(target_, attempt);
    // Registered first: a signal between the two finds a name without a file, never the reverse.
    slot_ = register_temporary(temporary_);
    file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (file >= 0) break;
    const int reason = errno;
    unregister_temporary(slot_);
    slot_ = -1;
    temporary_.clear();
    if (reason != EEXIST) return cannot_write(target, reason);
  }
  if (exists) ::fchmod(file, mode);  // of no consequence when it fails
  const int reason = write_and_close(file, bytes);
  if (reason != 0) return cannot_write(target, reason);
  return std::monostate{};
}

Status AtomicFile::commit() {
  if (temporary_.empty()) return std::monostate{};
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) return cannot_write(shown_, errno);
  unregister_temporary(slot_);
  slot_ = -1;
  temporary_.clear();
  return std::monostate{};
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  unregister_temporary(slot_);
}

void remove_temporary_files() {
  for (Slot& slot : registry) {
    if (slot.used.load()) ::unlink(slot.path);
  }
}

}  // namespace csgrun

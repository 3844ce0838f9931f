#include "primitives/files/read_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csgrun/primitives/read_file.h>

namespace csgrun {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

/// Why nothing with this status is read, or null.
const char* refusal(const struct stat& status) {
  constexpr off_t kMostBytes = off_t{4} << 30;
  if (S_ISDIR(status.st_mode)) return "it is a directory";
  if (S_ISFIFO(status.st_mode)) return "it is a FIFO";
  if (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode)) return "it is a device";
  if (!S_ISREG(status.st_mode)) return "it is not a regular file";
  if (status.st_size >= kMostBytes) return "it is larger than 4 GB";
  return nullptr;
}

std::string system_reason() { return std::strerror(errno); }  // in English: no setlocale

}  // namespace

FileText read_whole_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return {{}, system_reason()};
  if (const char* why = refusal(status)) return {{}, why};
  // Another file may stand there by now: without O_NONBLOCK, a FIFO would wait for a writer.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) return {{}, system_reason()};
  if (const char* why = refusal(status)) return {{}, why};
  // The size may change while we read: what is read is what counts, up to the size that was seen.
  FileText text;
  text.bytes.resize(static_cast<size_t>(status.st_size));
  size_t done = 0;
  while (done < text.bytes.size()) {
    const ssize_t got = ::read(file.get(), text.bytes.data() + done, text.bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return {{}, system_reason()};
    if (got == 0) break;
    done += static_cast<size_t>(got);
  }
  text.bytes.resize(done);
  return text;
}

Result<std::string> read_regular_file(const std::string& path) {
  FileText text = read_whole_file(path);
  if (text.error.empty()) return std::move(text.bytes);
  return Error{ErrorCode::kCannotRead, path + ": cannot read: " + text.error, {}};
}

}  // namespace csgrun

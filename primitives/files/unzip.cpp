#include "primitives/files/unzip.h"

#include <algorithm>
#include <array>
#include <cstring>

#include <minizip/unzip.h>

#include "primitives/files/formats.h"

namespace csgrun {
namespace {

/// Models as text become a tenth by compression, or less: what unpacks to fifty times its size is
/// made to fill the memory.
constexpr uint64_t kMostRatio = 50, kAlwaysFine = uint64_t{16} << 20,
                   kMostBytes = uint64_t{1} << 30;
constexpr size_t kBlock = size_t{1} << 20;
constexpr int kCaseCounts = 1;

struct Memory {
  std::string_view bytes;
  size_t at = 0;
};

Memory& memory_of(voidpf stream) { return *static_cast<Memory*>(stream); }

voidpf open_memory(voidpf opaque, const void*, int) { return opaque; }
uLong read_memory(voidpf, voidpf stream, void* buffer, uLong size) {
  Memory& memory = memory_of(stream);
  const size_t count = std::min<size_t>(size, memory.bytes.size() - memory.at);
  std::memcpy(buffer, memory.bytes.data() + memory.at, count);
  memory.at += count;
  return count;
}
uLong write_memory(voidpf, voidpf, const void*, uLong) { return 0; }
ZPOS64_T tell_memory(voidpf, voidpf stream) { return memory_of(stream).at; }
long seek_memory(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  Memory& memory = memory_of(stream);
  const uint64_t from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? memory.at
                        : origin == ZLIB_FILEFUNC_SEEK_END ? memory.bytes.size()
                                                           : 0;
  if (from + offset > memory.bytes.size()) return -1;
  memory.at = static_cast<size_t>(from + offset);
  return 0;
}
int close_memory(voidpf, voidpf) { return 0; }
int no_error(voidpf, voidpf) { return 0; }

/// Closes the archive whatever happens.
struct Archive {
  unzFile file;
  ~Archive() {
    if (file != nullptr) unzClose(file);
  }
};

unzFile open_archive(Memory& memory) {
  zlib_filefunc64_def functions{};
  functions.zopen64_file = open_memory;
  functions.zread_file = read_memory;
  functions.zwrite_file = write_memory;
  functions.ztell64_file = tell_memory;
  functions.zseek64_file = seek_memory;
  functions.zclose_file = close_memory;
  functions.zerror_file = no_error;
  functions.opaque = &memory;
  return unzOpen2_64("model", &functions);
}

/// The bytes of the entry that the archive stands at.
Result<std::optional<std::string>> unpack(const std::string& name, std::string_view archive,
                                          const Archive& zip, const std::string& entry) {
  unz_file_info64 info{};
  if (unzGetCurrentFileInfo64(zip.file, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK)
    return malformed(name, entry, "the zip file is damaged");
  const uint64_t promised = info.uncompressed_size;
  // What the entry says of its packed size may be a lie; the archive's size is none.
  const uint64_t packed = std::min<uint64_t>(info.compressed_size, archive.size());
  if (promised > kMostBytes || (promised > kAlwaysFine && promised / kMostRatio > packed)) {
    Error error = malformed(name, entry,
                            "unpacks to " + std::to_string(promised) + " bytes from " +
                                std::to_string(packed) + ", which no model does");
    error.code = ErrorCode::kLimit;
    return error;
  }
  if (unzOpenCurrentFile(zip.file) != UNZ_OK)
    return malformed(name, entry, "is encrypted, or packed in a way that is not read");
  std::string bytes;
  while (bytes.size() <= promised) {
    const size_t filled = bytes.size();
    const size_t wanted = std::min<uint64_t>(kBlock, promised - filled + 1);
    bytes.resize(filled + wanted);
    const int got =
        unzReadCurrentFile(zip.file, bytes.data() + filled, static_cast<unsigned>(wanted));
    bytes.resize(filled + static_cast<size_t>(std::max(got, 0)));
    if (got < 0) return malformed(name, entry, "the zip file is damaged");
    if (got == 0) break;
  }
  if (bytes.size() != promised || unzCloseCurrentFile(zip.file) != UNZ_OK)
    return malformed(name, entry, "the zip file is damaged");
  return std::optional(std::move(bytes));
}

}  // namespace

Result<std::optional<std::string>> unzip_entry(const std::string& name, std::string_view archive,
                                               const std::string& entry) {
  Memory memory{archive};
  const Archive zip{open_archive(memory)};
  if (zip.file == nullptr) return malformed(name, "", "it is no zip file, or a truncated one");
  if (unzLocateFile(zip.file, entry.c_str(), kCaseCounts) != UNZ_OK)
    return std::optional<std::string>();
  return unpack(name, archive, zip, entry);
}

Result<std::optional<std::string>> unzip_first(const std::string& name, std::string_view archive,
                                               const std::string& ending) {
  Memory memory{archive};
  const Archive zip{open_archive(memory)};
  if (zip.file == nullptr) return malformed(name, "", "it is no zip file, or a truncated one");
  for (int at = unzGoToFirstFile(zip.file); at == UNZ_OK; at = unzGoToNextFile(zip.file)) {
    std::array<char, 1024> entry{};
    if (unzGetCurrentFileInfo64(zip.file, nullptr, entry.data(), entry.size() - 1, nullptr, 0,
                                nullptr, 0) != UNZ_OK)
      break;
    if (std::string_view(entry.data()).ends_with(ending))
      return unpack(name, archive, zip, entry.data());
  }
  return std::optional<std::string>();
}

}  // namespace csgrun

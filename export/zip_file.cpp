#include "export/zip_file.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>

#include <minizip/zip.h>

namespace csgrun {
namespace {

/// What minizip takes for a file: text that grows, and a place in it.
struct Memory {
  std::string bytes;
  size_t at = 0;
};

Memory& memory_of(voidpf stream) { return *static_cast<Memory*>(stream); }

voidpf open_memory(voidpf opaque, const void*, int) { return opaque; }
uLong read_memory(voidpf, voidpf, void* buffer, uLong size) {
  std::memset(buffer, 0, size);  // a new file is only written
  return 0;
}
uLong write_memory(voidpf, voidpf stream, const void* buffer, uLong size) {
  Memory& memory = memory_of(stream);
  if (memory.at + size > memory.bytes.size()) memory.bytes.resize(memory.at + size);
  std::memcpy(memory.bytes.data() + memory.at, buffer, size);
  memory.at += size;
  return size;
}
ZPOS64_T tell_memory(voidpf, voidpf stream) { return memory_of(stream).at; }
long seek_memory(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  Memory& memory = memory_of(stream);
  const size_t from = origin == ZLIB_FILEFUNC_SEEK_CUR   ? memory.at
                      : origin == ZLIB_FILEFUNC_SEEK_END ? memory.bytes.size()
                                                         : 0;
  memory.at = from + static_cast<size_t>(offset);
  return memory.at <= memory.bytes.size() ? 0 : -1;
}
int close_memory(voidpf, voidpf) { return 0; }
int no_error(voidpf, voidpf) { return 0; }

}  // namespace

Result<std::string> zip_file(const std::vector<ZipEntry>& entries) {
  Memory memory;
  zlib_filefunc64_def functions{};
  functions.zopen64_file = open_memory;
  functions.zread_file = read_memory;
  functions.zwrite_file = write_memory;
  functions.ztell64_file = tell_memory;
  functions.zseek64_file = seek_memory;
  functions.zclose_file = close_memory;
  functions.zerror_file = no_error;
  functions.opaque = &memory;
  const zipFile zip = zipOpen2_64("model", APPEND_STATUS_CREATE, nullptr, &functions);
  if (zip == nullptr) return Error{ErrorCode::kInternal, "the zip file cannot be begun", {}};
  bool good = true;
  for (const ZipEntry& entry : entries) {
    if (entry.bytes.size() > std::numeric_limits<unsigned>::max()) {
      zipClose(zip, nullptr);
      return Error{ErrorCode::kOutOfRange, "the model is too large for a 3MF file (4 GiB)", {}};
    }
    zip_fileinfo info{};
    info.tmz_date.tm_year = 1980;  // the first date that a zip file can have
    info.tmz_date.tm_mday = 1;
    good = good &&
           zipOpenNewFileInZip(zip, entry.name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                               Z_DEFLATED, Z_DEFAULT_COMPRESSION) == ZIP_OK &&
           zipWriteInFileInZip(zip, entry.bytes.data(),
                               static_cast<unsigned>(entry.bytes.size())) == ZIP_OK &&
           zipCloseFileInZip(zip) == ZIP_OK;
  }
  good = zipClose(zip, nullptr) == ZIP_OK && good;
  if (!good) return Error{ErrorCode::kInternal, "the zip file cannot be written", {}};
  return std::move(memory.bytes);
}

}  // namespace csgrun

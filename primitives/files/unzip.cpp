// PKWARE's APPNOTE 6.3.3: the directory at the end, Zip64, and entries stored or deflated. minizip
// reads no Zip64 sizes where a long has 64 bits, and some writers of 3MF always write these.
#include "primitives/files/unzip.h"

#include <algorithm>
#include <utility>

#include <zlib.h>

#include "primitives/files/byte_order.h"
#include "primitives/files/formats.h"

namespace csgrun {
namespace {

/// Models as text become a tenth by compression, or less: what unpacks to fifty times its size is
/// made to fill the memory.
constexpr uint64_t kMostRatio = 50, kAlwaysFine = uint64_t{16} << 20,
                   kMostBytes = uint64_t{1} << 30;
constexpr size_t kBlock = size_t{1} << 20;

// The fixed parts of the records, and the longest comment after the last one.
constexpr size_t kEndBytes = 22, kEnd64Bytes = 56, kLocatorBytes = 20, kEntryBytes = 46,
                 kLocalBytes = 30, kLongestComment = 0xffff;
constexpr uint64_t kInZip64 = 0xffffffff;  // a size that stands in the Zip64 field instead
constexpr uint32_t kStored = 0, kDeflated = 8, kEncrypted = 1;

uint64_t field16(std::string_view bytes, size_t at) { return read_unsigned<2>(bytes, at, false); }
uint64_t field32(std::string_view bytes, size_t at) { return read_unsigned<4>(bytes, at, false); }
uint64_t field64(std::string_view bytes, size_t at) { return read_unsigned<8>(bytes, at, false); }

bool is_record(std::string_view bytes, uint64_t at, size_t size, std::string_view mark) {
  return at <= bytes.size() && size <= bytes.size() - at && bytes.substr(at, 4) == mark;
}

/// A path as paths are compared.
std::string canonical(std::string_view path) {
  std::string result(path);
  for (char& c : result) {
    if (c == '\\') c = '/';
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

/// Where the directory is.
struct Directory {
  uint64_t begin = 0, size = 0, shift = 0;  ///< shift: what lies in front of the archive
};

std::optional<Directory> find_directory(std::string_view bytes) {
  if (bytes.size() < kEndBytes) return std::nullopt;
  const size_t last = bytes.size() - kEndBytes;
  for (size_t at = last;; --at) {
    if (is_record(bytes, at, kEndBytes, "PK\5\6") && field16(bytes, at + 20) <= last - at) {
      Directory directory{field32(bytes, at + 16), field32(bytes, at + 12)};
      uint64_t end = at;
      if (at >= kLocatorBytes && is_record(bytes, at - kLocatorBytes, kLocatorBytes, "PK\6\7")) {
        const uint64_t end64 = field64(bytes, at - kLocatorBytes + 8);
        if (is_record(bytes, end64, kEnd64Bytes, "PK\6\6")) {
          directory = {field64(bytes, end64 + 48), field64(bytes, end64 + 40)};
          end = end64;
        }
      }
      if (directory.size > end || directory.begin > end - directory.size) return std::nullopt;
      directory.shift = end - directory.size - directory.begin;
      directory.begin += directory.shift;
      return directory;
    }
    if (at == 0 || last - at == kLongestComment) return std::nullopt;
  }
}

/// Gives those of the numbers that have their mark for it what the Zip64 field holds.
bool read_zip64(std::string_view extra, std::initializer_list<uint64_t*> numbers) {
  while (extra.size() >= 4) {
    const uint64_t size = field16(extra, 2);
    if (size > extra.size() - 4) return false;
    if (field16(extra, 0) == 1) {
      std::string_view values = extra.substr(4, size);
      for (uint64_t* number : numbers) {
        if (*number != kInZip64) continue;
        if (values.size() < 8) return false;
        *number = field64(values, 0);
        values.remove_prefix(8);
      }
      return true;
    }
    extra.remove_prefix(4 + size);
  }
  return true;
}

/// All that a deflated stream holds, if that is `size` bytes.
std::optional<std::string> inflated(std::string_view packed, uint64_t size) {
  z_stream stream{};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return std::nullopt;
  std::string bytes;
  int outcome = Z_OK;
  while (outcome == Z_OK && bytes.size() <= size) {
    const size_t filled = bytes.size();
    bytes.resize(filled + std::min<uint64_t>(kBlock, size - filled + 1));
    const size_t given = std::min<size_t>(packed.size(), size_t{1} << 30);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(given);
    stream.next_out = reinterpret_cast<Bytef*>(bytes.data() + filled);
    stream.avail_out = static_cast<uInt>(bytes.size() - filled);
    outcome = inflate(&stream, Z_NO_FLUSH);
    packed.remove_prefix(given - stream.avail_in);
    bytes.erase(bytes.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  if (outcome != Z_STREAM_END || bytes.size() != size) return std::nullopt;
  return bytes;
}

uint32_t checksum_of(const std::string& bytes) {
  return static_cast<uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

Error ZipArchive::damaged(const std::string& place) const {
  return malformed(name_, place, "the zip file is damaged");
}

Result<ZipArchive> ZipArchive::open(std::string name, std::string_view bytes) {
  ZipArchive archive;
  archive.name_ = std::move(name);
  archive.bytes_ = bytes;
  const std::optional<Directory> directory = find_directory(bytes);
  if (!directory) return malformed(archive.name_, "", "it is no zip file, or a truncated one");
  std::string_view rest = bytes.substr(directory->begin, directory->size);
  while (is_record(rest, 0, kEntryBytes, "PK\1\2")) {
    Entry entry;
    entry.flags = static_cast<uint32_t>(field16(rest, 8));
    entry.method = static_cast<uint32_t>(field16(rest, 10));
    entry.checksum = static_cast<uint32_t>(field32(rest, 16));
    entry.packed = field32(rest, 20);
    entry.unpacked = field32(rest, 24);
    entry.offset = field32(rest, 42);
    const uint64_t path = field16(rest, 28), extra = field16(rest, 30);
    const uint64_t size = kEntryBytes + path + extra + field16(rest, 32);
    if (size > rest.size()) return archive.damaged("");
    entry.path = rest.substr(kEntryBytes, path);
    entry.key = canonical(entry.path);
    if (!read_zip64(rest.substr(kEntryBytes + path, extra),
                    {&entry.unpacked, &entry.packed, &entry.offset})) {
      return archive.damaged("");
    }
    entry.offset += directory->shift;
    archive.by_key_.emplace(entry.key, archive.entries_.size());
    archive.entries_.push_back(std::move(entry));
    rest.remove_prefix(size);
  }
  return archive;
}

Result<std::optional<std::string>> ZipArchive::entry(const std::string& path) {
  const auto found = by_key_.find(canonical(path));
  if (found != by_key_.end()) return unpack(entries_[found->second]);
  return std::optional<std::string>();
}

Result<std::optional<std::string>> ZipArchive::first(const std::string& ending) {
  const std::string wanted = canonical(ending);
  for (const Entry& entry : entries_) {
    if (entry.key.ends_with(wanted)) return unpack(entry);
  }
  return std::optional<std::string>();
}

Result<std::optional<std::string>> ZipArchive::unpack(const Entry& entry) {
  // What the entry says of its packed size may be a lie; the archive's size is none.
  const uint64_t packed = std::min<uint64_t>(entry.packed, bytes_.size());
  const auto is_bomb = [](uint64_t unpacked, uint64_t from) {
    return unpacked > kMostBytes || (unpacked > kAlwaysFine && unpacked / kMostRatio > from);
  };
  if (is_bomb(entry.unpacked, packed)) {
    Error error = malformed(name_, entry.path,
                            "unpacks to " + std::to_string(entry.unpacked) + " bytes from " +
                                std::to_string(packed) + ", which no model does");
    error.code = ErrorCode::kLimit;
    return error;
  }
  unpacked_ += entry.unpacked;
  if (is_bomb(unpacked_, bytes_.size())) {
    Error error = malformed(
        name_, "",
        "unpacks to more than " + std::to_string(unpacked_) + " bytes, which no model does");
    error.code = ErrorCode::kLimit;
    return error;
  }
  if ((entry.flags & kEncrypted) != 0 || (entry.method != kStored && entry.method != kDeflated))
    return malformed(name_, entry.path, "is encrypted, or packed in a way that is not read");
  if (!is_record(bytes_, entry.offset, kLocalBytes, "PK\3\4")) return damaged(entry.path);
  const uint64_t begin = entry.offset + kLocalBytes + field16(bytes_, entry.offset + 26) +
                         field16(bytes_, entry.offset + 28);
  if (begin > bytes_.size() || entry.packed > bytes_.size() - begin) return damaged(entry.path);
  const std::string_view data = bytes_.substr(begin, entry.packed);
  std::optional<std::string> unpacked = entry.method == kDeflated ? inflated(data, entry.unpacked)
                                        : data.size() == entry.unpacked
                                            ? std::optional<std::string>(data)
                                            : std::nullopt;
  if (!unpacked || checksum_of(*unpacked) != entry.checksum) return damaged(entry.path);
  return unpacked;
}

}  // namespace csgrun

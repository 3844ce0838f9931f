#include "engine/base/build_id.h"

#if defined(__linux__)

#include <cstdint>
#include <cstring>

#include <elf.h>
#include <link.h>

namespace csgrun {
namespace {

using Bytes = std::span<const std::byte>;

/// The build id among the notes of a segment, each of which is a header, a name and a value, the
/// last two filled up to multiples of four bytes.
Bytes find_id(Bytes notes) {
  constexpr char kName[] = "GNU";
  const auto filled = [](size_t size) { return (size + 3) / 4 * 4; };
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) note;
    std::memcpy(&note, notes.data(), sizeof note);
    const size_t name = sizeof note, value = name + filled(note.n_namesz),
                 end = value + filled(note.n_descsz);
    if (end > notes.size()) break;
    if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == sizeof kName &&
        std::memcmp(notes.data() + name, kName, sizeof kName) == 0) {
      return notes.subspan(value, note.n_descsz);
    }
    notes = notes.subspan(end);
  }
  return {};
}

/// Ends the search at the program or library that holds this function.
int look(dl_phdr_info* info, size_t, void* found) {
  const auto self = reinterpret_cast<uintptr_t>(&look);
  const std::span headers(info->dlpi_phdr, info->dlpi_phnum);
  bool is_own = false;
  Bytes id;
  for (const ElfW(Phdr) & header : headers) {
    const uintptr_t begin = info->dlpi_addr + header.p_vaddr;
    if (header.p_type == PT_LOAD && self - begin < header.p_memsz) is_own = true;
    if (header.p_type == PT_NOTE && id.empty()) {
      id = find_id({reinterpret_cast<const std::byte*>(begin), header.p_memsz});
    }
  }
  if (is_own) *static_cast<Bytes*>(found) = id;
  return is_own ? 1 : 0;
}

}  // namespace

std::span<const std::byte> build_id() {
  Bytes id;
  dl_iterate_phdr(look, &id);
  return id;
}

}  // namespace csgrun

#else

namespace csgrun {

std::span<const std::byte> build_id() { return {}; }

}  // namespace csgrun

#endif

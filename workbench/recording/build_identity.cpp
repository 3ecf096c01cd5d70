#include "workbench/recording/build_identity.h"

#include <array>
#include <cstring>

#include <elf.h>
#include <link.h>

namespace tangent {
namespace {

/// The note of the program itself, the first object that is listed.
int take_build_id(dl_phdr_info* info, std::size_t, void* out) {
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = info->dlpi_phdr[i];
    if (header.p_type != PT_NOTE) continue;
    const auto* at = reinterpret_cast<const unsigned char*>(info->dlpi_addr + header.p_vaddr);
    const unsigned char* end = at + header.p_memsz;
    while (at + sizeof(ElfW(Nhdr)) <= end) {
      ElfW(Nhdr) note;
      std::memcpy(&note, at, sizeof note);
      const auto padded = [](std::size_t size) { return (size + 3) & ~std::size_t{3}; };
      const unsigned char* name = at + sizeof note;
      const unsigned char* value = name + padded(note.n_namesz);
      if (note.n_type == NT_GNU_BUILD_ID && note.n_namesz == 4 && std::memcmp(name, "GNU", 4) == 0) {
        constexpr const char* kDigits = "0123456789abcdef";
        auto& text = *static_cast<std::string*>(out);
        for (std::size_t k = 0; k < note.n_descsz; ++k) {
          text += kDigits[value[k] >> 4];
          text += kDigits[value[k] & 15];
        }
        return 1;
      }
      at = value + padded(note.n_descsz);
    }
  }
  return 1;
}

}  // namespace

std::string build_identity() {
  std::string id;
  dl_iterate_phdr(&take_build_id, &id);
  std::string text = "compiler " __VERSION__;
  if (!id.empty()) text += ", id " + id;
  return text;
}

}  // namespace tangent

#include "devices/plugin/elf_check.h"

#include <elf.h>
#include <link.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>

namespace tangent {

namespace {

constexpr std::size_t kHeadBytes = 20;  // identification, type and machine: the same in both sizes of address
constexpr std::size_t kTypeAt = 16, kMachineAt = 18;
using ElfHead = std::array<unsigned char, kHeadBytes>;

/// Of the system that this was compiled for.
constexpr unsigned kOwnMachine =
#if defined(__x86_64__)
    EM_X86_64;
#elif defined(__aarch64__)
    EM_AARCH64;
#else
    EM_NONE;  // not checked here
#endif

std::string machine_name(unsigned machine) {
  switch (machine) {
    case EM_386:
      return "32-bit x86";
    case EM_X86_64:
      return "x86-64";
    case EM_ARM:
      return "32-bit ARM";
    case EM_AARCH64:
      return "64-bit ARM";
    case EM_RISCV:
      return "RISC-V";
    default:
      return "machine " + std::to_string(machine);
  }
}

Status check_machine(const ElfHead& head, const std::string& where) {
  constexpr unsigned kOwnClass = sizeof(void*) == 8 ? ELFCLASS64 : ELFCLASS32;
  const bool big = head[EI_DATA] == ELFDATA2MSB;
  const auto two_bytes = [&](std::size_t at) {
    return unsigned{head[at]} << (big ? 8 : 0) | head[at + 1] << (big ? 0 : 8);
  };
  const unsigned machine = two_bytes(kMachineAt), type = two_bytes(kTypeAt);
  if (head[EI_CLASS] != kOwnClass || big || (kOwnMachine != EM_NONE && machine != kOwnMachine))
    return fail("is a library for " + machine_name(machine) + (big ? ", big-endian" : "") + ", this program is for " +
                    machine_name(kOwnMachine),
                where, "compile it on this machine");
  if (type == ET_DYN) return {};
  return fail(type == ET_REL ? "is an object file, no shared library" : "is a program, no shared library", where,
              "link it with cc -shared -fPIC");
}

/// Whether all that is to be loaded is in the file: of one that was cut off the linker maps what is not there, and the
/// process dies.
bool is_whole(std::ifstream& file, std::uintmax_t bytes) {
  ElfW(Ehdr) head{};
  file.clear();
  file.seekg(0);
  if (!file.read(reinterpret_cast<char*>(&head), sizeof head)) return false;
  for (unsigned i = 0; i < head.e_phnum; ++i) {
    ElfW(Phdr) part{};
    file.seekg(static_cast<std::streamoff>(head.e_phoff + std::uint64_t{i} * head.e_phentsize));
    if (!file.read(reinterpret_cast<char*>(&part), sizeof part)) return false;
    if (part.p_type == PT_LOAD && (part.p_offset > bytes || part.p_filesz > bytes - part.p_offset)) return false;
  }
  return head.e_phnum > 0;
}

}  // namespace

Status check_shared_library(const std::filesystem::path& path) {
  const std::string where = path.string();
  std::error_code unknown;
  if (std::filesystem::is_directory(path, unknown)) return fail("is a folder", where, "name the .so file in it");
  if (std::filesystem::exists(path, unknown) && !std::filesystem::is_regular_file(path, unknown))  // a pipe would wait
    return fail("is no file", where, "give --plugin the path of the plug-in's .so file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    const int error = errno;
    return fail(error == ENOENT   ? std::string("there is no such file")
                : error == EACCES ? std::string("may not be read")
                                  : std::string("can't be read: ") + std::strerror(error),
                where, error == EACCES ? "chmod a+r " + where : "give --plugin the path of the plug-in's .so file");
  }
  ElfHead head{};
  file.read(reinterpret_cast<char*>(head.data()), kHeadBytes);
  if (file.gcount() < static_cast<std::streamsize>(kHeadBytes) || std::memcmp(head.data(), ELFMAG, SELFMAG) != 0)
    return fail("is no shared library", where,
                "compile the plug-in with cc -shared -fPIC, and give --plugin the result");
  if (const Status ok = check_machine(head, where); !ok) return ok;
  const std::uintmax_t bytes = std::filesystem::file_size(path, unknown);
  if (!unknown && is_whole(file, bytes)) return {};
  return fail("is cut off: it has " + std::to_string(bytes) + " bytes, and is to have more", where,
              "compile or copy it again");
}

}  // namespace tangent

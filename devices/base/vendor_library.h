// A maker's library, loaded while the program runs: it need not be there when this is built, nor for anything else.
//
// Once loaded it stays until the process ends: such libraries keep threads and exit handlers of their own, and code
// that is taken away from under them crashes.
#pragma once

#include "core/base/result.h"

#include <filesystem>
#include <span>
#include <string>

namespace tangent {

class VendorLibrary {
 public:
  /// Which library, and what to do without it.
  struct Wanted {
    std::filesystem::path path;          ///< of a person's choice; empty: the first of `names` that the loader finds
    std::span<const char* const> names;  ///< "libHD.so"
    const char* option;                  ///< that gives the path: "--hd-library"
    const char* remedy;                  ///< where it comes from
  };

  /// Fails with the loader's own words when none can be loaded.
  static Result<VendorLibrary> load(const Wanted& wanted);

  const std::string& name() const { return name_; }

  /// Sets `function` to the symbol of this name; noted as missing, and null, where the library has none.
  template <class Function>
  void bind(Function*& function, const char* symbol) {
    function = reinterpret_cast<Function*>(find(symbol));
    if (function == nullptr) missing_ += (missing_.empty() ? "" : ", ") + std::string(symbol);
  }
  /// The same, without noting it: the caller does without.
  template <class Function>
  void bind_if_there(Function*& function, const char* symbol) const {
    function = reinterpret_cast<Function*>(find(symbol));
  }
  /// Fails, with their names, when functions were missing.
  Status complete(const char* remedy) const;

 private:
  VendorLibrary(std::string name, void* handle) : name_(std::move(name)), handle_(handle) {}
  void* find(const char* symbol) const;

  std::string name_, missing_;
  void* handle_;
};

}  // namespace tangent

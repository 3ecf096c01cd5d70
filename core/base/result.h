// How files, presets and devices report failure: a value or an Error that a person can act on.
#pragma once

#include <tl/expected.hpp>

#include <string>
#include <utility>

namespace tangent {

/// What went wrong, where, and what to do about it. `where` and `remedy` may be empty.
struct Error {
  std::string what;    ///< "vertex index 912 is out of range (the file has 500 vertices)"
  std::string where;   ///< "bunny.obj:1204", "preset.toml:7 solver.gain_overall"
  std::string remedy;  ///< "use an index from 1 to 500"

  /// "where: what; remedy" on one line.
  std::string message() const {
    std::string text = where.empty() ? what : where + ": " + what;
    if (!remedy.empty()) text += "; " + remedy;
    return text;
  }
};

template <class T>
using Result = tl::expected<T, Error>;
using Status = tl::expected<void, Error>;

inline tl::unexpected<Error> fail(std::string what, std::string where = {}, std::string remedy = {}) {
  return tl::unexpected<Error>(Error{std::move(what), std::move(where), std::move(remedy)});
}

}  // namespace tangent

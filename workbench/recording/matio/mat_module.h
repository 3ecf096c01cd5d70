// Between the program and the module that has libmatio (matio_module.cpp), which is loaded only when a MATLAB file is
// written: libmatio and the HDF5 that it needs would be a part of every start.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace tangent {

enum class MatType : std::uint8_t { real, u8, u32, u64, i32, i64 };

/// A variable: one column of numbers.
struct MatNumbers {
  const char* name = "";
  MatType type = MatType::real;
  const void* values = nullptr;
  std::size_t rows = 0;
};

/// The struct `about`: texts by name, and of the columns units, meanings and, where they are codes, the words.
struct MatAbout {
  std::vector<std::pair<std::string, std::string>> texts, units, meanings;
  std::vector<std::pair<std::string, std::vector<std::string>>> words;  ///< of the codes from 0 on
};

/// What the module exports, by "tangent_mat_functions". `create` returns null, the others false, where they fail.
struct MatFunctions {
  void* (*create)(const char* path, const char* header) = nullptr;
  bool (*put_about)(void* file, const MatAbout& about) = nullptr;
  bool (*put_numbers)(void* file, const MatNumbers& numbers) = nullptr;
  bool (*close)(void* file) = nullptr;  ///< and frees it, also where it fails
};

}  // namespace tangent

// MATLAB files (version 5, as MATLAB 5 to now, Octave and scipy read them) by libmatio, as a module of its own
// (mat_module.h says why).
#include "workbench/recording/matio/mat_module.h"

#include <matio.h>

#include <array>
#include <memory>

namespace tangent {
namespace {

struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

std::pair<matio_classes, matio_types> types_of(MatType type) {
  constexpr std::array<std::pair<matio_classes, matio_types>, 6> kTypes{{{MAT_C_DOUBLE, MAT_T_DOUBLE},
                                                                         {MAT_C_UINT8, MAT_T_UINT8},
                                                                         {MAT_C_UINT32, MAT_T_UINT32},
                                                                         {MAT_C_UINT64, MAT_T_UINT64},
                                                                         {MAT_C_INT32, MAT_T_INT32},
                                                                         {MAT_C_INT64, MAT_T_INT64}}};
  return kTypes[static_cast<std::size_t>(type)];
}

Variable text_variable(const std::string& text) {
  std::array<std::size_t, 2> dims{text.empty() ? 0u : 1u, text.size()};
  std::string copy = text;
  return Variable(Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UTF8, 2, dims.data(), copy.data(), 0));
}

/// A row of texts.
Variable cell_variable(const std::vector<std::string>& texts) {
  std::array<std::size_t, 2> dims{1, texts.size()};
  Variable cell(Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, dims.data(), nullptr, 0));
  for (std::size_t i = 0; cell && i < texts.size(); ++i)
    Mat_VarSetCell(cell.get(), static_cast<int>(i), text_variable(texts[i]).release());
  return cell;
}

/// A struct of one element. All of `fields`, or nothing is made.
Variable struct_variable(const char* name, std::vector<std::pair<std::string, Variable>> fields) {
  constexpr std::array<std::size_t, 2> kOne{1, 1};
  std::vector<const char*> names;
  for (const auto& [field, value] : fields) names.push_back(field.c_str());
  names.push_back(nullptr);
  Variable made(Mat_VarCreateStruct2(name, 2, kOne.data(), names.data()));
  for (std::size_t i = 0; made && i < fields.size(); ++i) {
    if (!fields[i].second) return nullptr;
    Mat_VarSetStructFieldByIndex(made.get(), i, 0, fields[i].second.release());
  }
  return made;
}

template <class T, class Make>
std::vector<std::pair<std::string, Variable>> variables_of(const std::vector<std::pair<std::string, T>>& values,
                                                           const Make& make) {
  std::vector<std::pair<std::string, Variable>> made;
  for (const auto& [name, value] : values) made.emplace_back(name, make(value));
  return made;
}

bool write_variable(void* file, const Variable& variable) {
  return variable && Mat_VarWrite(static_cast<mat_t*>(file), variable.get(), MAT_COMPRESSION_NONE) == 0;
}

void* create_file(const char* path, const char* header) { return Mat_CreateVer(path, header, MAT_FT_MAT5); }

bool put_about(void* file, const MatAbout& about) {
  auto fields = variables_of(about.texts, text_variable);
  fields.emplace_back("units", struct_variable(nullptr, variables_of(about.units, text_variable)));
  fields.emplace_back("meanings", struct_variable(nullptr, variables_of(about.meanings, text_variable)));
  fields.emplace_back("words", struct_variable(nullptr, variables_of(about.words, cell_variable)));
  return write_variable(file, struct_variable("about", std::move(fields)));
}

bool put_numbers(void* file, const MatNumbers& numbers) {
  const auto [kind, type] = types_of(numbers.type);
  std::array<std::size_t, 2> dims{numbers.rows, 1};
  auto* values = const_cast<void*>(numbers.values);  // not copied, and only read
  return write_variable(
      file, Variable(Mat_VarCreate(numbers.name, kind, type, 2, dims.data(), values, MAT_F_DONT_COPY_DATA)));
}

bool close_file(void* file) { return Mat_Close(static_cast<mat_t*>(file)) == 0; }

}  // namespace
}  // namespace tangent

extern "C" [[gnu::visibility("default")]] const tangent::MatFunctions* tangent_mat_functions() {
  static constexpr tangent::MatFunctions kFunctions{tangent::create_file, tangent::put_about, tangent::put_numbers,
                                                    tangent::close_file};
  return &kFunctions;
}

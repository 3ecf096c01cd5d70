#include "workbench/sweep/objective.h"

#include "core/base/text.h"
#include "core/io/csv_table.h"
#include "core/preset/schema.h"

#include <algorithm>

namespace tangent::sweep {
namespace {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

std::string most_text(double value) {
  std::string out;
  append_double(out, value);
  return out;
}

}  // namespace

double Objective::of(const CellNumbers& numbers) const {
  if (const auto* whole = std::get_if<std::uint64_t CellNumbers::*>(&column->field))
    return static_cast<double>(numbers.*(*whole));
  return numbers.*(std::get<double CellNumbers::*>(column->field));
}

Result<Objective> find_objective(std::string_view name) {
  std::vector<std::string_view> names;
  for (const NumberColumn& column : number_columns()) {
    if (column.name == name) return Objective{&column};
    names.push_back(column.name);
  }
  return fail(show_text(name) + " is no number of a run", {}, "allowed: " + choices_text(names));
}

double Constraint::missed(const CellNumbers& numbers) const {
  const double over = of.of(numbers) - most;
  return over <= 0.0 ? 0.0 : most > 0.0 ? over / most : over;
}

std::string Constraint::text() const {
  return std::string(of.name()) + (most == 0.0 ? " = 0" : " <= " + most_text(most));
}

Result<Constraint> parse_constraint(std::string_view text) {
  const std::size_t sign = text.find_first_of("<=");
  const auto wrong = [&] {
    return fail(show_text(text) + " is no constraint", {}, "write NAME <= VALUE, or NAME = 0");
  };
  if (sign == std::string_view::npos) return wrong();
  const bool at_most = text.substr(sign, 2) == "<=";
  const auto value = parse_finite_double(trimmed(text.substr(sign + (at_most ? 2 : 1))));
  if (!value || (text[sign] == '<') != at_most || (!at_most && *value != 0.0)) return wrong();
  const Result<Objective> of = find_objective(trimmed(text.substr(0, sign)));
  if (!of) return tl::unexpected(of.error());
  if (*value < 0.0) return fail(std::string(of->name()) + " is never below 0", std::string(text), "allow 0 or more");
  return Constraint{*of, *value};
}

Status check_constraints(const std::vector<Constraint>& constraints) {
  for (std::size_t i = 0; i < constraints.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (constraints[i].of.column == constraints[k].of.column)
        return fail("is limited twice", std::string(constraints[i].of.name()), "keep the tighter of the two");
  return {};
}

}  // namespace tangent::sweep

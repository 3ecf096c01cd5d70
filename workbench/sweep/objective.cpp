#include "workbench/sweep/objective.h"

#include "core/base/text.h"
#include "core/io/csv_table.h"
#include "core/preset/schema.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <span>

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

/// "20 us" and "20us" in two.
std::pair<std::string_view, std::string_view> value_and_unit(std::string_view text) {
  std::size_t end = text.size();
  while (end > 0 && std::isalpha(static_cast<unsigned char>(text[end - 1]))) --end;
  if (end == 0) return {text, {}};
  return {trimmed(text.substr(0, end)), text.substr(end)};
}

/// What one of the unit is in the column's own; empty: it is no unit of it.
std::optional<double> unit_factor(const Objective& of, std::string_view unit) {
  using Unit = std::pair<std::string_view, double>;
  constexpr std::array<Unit, 3> kTimes{Unit{"ns", 1e-3}, Unit{"us", 1.0}, Unit{"ms", 1e3}};
  constexpr std::array<Unit, 5> kLengths{Unit{"", 1.0}, Unit{"nm", 1e-9}, Unit{"um", 1e-6}, Unit{"mm", 1e-3},
                                         Unit{"m", 1.0}};
  const auto among = [unit](std::span<const Unit> units) -> std::optional<double> {
    for (const auto& [name, factor] : units)
      if (name == unit) return factor;
    return std::nullopt;
  };
  if (of.is_time()) return among(kTimes);
  if (of.column->name.ends_with("_m")) return among(kLengths);
  return unit.empty() ? std::optional(1.0) : std::nullopt;
}

}  // namespace

bool Objective::is_time() const {
  return column->name == kObjectiveNames[0].column || column->name == kObjectiveNames[1].column;
}

std::string_view Objective::name() const {
  if (!is_time()) return column->name;
  return column->name == kObjectiveNames[0].column ? kObjectiveNames[0].name : kObjectiveNames[1].name;
}

namespace {

/// How many of the ticks may be without a contact for an error to say something of the rest; of other columns all.
double share_left_out(std::string_view column) { return column.starts_with("error_") ? 0.5 : 1.0; }

}  // namespace

double Objective::lacking(const CellNumbers& numbers) const {
  const auto ticks = static_cast<double>(numbers.ticks);
  const auto without = static_cast<double>(numbers.unconverged + numbers.facing);
  return ticks > 0.0 && without > share_left_out(column->name) * ticks ? without / ticks : 0.0;
}

double Objective::of(const CellNumbers& numbers) const {
  if (const auto* whole = std::get_if<std::uint64_t CellNumbers::*>(&column->field))
    return static_cast<double>(numbers.*(*whole));
  return numbers.*(std::get<double CellNumbers::*>(column->field));
}

double Objective::of(const CellNumbers& numbers, const TimeScale& scale) const {
  if (!is_time()) return of(numbers);
  return of(numbers) * (column->name == kObjectiveNames[0].column ? scale.mean : scale.p99);
}

Result<Objective> find_objective(std::string_view name) {
  std::vector<std::string_view> names;
  for (const ObjectiveName& known : kObjectiveNames) {
    names.push_back(known.name);
    if (known.name == name) name = known.column;
  }
  for (const NumberColumn& column : number_columns()) {
    if (column.name == name) return Objective{&column};
    names.push_back(column.name);
  }
  return fail(show_text(name) + " is no number of a run", {}, "allowed: " + choices_text(names));
}

double Constraint::missed(const CellNumbers& numbers, const TimeScale& scale) const {
  if (const double lacking = of.lacking(numbers); lacking > 0.0) return lacking;
  const double over = of.of(numbers, scale) - most;
  return over <= 0.0 ? 0.0 : most > 0.0 ? over / most : over;
}

std::string Constraint::text() const {
  return std::string(of.name()) + (most == 0.0 ? " = 0" : " <= " + most_text(most)) +
         (of.is_time() && most != 0.0 ? " us" : "");
}

Result<Constraint> parse_constraint(std::string_view text) {
  const std::size_t sign = text.find_first_of("<=");
  const auto wrong = [&] {
    return fail(show_text(text) + " is no constraint", {}, "write NAME <= VALUE, or NAME = 0");
  };
  if (sign == std::string_view::npos) return wrong();
  const bool at_most = text.substr(sign, 2) == "<=";
  const auto [number, unit] = value_and_unit(trimmed(text.substr(sign + (at_most ? 2 : 1))));
  const auto value = parse_finite_double(number);
  if (!value || (text[sign] == '<') != at_most || (!at_most && *value != 0.0)) return wrong();
  const Result<Objective> of = find_objective(trimmed(text.substr(0, sign)));
  if (!of) return tl::unexpected(of.error());
  const auto factor = unit_factor(*of, unit);
  if (!factor && *value != 0.0)
    return fail(show_text(unit) + " is no unit of " + std::string(of->name()), std::string(text),
                of->is_time() ? "write ns, us or ms: p99_time <= 20 us" : "write nm, um, mm or m for lengths");
  if (*value < 0.0) return fail(std::string(of->name()) + " is never below 0", std::string(text), "allow 0 or more");
  return Constraint{*of, *value * factor.value_or(1.0)};
}

Status check_constraints(const std::vector<Constraint>& constraints) {
  for (std::size_t i = 0; i < constraints.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (constraints[i].of.column == constraints[k].of.column)
        return fail("is limited twice", std::string(constraints[i].of.name()), "keep the tighter of the two");
  return {};
}

}  // namespace tangent::sweep

#include "workbench/experiment/trial_rows.h"

#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <variant>

namespace tangent::experiment {
namespace {

/// A column and where its value is in a row.
template <class Row>
struct Column {
  ColumnMeaning meaning;
  std::variant<int Row::*, double Row::*, bool Row::*, std::string Row::*, Facing Row::*> field;
};

constexpr std::array<ColumnMeaning, 3> kMarks{{
    {"participant", "", "as given when the experiment was begun"},
    {"simulated", "",
     "no, or what was simulated, so that nobody felt anything: the participant (known, feeling), the device"},
    {"pilot", "", "yes: a trial run, not to be analysed with the others"},
}};

using C = ComparisonRow;
const std::array<Column<C>, 14> kComparison{{
    {{"trial", "", "from 0, over the whole experiment"}, &C::trial},
    {{"condition", "", "rendering condition: C1 to C4, P1, P2"}, &C::condition},
    {{"condition_place", "", "from 0: which condition of the participant's order"}, &C::condition_place},
    {{"trial_in_condition", "", "from 0"}, &C::trial_in_condition},
    {{"segments", "", "of the comparison; the reference is the exact arc"}, &C::segments},
    {{"angle_deg", "deg", "between neighbouring segments of the comparison"}, &C::angle_deg},
    {{"reference", "", "shown first or second: 1, 2"}, &C::reference},
    {{"response", "", "taken for the smooth one: 1, 2"}, &C::answer},
    {{"correct", "", "the reference was taken for the smooth one: yes, no"}, &C::right},
    {{"reversal", "", "the staircase turned at this trial: yes, no"}, &C::reversal},
    {{"onset", "s", "the first stimulus was shown, since the participant's first start of the program"}, &C::began_s},
    {{"first_time", "s", "from the first touch of the first stimulus to Enter"}, &C::first_s},
    {{"response_time", "s", "from the first touch of the second stimulus to the answer"}, &C::second_s},
    {{"second_touching", "s", "of response_time, touching"}, &C::second_touching_s},
}};
using N = NamingRow;
const std::array<Column<N>, 13> kNaming{{
    {{"trial", "", "from 0, over all sessions"}, &N::trial},
    {{"session", "", "from 1"}, &N::session},
    {{"block", "", "of the session, from 1"}, &N::block},
    {{"run", "", "of the block, from 1"}, &N::run},
    {{"stimulus", "", "the object that was shown"}, &N::object},
    {{"shaded", "", "rounded edges and smooth contact, else facets: yes, no"}, &N::shaded},
    {{"tactile", "", "the contact location display moved, else it was held: yes, no"}, &N::tactile},
    {{"facing", "", "where the tip of cone and tetrahedron pointed: left, right"}, &N::facing},
    {{"response", "", "what it was taken for"}, &N::answer},
    {{"correct", "", "yes, no"}, &N::right},
    {{"onset", "s", "the ding, since the participant's first start of the program"}, &N::began_s},
    {{"response_time", "s", "from the first touch to the answer"}, &N::since_touch_s},
    {{"touching", "s", "of response_time, touching"}, &N::touching_s},
}};

using O = RowOrigin;
const std::array<Column<O>, 8> kOrigin{{
    {{"interruptions", "", "how often the trial was begun again: after a fault, a stop or an end of the program"},
     &O::interruptions},
    {{"device", "", "force device and contact location display"}, &O::device},
    {{"sound", "", "what played noise and cues; none: nothing did"}, &O::sound},
    {{"mesh", "", "hash of the object, or of the comparison's polygon"}, &O::mesh},
    {{"preset", "", "digest of the preset in use"}, &O::preset},
    {{"protocol", "", "digest of the protocol"}, &O::protocol},
    {{"program", "", "digest of the library that computes the ticks"}, &O::program},
    {{"recording", "", "file with every tick of the trial, beside this table"}, &O::recording},
}};

template <class Columns>
std::vector<ColumnMeaning> meanings(const Columns& columns) {
  std::vector<ColumnMeaning> out(kMarks.begin(), kMarks.end());
  for (const auto& column : columns) out.push_back(column.meaning);
  for (const auto& column : kOrigin) out.push_back(column.meaning);
  return out;
}

std::string text_of(int value) { return std::to_string(value); }
std::string text_of(bool value) { return value ? "yes" : "no"; }
std::string text_of(const std::string& value) { return value; }
std::string text_of(Facing value) { return value == Facing::left ? "left" : "right"; }
std::string text_of(double value) {
  std::string out;
  append_double(out, value);
  return out;
}

bool take(const std::string& text, std::string& value) { return value = text, !text.empty(); }
bool take(const std::string& text, int& value) {
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  return read.ec == std::errc{} && read.ptr == text.data() + text.size();
}
bool take(const std::string& text, double& value) {
  const auto read = parse_finite_double(text);
  if (read) value = *read;
  return read.has_value();
}
bool take(const std::string& text, bool& value) { return value = text == "yes", value || text == "no"; }
bool take(const std::string& text, Facing& value) {
  value = text == "left" ? Facing::left : Facing::right;
  return text == "left" || text == "right";
}

template <class Row, class Columns>
Fields fields_by(const Columns& columns, const RunMark& mark, const Row& row, const RowOrigin& origin) {
  Fields out{mark.participant, mark.simulated, text_of(mark.pilot)};
  for (const auto& column : columns) std::visit([&](auto field) { out.push_back(text_of(row.*field)); }, column.field);
  for (const auto& column : kOrigin)
    std::visit([&](auto field) { out.push_back(text_of(origin.*field)); }, column.field);
  return out;
}

/// The field of a column; null: there is none.
const std::string* field_of(const Fields& columns, const Fields& fields, std::string_view name) {
  const auto at = std::find(columns.begin(), columns.end(), name);
  return at == columns.end() ? nullptr : &fields[static_cast<std::size_t>(at - columns.begin())];
}

template <class T>
Status read_field(const Fields& columns, const Fields& fields, std::string_view name, T& value) {
  const std::string* text = field_of(columns, fields, name);
  if (text == nullptr) return fail("is missing", "column " + std::string(name), "use the table as it was written");
  if (take(*text, value)) return {};
  return fail("\"" + *text + "\" is no value of it", "column " + std::string(name), "use the table as it was written");
}

template <class Row, class Columns>
Result<std::pair<RunMark, Row>> row_by(const Columns& known, const Fields& columns, const Fields& fields) {
  std::pair<RunMark, Row> out;
  Status ok = read_field(columns, fields, "participant", out.first.participant);
  if (ok) ok = read_field(columns, fields, "simulated", out.first.simulated);
  if (ok) ok = read_field(columns, fields, "pilot", out.first.pilot);
  for (const auto& column : known)
    if (ok)
      std::visit([&](auto field) { ok = read_field(columns, fields, column.meaning.name, out.second.*field); },
                 column.field);
  if (!ok) return tl::unexpected(ok.error());
  return out;
}

}  // namespace

std::span<const ColumnMeaning> comparison_columns() {
  static const std::vector<ColumnMeaning> kAll = meanings(kComparison);
  return kAll;
}
std::span<const ColumnMeaning> naming_columns() {
  static const std::vector<ColumnMeaning> kAll = meanings(kNaming);
  return kAll;
}

Fields fields_of(const RunMark& mark, const ComparisonRow& row, const RowOrigin& origin) {
  return fields_by(kComparison, mark, row, origin);
}
Fields fields_of(const RunMark& mark, const NamingRow& row, const RowOrigin& origin) {
  return fields_by(kNaming, mark, row, origin);
}

Result<RowOrigin> row_origin(const Fields& columns, const Fields& fields) {
  RowOrigin out;
  Status ok;
  for (const auto& column : kOrigin)
    if (ok && field_of(columns, fields, column.meaning.name) != nullptr)
      std::visit([&](auto field) { ok = read_field(columns, fields, column.meaning.name, out.*field); }, column.field);
  if (!ok) return tl::unexpected(ok.error());
  return out;
}

Result<std::pair<RunMark, ComparisonRow>> comparison_row(const Fields& columns, const Fields& fields) {
  return row_by<ComparisonRow>(kComparison, columns, fields);
}
Result<std::pair<RunMark, NamingRow>> naming_row(const Fields& columns, const Fields& fields) {
  return row_by<NamingRow>(kNaming, columns, fields);
}

template <class Row, class Columns>
static Result<std::vector<Row>> rows_by(const Columns& columns, std::span<const ColumnMeaning> meanings,
                                        const RowFile& file) {
  Fields names;
  for (const ColumnMeaning& column : meanings) names.emplace_back(column.name);
  std::vector<Row> out;
  for (const Fields& fields : file.rows()) {
    auto row = row_by<Row>(columns, names, fields);
    if (!row) return tl::unexpected(row.error());
    out.push_back(std::move(row->second));
  }
  return out;
}
Result<std::vector<ComparisonRow>> comparison_rows(const RowFile& file) {
  return rows_by<ComparisonRow>(kComparison, comparison_columns(), file);
}
Result<std::vector<NamingRow>> naming_rows(const RowFile& file) {
  return rows_by<NamingRow>(kNaming, naming_columns(), file);
}

}  // namespace tangent::experiment

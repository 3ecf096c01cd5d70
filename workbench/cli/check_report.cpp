#include "workbench/cli/check_report.h"

#include "core/io/file_name.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace tangent {
namespace {

using Json = nlohmann::ordered_json;

Json differences_json(const std::vector<CheckDifference>& differences) {
  Json all = Json::array();
  for (const CheckDifference& d : differences)
    all.push_back({{"what", d.what}, {"measured", d.measured}, {"now", d.now}});
  return all;
}

Json numbers_json(const EvidenceNumbers& numbers) {
  Json all = Json::object();
  for (const EvidenceNumber& number : evidence_numbers()) {
    if (number.compared != Compared::never) all[std::string(number.key)] = numbers.*number.field;
  }
  return all;
}

}  // namespace

void print_check(const CheckedFile& checked) {
  std::printf("%s %s\n", checked.preset.string().c_str(), check_text(checked.check).c_str());
}

Json check_json(const std::vector<CheckedFile>& files) {
  Json all = Json::array();
  for (const CheckedFile& file : files) {
    Json one{{"preset", file_name_text(file.preset)}, {"outcome", to_string(file.check.outcome)}};
    if (file.check.outcome == CheckOutcome::impossible) {
      one["why"] = file.check.why;
    } else {
      one["to_the_last_bit"] = file.check.same_build;
      one["differences"] = differences_json(file.check.differences);
      one["now"] = numbers_json(file.check.now);
    }
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace tangent

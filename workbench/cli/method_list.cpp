#include "workbench/cli/method_list.h"

#include "core/preset/schema.h"

#include <algorithm>
#include <sstream>

namespace tangent {

Result<std::vector<Method>> methods_named(const std::vector<std::string>& texts) {
  std::vector<Method> out;
  for (const std::string& text : texts) {
    std::istringstream names(text + ",");
    for (std::string name; std::getline(names, name, ',');) {
      const auto at = std::find(kMethodNames.begin(), kMethodNames.end(), name);
      if (at == kMethodNames.end())
        return fail("\"" + name + "\" is no method", "--methods", "allowed: " + choices_text(kMethodNames));
      out.push_back(static_cast<Method>(at - kMethodNames.begin()));
    }
  }
  return out;
}

}  // namespace tangent

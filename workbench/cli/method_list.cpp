#include "workbench/cli/method_list.h"

#include "core/preset/schema.h"
#include "workbench/cli/option.h"

#include <algorithm>
#include <sstream>

namespace tangent {

std::vector<Method> methods_named(const std::vector<std::string>& texts) {
  std::vector<Method> out;
  for (const std::string& text : texts) {
    std::istringstream names(text + ",");
    for (std::string name; std::getline(names, name, ',');) {
      const auto at = std::find(kMethodNames.begin(), kMethodNames.end(), name);
      if (at == kMethodNames.end())
        refuse_option("--methods", "\"" + name + "\" is no method; allowed: " + choices_text(kMethodNames));
      const auto method = static_cast<Method>(at - kMethodNames.begin());
      if (std::find(out.begin(), out.end(), method) != out.end()) refuse_option("--methods", name + " is there twice");
      out.push_back(method);
    }
  }
  return out;
}

}  // namespace tangent

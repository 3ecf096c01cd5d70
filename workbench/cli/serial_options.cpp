#include "workbench/cli/serial_options.h"

#include "devices/serial/serial_options.h"
#include "devices/serial/serial_port.h"
#include "workbench/cli/option.h"

namespace tangent {

void add_serial_options(CLI::App& command, SerialForceOptions& options) {
  static const std::vector<std::string> texts = [] {
    std::vector<std::string> all;
    for (const int baud : serial_bauds()) all.push_back(std::to_string(baud));
    return all;
  }();
  static const std::vector<std::string_view> rates(texts.begin(), texts.end());
  add_text_option(command, "--serial-port", options.port,
                  "Serial port of the force device \"serial\" (default: the only one attached)", "PATH");
  add_choice_option(command, "--serial-baud", rates, "Its rate, where it is no USB CDC (default 1000000)",
                    [&options](int i) { options.baud = serial_bauds()[static_cast<std::size_t>(i)]; });
}

}  // namespace tangent

#include "workbench/cli/haply_options.h"

#include "workbench/cli/option.h"

namespace tangent {

void add_haply_options(CLI::App& command, HaplyOptions& options) {
  add_text_option(command, "--haply-address", options.address,
                  "Where Haply's Inverse Service is (default ws://localhost:10001)", "URL");
  add_flag(command, "--haply-other-host", options.other_host,
           "Allow a service on another machine: forces then come as late as the network is");
  add_number_option(command, "--haply-events-port", {.min = 0, .max = 65535, .unit = "port"},
                    "Where the service reports events, on the same host (default 10020; 0: they are not heard)",
                    [&options](double v) { options.events_port = static_cast<int>(v); });
  add_text_option(command, "--haply-device", options.device, "Which Inverse3, where there are several: its id", "ID");
  add_number_option(command, "--haply-peak-n", {.min = 0.1, .max = 20, .unit = "N"},
                    "The largest force to send (default 3, a careful limit of ours)",
                    [&options](double v) { options.peak_force_n = v; });
  add_vector_option(command, "--haply-centre-mm", {.min = -500, .max = 500, .unit = "mm"},
                    "Centre of the workspace from the base: right, away, up (default 0 -120 150)",
                    [&options](const auto& v) { options.centre_m = 1e-3 * Vec3(v[0], v[1], v[2]); });
}

}  // namespace tangent

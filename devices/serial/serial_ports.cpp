#include "devices/serial/serial_ports.h"

#include "devices/serial/serial_port.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>

namespace tangent {

namespace {

namespace fs = std::filesystem;

/// "usb-Vendor_Model_5573-if00" has "5573", which udev puts there.
std::string serial_of(const std::string& by_id_name) {
  const std::size_t end = by_id_name.rfind("-if");
  const std::size_t from = by_id_name.rfind('_', end);
  return from == std::string::npos ? std::string() : by_id_name.substr(from + 1, end - from - 1);
}

/// By the name of the port: the link's path.
std::map<std::string, std::string> links_by_id(const fs::path& dev) {
  std::map<std::string, std::string> links;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(dev / "serial/by-id", error)) {
    const fs::path port = fs::read_symlink(entry.path(), error).filename();
    if (!error) links[port.string()] = entry.path().string();
  }
  return links;
}

std::string listed(const std::vector<SerialPortInfo>& ports) {
  std::string text;
  for (const SerialPortInfo& port : ports) {
    text += (text.empty() ? "" : ", ") + port.path;
    if (!port.serial.empty()) text += " (serial " + port.serial + ")";
  }
  return text;
}

}  // namespace

std::vector<SerialPortInfo> list_serial_ports(const fs::path& dev) {
  const std::map<std::string, std::string> links = links_by_id(dev);
  std::vector<SerialPortInfo> ports;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(dev, error)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("ttyACM", 0) != 0 && name.rfind("ttyUSB", 0) != 0) continue;
    SerialPortInfo port{entry.path().string(), {}, {}};
    if (const auto link = links.find(name); link != links.end()) {
      port.by_id = link->second;
      port.serial = serial_of(fs::path(link->second).filename().string());
    }
    ports.push_back(port);
  }
  std::sort(ports.begin(), ports.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return ports;
}

Result<SerialPortInfo> choose_serial_port(const std::string& wanted, const fs::path& dev) {
  const std::vector<SerialPortInfo> ports = list_serial_ports(dev);
  if (!wanted.empty()) {
    const auto same = [&wanted](const SerialPortInfo& p) { return p.path == wanted || p.by_id == wanted; };
    const auto port = std::find_if(ports.begin(), ports.end(), same);
    return port != ports.end() ? *port : SerialPortInfo{wanted, {}, {}};
  }
  if (ports.empty())
    return fail("no serial port is attached", (dev / "ttyACM*").string(),
                "plug the device in, or name its port with --serial-port");
  if (ports.size() > 1)
    return fail("there are " + std::to_string(ports.size()) + " serial ports: " + listed(ports), dev.string(),
                "say which with --serial-port" +
                    (ports.front().by_id.empty() ? "" : ", best by its link, as " + ports.front().by_id));
  return ports.front();
}

std::vector<FoundDevice> find_serial_devices(const fs::path& dev) {
  std::vector<FoundDevice> found;
  for (const SerialPortInfo& port : list_serial_ports(dev)) {
    FoundDevice device{.kind = "serial", .name = "serial port " + port.path, .serial = port.serial};
    if (access(port.path.c_str(), R_OK | W_OK) != 0) device.problem = serial_error(errno, port.path);
    found.push_back(device);
  }
  return found;
}

}  // namespace tangent

#include "workbench/sweep/cell_times.h"

#include <algorithm>
#include <array>
#include <fstream>

#include <unistd.h>

namespace tangent::sweep {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t at = line.find(": ");
    return at == std::string::npos ? std::string() : line.substr(at + 2);
  }
  return {};
}

}  // namespace

std::string machine_name() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  const std::string kind = processor();
  return std::string(host.data()) + (kind.empty() ? "" : ", " + kind);
}

Result<std::optional<CellTime>> time_cell(const Cells& cells, Inputs& inputs, std::uint64_t index,
                                          const TimeCells& options) {
  const Cell cell = cells.at(index);
  const Result<Ground> ground = inputs.ground(cell.mesh, cell.poses, cell.finger);
  if (!ground) return tl::unexpected(ground.error());
  const std::uint64_t first = index / cells.per_group() * cells.per_group();
  const auto motion = std::span(*ground->motion).first(std::min(options.ticks, ground->motion->size()));
  const auto time = time_paired(ground->scene, cells.preset(cell), cells.preset(cells.at(first)), motion,
                                options.rounds, options.stop);
  if (!time) return std::nullopt;
  return CellTime{index, first, *time, machine_name()};
}

}  // namespace tangent::sweep

#include "workbench/gui/model/export_samples.h"

#include "core/io/atomic_file.h"

#include <charconv>

namespace tangent {

namespace {

constexpr const char* kHeader =
    "tick,t_s,status,event,triangle,u,v,penetration_m,error_m,iterations,force_x_n,force_y_n,force_z_n,"
    "force_sent_x_n,force_sent_y_n,force_sent_z_n,cld_m,cld_sent_m,cld_measured_m,finger_x_m,finger_y_m,finger_z_m,"
    "preset_id,gate_state,solve_ns,tick_ns,lateness_ns,missed_deadlines\n";

class Row {
 public:
  template <class T>
  Row& put(T value) {
    char text[32];
    const auto done = std::to_chars(text, text + sizeof text, value);
    separate();
    line_.append(text, done.ptr);
    return *this;
  }
  Row& put(const char* text) {
    separate();
    line_ += text;
    return *this;
  }
  Row& put(const Vec3& v) { return put(v.x).put(v.y).put(v.z); }
  const std::string& end() { return line_ += '\n'; }
  void clear() { line_.clear(); }

 private:
  void separate() {
    if (!line_.empty()) line_ += ',';
  }
  std::string line_;
};

}  // namespace

std::string_view samples_header() { return kHeader; }

Result<std::size_t> export_samples(const HistorySnapshot& records, std::uint64_t from, std::uint64_t to,
                                   const std::filesystem::path& path, const std::stop_token& stop) {
  auto file = AtomicFile::create(path);
  if (!file) return tl::unexpected(file.error());
  if (Status ok = file->write(kHeader); !ok) return tl::unexpected(ok.error());
  Row row;
  std::size_t count = 0;
  for (std::size_t i = records.lower_bound(from); i < records.size() && records[i].tick.tick < to; ++i, ++count) {
    if (stop.stop_requested()) return fail("cancelled, nothing is written", path.string());
    const ServoRecord& r = records[i];
    const TickOutput& out = r.tick.output;
    row.clear();
    row.put(r.tick.tick).put(r.tick.input.t_s).put(to_string(out.status)).put(to_string(out.event));
    if (out.triangle == kNone)
      row.put("-1");
    else
      row.put(out.triangle);
    row.put(out.u).put(out.v).put(out.penetration_m).put(out.error_m).put(out.iterations).put(out.force_n);
    row.put(r.device.force_command_n).put(out.cld_m).put(r.device.cld_command_m).put(r.device.cld_measured_m);
    row.put(r.tick.input.finger.position).put(r.tick.preset_id).put(to_string(r.device.gate_state));
    row.put(r.tick.solve_ns).put(r.tick_ns).put(r.lateness_ns).put(r.missed_deadlines);
    if (Status ok = file->write(row.end()); !ok) return tl::unexpected(ok.error());
  }
  if (Status ok = file->commit(); !ok) return tl::unexpected(ok.error());
  return count;
}

}  // namespace tangent

#include "workbench/gui/model/bring_up_model.h"

#include "devices/found_device.h"
#include "workbench/bringup/bring_up_text.h"
#include "workbench/bringup/proved_devices.h"
#include "workbench/session/kept_devices.h"

#include <utility>

namespace tangent {

BringUpModel::BringUpModel(DeviceModel& devices, MessageLog& messages, bool deterministic, std::filesystem::path kept)
    : devices_(devices), messages_(messages), deterministic_(deterministic), kept_(std::move(kept)) {
  devices_.also_stop([this] { stop(); });
}

void BringUpModel::begin() {
  if (open() || devices_.lent()) return;
  const std::string kind = devices_.names().force;
  auto made = make_devices_as_kept({kind, "none"}, devices_.drivers());
  if (!made || made->force == nullptr)
    return messages_.say(Severity::error,
                         made ? "no force device is chosen: choose one in the menu Device" : made.error().message());
  devices_.lend();
  const ForceCapabilities can = made->force->capabilities();
  auto runner = BringUpRunner::start(std::move(made->force), {.limits = {}, .threaded = !deterministic_});
  noted_ = false;
  asked_.forget();
  if (runner) {
    runner_ = std::move(*runner);
    protocol_.emplace();
    protocol_->device = runner_->capabilities();
    protocol_->device.serial = runner_->serial();
  } else {
    protocol_ = unopened_protocol(kind, can, runner.error(), is_attached(kind, devices_.drivers()));
    messages_.say(Severity::error, runner.error().message());
  }
  protocol_->kind = kind;
  protocol_->date = protocol_date();
  protocol_->program = TANGENT_VERSION;
  protocol_->most_n = BringUpOptions{}.most_n;
  update();
}

void BringUpModel::end() {
  if (!open()) return;
  runner_.reset();
  protocol_.reset();
  devices_.give_back();
}

void BringUpModel::stop() {
  if (runner_ != nullptr) runner_->stop();
}

void BringUpModel::update() {
  if (runner_ == nullptr) return;
  protocol_->result = runner_->view();
  asked_.look(view().questions, view().t_s);
  if (!view().ended || std::exchange(noted_, true)) return;
  protocol_->cable = runner_->link_problem();
  protocol_->device.serial = runner_->serial();  // it may have been plugged in since
  if (view().why(view().step) == BringUpWhy::hangs)
    messages_.say(Severity::error, protocol_->device.name + ": " + why_text(BringUpWhy::hangs, view()));
  if (kept_.empty() || protocol_->device.simulated || protocol_->device.serial.empty()) return;
  if (const Status kept = keep_proved(kept_, proved_device(*protocol_)); !kept)
    messages_.say(Severity::error, kept.error().message());
}

void BringUpModel::advance(std::uint64_t ticks) {
  if (runner_ == nullptr) return;
  runner_->advance(ticks);
  update();
}

void BringUpModel::answer(BringUpAnswer answer) {
  if (runner_ != nullptr) runner_->answer(answer);
}

bool BringUpModel::settled() const {
  return runner_ != nullptr && runner_->settled() && (capabilities().simulated || asked_.long_enough());
}

void BringUpModel::save() {
  std::string name = "bring-up-" + protocol_->kind;
  if (!protocol_->device.serial.empty()) name += "-" + protocol_->device.serial;
  std::replace(name.begin(), name.end(), '/', '-');
  const Status written = write_protocol(*protocol_, name + ".json");
  messages_.say(written ? Severity::note : Severity::error,
                written ? name + ".json and " + name + ".md were written" : written.error().message());
}

}  // namespace tangent

// While it is held, idle processor cores don't fall into sleeps that take long to wake from: /dev/cpu_dma_latency at 0.
#pragma once

namespace tangent {

class CpuWakeup {
 public:
  CpuWakeup() = default;
  ~CpuWakeup() { hold(false); }
  CpuWakeup(const CpuWakeup&) = delete;
  CpuWakeup& operator=(const CpuWakeup&) = delete;

  /// Opens or closes a file: not in the servo's thread. Asked for again and again it does something only on a change.
  void hold(bool wanted);
  bool held() const { return file_ >= 0; }  ///< false also where the system refuses it

 private:
  int file_ = -1;
  bool wanted_ = false;
};

}  // namespace tangent

#pragma once

#include "uvc_device.h"

#include <deque>
#include <memory>

struct usbredirparser;

namespace onestroke::usb {

/// Plugs a device into QEMU by its usb-redir protocol, answers for it, and lets the script's events happen to it.
class UsbRedirection {
 public:
  /// socket: to QEMU's usb-redir device. All as long as this lives.
  UsbRedirection(int socket, UvcDevice& device, const CameraScript& script, EventLog& log);
  ~UsbRedirection();
  UsbRedirection(const UsbRedirection&) = delete;

  /// Takes what QEMU has sent. False where QEMU is gone.
  bool read();
  /// Does what is due, and sends what there is to send. False where QEMU is gone.
  bool step();
  /// When to step() again, unless read() comes first.
  std::optional<Time> next_at() const;

 private:
  /// A place that QEMU has made for a payload.
  struct Request {
    std::uint64_t id = 0;
    std::size_t most = 0;
  };

  static UsbRedirection& of(void* self) { return *static_cast<UsbRedirection*>(self); }
  void set_callbacks();
  void plug();
  void unplug();
  void describe_parts();
  void answer_control(std::uint64_t id, const void* header, std::span<const u8> sent);
  void cancel(std::uint64_t id);
  void send_payloads();
  void follow_script(Time now);
  bool silent() const { return hanging_ || !plugged_; }

  const int socket_;
  UvcDevice& device_;
  const CameraScript& script_;
  EventLog& log_;
  std::unique_ptr<usbredirparser, void (*)(usbredirparser*)> parser_;
  std::deque<Request> requests_;
  bool plugged_ = false, hanging_ = false, has_hung_ = false, has_gone_ = false;
  std::optional<Time> replug_at_, resume_at_;
};

}  // namespace onestroke::usb

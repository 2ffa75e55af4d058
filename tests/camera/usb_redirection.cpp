#include "usb_redirection.h"

#include "core/error.h"

#include <sys/socket.h>
#include <usbredirparser.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iostream>

namespace onestroke::usb {
namespace {

void say(void*, int level, const char* message) {
  if (level <= usbredirparser_warning) std::cerr << message << '\n';
}

}  // namespace

UsbRedirection::UsbRedirection(int socket, UvcDevice& device, const CameraScript& script, EventLog& log)
    : socket_(socket),
      device_(device),
      script_(script),
      log_(log),
      parser_(usbredirparser_create(), usbredirparser_destroy) {
  if (!parser_) throw Error("no memory for a parser of usb-redir; free some");
  set_callbacks();
  std::array<u32, USB_REDIR_CAPS_SIZE> capabilities{};
  for (const int can : {usb_redir_cap_connect_device_version, usb_redir_cap_ep_info_max_packet_size,
                        usb_redir_cap_64bits_ids, usb_redir_cap_32bits_bulk_length})
    usbredirparser_caps_set_cap(capabilities.data(), can);
  usbredirparser_init(parser_.get(), "usb_camera", capabilities.data(), USB_REDIR_CAPS_SIZE,
                      usbredirparser_fl_usb_host);
}

UsbRedirection::~UsbRedirection() = default;

void UsbRedirection::set_callbacks() {
  usbredirparser& p = *parser_;
  p.priv = this;
  p.log_func = say;
  p.read_func = [](void* self, std::uint8_t* bytes, int count) {
    const ssize_t got = recv(of(self).socket_, bytes, static_cast<std::size_t>(count), MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
    return got > 0 ? static_cast<int>(got) : -1;
  };
  p.write_func = [](void* self, std::uint8_t* bytes, int count) {
    return static_cast<int>(send(of(self).socket_, bytes, static_cast<std::size_t>(count), MSG_NOSIGNAL));
  };
  p.hello_func = [](void* self, usb_redir_hello_header*) { of(self).plug(); };
  p.reset_func = [](void* self) { of(self).device_.stop(); };
  p.set_configuration_func = [](void* self, std::uint64_t id, usb_redir_set_configuration_header* wanted) {
    usb_redir_configuration_status_header status{usb_redir_success, wanted->configuration};
    of(self).describe_parts();
    usbredirparser_send_configuration_status(of(self).parser_.get(), id, &status);
  };
  p.get_configuration_func = [](void* self, std::uint64_t id) {
    usb_redir_configuration_status_header status{usb_redir_success, 1};
    usbredirparser_send_configuration_status(of(self).parser_.get(), id, &status);
  };
  p.set_alt_setting_func = [](void* self, std::uint64_t id, usb_redir_set_alt_setting_header* wanted) {
    usb_redir_alt_setting_status_header status{usb_redir_success, wanted->interface, wanted->alt};
    of(self).describe_parts();
    usbredirparser_send_alt_setting_status(of(self).parser_.get(), id, &status);
  };
  p.get_alt_setting_func = [](void* self, std::uint64_t id, usb_redir_get_alt_setting_header* wanted) {
    usb_redir_alt_setting_status_header status{usb_redir_success, wanted->interface, 0};
    usbredirparser_send_alt_setting_status(of(self).parser_.get(), id, &status);
  };
  p.control_packet_func = [](void* self, std::uint64_t id, usb_redir_control_packet_header* header, std::uint8_t* bytes,
                             int count) {
    of(self).answer_control(id, header, {bytes, static_cast<std::size_t>(count)});
    usbredirparser_free_packet_data(of(self).parser_.get(), bytes);
  };
  p.bulk_packet_func = [](void* self, std::uint64_t id, usb_redir_bulk_packet_header* header, std::uint8_t* bytes,
                          int) {
    of(self).requests_.push_back({id, header->length | static_cast<std::size_t>(header->length_high) << 16});
    usbredirparser_free_packet_data(of(self).parser_.get(), bytes);
  };
  p.cancel_data_packet_func = [](void* self, std::uint64_t id) { of(self).cancel(id); };
}

void UsbRedirection::describe_parts() {
  constexpr std::size_t control_in = 0x10, stream_in = 0x10 + (stream_endpoint & 0xfU);
  usb_redir_ep_info_header endpoints{};
  std::ranges::fill(endpoints.type, static_cast<u8>(usb_redir_type_invalid));
  endpoints.type[0] = endpoints.type[control_in] = usb_redir_type_control;
  endpoints.max_packet_size[0] = endpoints.max_packet_size[control_in] = 64;
  endpoints.type[stream_in] = usb_redir_type_bulk;
  endpoints.interface[stream_in] = streaming_interface;
  endpoints.max_packet_size[stream_in] = 512;
  usbredirparser_send_ep_info(parser_.get(), &endpoints);

  constexpr u8 video_class = 0x0e;
  usb_redir_interface_info_header interfaces{};
  interfaces.interface_count = 2;
  for (const u8 i : {control_interface, streaming_interface}) {
    interfaces.interface[i] = i;
    interfaces.interface_class[i] = video_class;
    interfaces.interface_subclass[i] = static_cast<u8>(i + 1);
  }
  usbredirparser_send_interface_info(parser_.get(), &interfaces);
}

void UsbRedirection::plug() {
  describe_parts();
  // The class says that the interfaces are grouped.
  usb_redir_device_connect_header device{usb_redir_speed_high, 0xef, 2, 1, vendor_id, product_id, device_release};
  usbredirparser_send_device_connect(parser_.get(), &device);
  plugged_ = true;
  log_.add("plug");
}

void UsbRedirection::unplug() {
  device_.stop();
  requests_.clear();
  plugged_ = false;
  usbredirparser_send_device_disconnect(parser_.get());
  log_.add("unplug");
}

void UsbRedirection::answer_control(std::uint64_t id, const void* header, std::span<const u8> sent) {
  if (!plugged_) return;
  auto reply = *static_cast<const usb_redir_control_packet_header*>(header);
  const std::optional<Bytes> answer =
      device_.answer({reply.requesttype, reply.request, reply.value, reply.index, reply.length}, sent);
  const bool to_host = (reply.requesttype & 0x80) != 0;
  reply.status = answer ? usb_redir_success : usb_redir_stall;
  Bytes bytes = answer && to_host ? *answer : Bytes{};
  reply.length = static_cast<u16>(!answer ? 0 : to_host ? bytes.size() : sent.size());
  usbredirparser_send_control_packet(parser_.get(), id, &reply, bytes.empty() ? nullptr : bytes.data(),
                                     static_cast<int>(bytes.size()));
}

void UsbRedirection::cancel(std::uint64_t id) {
  if (std::erase_if(requests_, [id](const Request& r) { return r.id == id; }) == 0) return;
  usb_redir_bulk_packet_header reply{};
  reply.endpoint = stream_endpoint;
  reply.status = usb_redir_cancelled;
  usbredirparser_send_bulk_packet(parser_.get(), id, &reply, nullptr, 0);
}

void UsbRedirection::send_payloads() {
  while (PayloadStream* const stream = silent() || requests_.empty() ? nullptr : device_.stream()) {
    Bytes payload = stream->take(std::min(requests_.front().most, payload_bytes));
    if (payload.empty()) return;
    usb_redir_bulk_packet_header reply{};
    reply.endpoint = stream_endpoint;
    reply.status = usb_redir_success;
    reply.length = static_cast<u16>(payload.size());
    reply.length_high = static_cast<u16>(payload.size() >> 16);
    usbredirparser_send_bulk_packet(parser_.get(), requests_.front().id, &reply, payload.data(),
                                    static_cast<int>(payload.size()));
    requests_.pop_front();
    if (stream->between_pictures()) follow_script(Time::now());
  }
}

void UsbRedirection::follow_script(Time now) {
  if (script_.hang_after && !has_hung_ && device_.sent() >= *script_.hang_after) {
    has_hung_ = hanging_ = true;
    if (script_.hang_for) resume_at_ = now + *script_.hang_for;
    log_.add("hang");
  }
  if (script_.unplug_after && !has_gone_ && device_.sent() >= *script_.unplug_after) {
    has_gone_ = true;
    if (script_.replug_after) replug_at_ = now + *script_.replug_after;
    unplug();
  }
  if (resume_at_ && now >= *resume_at_) {
    resume_at_.reset();
    hanging_ = false;
    if (device_.stream()) device_.stream()->resume();
    log_.add("resume");
  }
  if (replug_at_ && now >= *replug_at_) {
    replug_at_.reset();
    plug();
  }
}

bool UsbRedirection::read() {
  return usbredirparser_do_read(parser_.get()) != usbredirparser_read_io_error;
}

bool UsbRedirection::step() {
  follow_script(Time::now());
  send_payloads();
  while (usbredirparser_has_data_to_write(parser_.get()) > 0)
    if (usbredirparser_do_write(parser_.get()) != 0) return false;
  return true;
}

std::optional<Time> UsbRedirection::next_at() const {
  std::optional<Time> next = replug_at_;
  const auto earlier = [&next](std::optional<Time> time) {
    if (time && (!next || *time < *next)) next = time;
  };
  earlier(resume_at_);
  if (!silent() && !requests_.empty() && device_.stream()) earlier(device_.stream()->next_at());
  return next;
}

}  // namespace onestroke::usb

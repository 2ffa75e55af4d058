// A USB camera for QEMU: plays pictures from folders to the guest, and lets happen to them what the options say.
#include "clock_service.h"
#include "core/error.h"
#include "local_socket.h"
#include "usb_redirection.h"

#include <CLI/CLI.hpp>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iostream>

namespace onestroke::usb {
namespace {

struct Options {
  std::string usb, clock, log;
  std::vector<std::string> formats;
  CameraScript script;
  std::optional<double> replug_after, hang_for;
};

void read(CLI::App& app, Options& options, int argc, char** argv) {
  app.add_option("--usb", options.usb, "Socket for QEMU's usb-redir device to connect to")->required();
  app.add_option("--clock", options.clock, "Socket for the guest's questions about the time")->required();
  app.add_option("--log", options.log, "File for what happens, a line of JSON each")->required();
  app.add_option("--format", options.formats,
                 "MJPG:WIDTHxHEIGHT:FOLDER or YUYV:WIDTHxHEIGHT:FOLDER; several may be given")
      ->required();
  app.add_option("--rate", options.script.rate, "Pictures a second")->check(CLI::Range(0.1, 1000.0));
  app.add_flag("--loop", options.script.loop, "Begin again after a folder's last picture");
  app.add_option("--cut-every", options.script.cut_every, "Send half of every Nth picture");
  app.add_option("--unplug-after", options.script.unplug_after, "Go after N pictures");
  app.add_option("--replug-after", options.replug_after, "Come back so many seconds later");
  app.add_option("--hang-after", options.script.hang_after, "Stay silent after N pictures");
  app.add_option("--hang-for", options.hang_for, "Go on so many seconds later");
  app.parse(argc, argv);
  const auto span = [](std::optional<double> seconds) {
    return seconds ? std::optional(Duration::from_seconds(*seconds)) : std::nullopt;
  };
  options.script.replug_after = span(options.replug_after);
  options.script.hang_for = span(options.hang_for);
}

/// Until the guest's port is gone.
void play(int usb, int clock, UvcDevice& device, const CameraScript& script, EventLog& log) {
  UsbRedirection redirection(usb, device, script, log);
  const ClockService service(clock);
  std::array<pollfd, 2> sockets{pollfd{usb, POLLIN, 0}, pollfd{clock, POLLIN, 0}};
  while (redirection.step()) {
    timespec rest{};
    const std::optional<Time> next = redirection.next_at();
    if (next) {
      const std::int64_t ns = std::max<std::int64_t>((*next - Time::now()).ns, 0);
      rest = {ns / 1'000'000'000, ns % 1'000'000'000};
    }
    if (ppoll(sockets.data(), sockets.size(), next ? &rest : nullptr, nullptr) < 0 && errno != EINTR) return;
    if (sockets[1].revents != 0 && !service.answer()) sockets[1].fd = -1;
    if (sockets[0].revents != 0 && !redirection.read()) return;
  }
}

int run(int argc, char** argv) {
  CLI::App app("Plays a USB camera to QEMU.");
  Options options;
  try {
    read(app, options, argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  std::vector<VideoMode> modes;
  for (const std::string& text : options.formats) modes.push_back(read_video_mode(text));
  EventLog log(options.log);
  UvcDevice device(modes, options.script, log);
  const LocalSocket usb = listen_at(options.usb), clock = listen_at(options.clock);
  const LocalSocket usb_connection = usb.accept(), clock_connection = clock.accept();
  play(usb_connection.descriptor(), clock_connection.descriptor(), device, options.script, log);
  return 0;
}

}  // namespace
}  // namespace onestroke::usb

int main(int argc, char** argv) try {
  return onestroke::usb::run(argc, argv);
} catch (const onestroke::UsageError& error) {
  std::cerr << "usb_camera: " << error.what() << '\n';
  return 2;
} catch (const std::exception& error) {
  std::cerr << "usb_camera: " << error.what() << '\n';
  return 1;
}

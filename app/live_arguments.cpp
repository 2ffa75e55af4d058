#include "app/live_arguments.h"

#include "app/argument_checks.h"
#include "app/help_text.h"

#include <array>
#include <cstdio>

namespace onestroke {
namespace {

constexpr std::array live_arguments{"--size", "--format",        "--rate",           "--exposure-ms",
                                    "--gain", "--white-balance", "--clock-offset-ms"};
constexpr int longest_side = 16384;

/// WIDTHxHEIGHT.
std::optional<PictureSize> size_of(const std::string& text) {
  PictureSize size;
  int read = 0;
  const bool whole = std::sscanf(text.c_str(), "%5dx%5d%n", &size.width, &size.height, &read) == 2 &&
                     static_cast<std::size_t>(read) == text.size();
  const bool sound =
      whole && size.width > 0 && size.height > 0 && size.width <= longest_side && size.height <= longest_side;
  return sound ? std::optional(size) : std::nullopt;
}

}  // namespace

void add_live_arguments(CLI::App& command, LiveOptions& options) {
  command
      .add_option_function<std::string>(
          "--size", [&options](const std::string& text) { options.size = size_of(text); }, help::size)
      ->type_name("WxH")
      ->check(check([](const std::string& text) {
        return size_of(text) ? std::string() : "\"" + text + "\" must be a size in pixels, as 1280x720";
      }));
  command.add_option("--format", options.format, help::format)
      ->type_name("FORMAT")
      ->check(one_of({{"nv12", More::none}, {"yuyv", More::none}, {"mjpeg", More::none}, {"rgb", More::none}},
                     "nv12, yuyv, mjpeg or rgb"));
  command.add_option("--rate", options.rate, help::rate)
      ->type_name("N")
      ->check(number_between(0.1, 1000, " pictures a second"));
  command
      .add_option_function<double>(
          "--exposure-ms", [&options](double ms) { options.exposure = Duration::from_ms(ms); }, help::exposure)
      ->type_name("MS")
      ->check(number_between(0.01, 1000, " milliseconds"));
  command.add_option("--gain", options.gain, help::gain)->type_name("G")->check(number_between(1, 1000, ""));
  command.add_option("--white-balance", options.white_balance, help::white_balance)
      ->type_name("K")
      ->check(number_between(1000, 20000, " kelvin"));
  command
      .add_option_function<double>(
          "--clock-offset-ms", [&options](double ms) { options.clock_offset = Duration::from_ms(ms); },
          help::clock_offset)
      ->type_name("MS")
      ->check(number_between(-1000, 1000, " milliseconds"));
}

std::string misplaced_live_argument(const CLI::App& command, const std::string& camera) {
  if (camera.starts_with("libcamera")) return {};
  for (const char* argument : live_arguments)
    if (command.get_option_no_throw(argument) && command.count(argument) > 0)
      return std::string(argument) +
             " is for a camera that is connected: give --camera libcamera with it, or leave it out";
  return {};
}

}  // namespace onestroke

#include "app/calibrate_command.h"
#include "app/command_line.h"
#include "app/doctor_command.h"
#include "app/marker_command.h"
#include "app/run_command.h"
#include "app/say.h"
#include "app/track_command.h"
#include "core/error.h"

#include <exception>
#include <iostream>

namespace {

enum ExitCode { done = 0, failed = 1, wrong_usage = 2 };

int execute(const onestroke::RunOptions& options) {
  return onestroke::run_command(options, std::cout);
}
int execute(const onestroke::TrackOptions& options) {
  return onestroke::track_command(options, std::cout);
}
int execute(const onestroke::MarkerOptions& options) {
  return onestroke::marker_command(options, std::cout);
}
int execute(const onestroke::CalibrateOptions& options) {
  return onestroke::calibrate_command(options, std::cout);
}
int execute(const onestroke::DoctorOptions& options) {
  return onestroke::doctor_command(options, std::cout);
}
int execute(const onestroke::PrintText& print) {
  std::cout << print.text << std::flush;
  return std::cout ? done : failed;
}

int fail(const std::exception& error, ExitCode code) {
  onestroke::say(error.what());
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const onestroke::Command command = onestroke::parse_command_line({argv + (argc > 0), argv + argc});
    return std::visit([](const auto& options) { return execute(options); }, command);
  } catch (const onestroke::UsageError& error) {
    return fail(error, wrong_usage);
  } catch (const std::exception& error) {
    return fail(error, failed);
  }
}

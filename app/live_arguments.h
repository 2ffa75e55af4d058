#pragma once

#include "camera/live_options.h"

#include <CLI/CLI.hpp>

#include <string>

namespace onestroke {

/// The options of a command that say how a live camera is to take its pictures.
void add_live_arguments(CLI::App& command, LiveOptions& options);

/// Which of them was given although the camera is no device; empty where none was.
std::string misplaced_live_argument(const CLI::App& command, const std::string& camera);

}  // namespace onestroke

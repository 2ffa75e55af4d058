#pragma once

#include <string>

namespace CLI {
class App;
}

namespace onestroke {

/// A script for bash that completes the program's commands and options, made from the options themselves.
std::string bash_completion(const CLI::App& program);

}  // namespace onestroke

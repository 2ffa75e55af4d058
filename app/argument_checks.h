#pragma once

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <vector>

namespace onestroke {

/// A check whose failure is a message; it adds nothing to the option's name in the help.
CLI::Validator check(std::function<std::string(const std::string&)> test);

CLI::Validator number_between(double low, double high, const std::string& unit);
CLI::Validator whole_number(int low, int high);
CLI::Validator not_empty();

/// `word`, or `word:` and more: whether more must, may or may not follow.
enum class More { none, may, must };
struct Form {
  std::string word;
  More more;
};

CLI::Validator one_of(std::vector<Form> forms, const std::string& spelled);

}  // namespace onestroke

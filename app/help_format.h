#pragma once

#include <CLI/CLI.hpp>

#include <sstream>
#include <string>

namespace onestroke {

/// CLI11's help with descriptions wrapped to fit a terminal.
class HelpFormat : public CLI::Formatter {
 public:
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(option->get_description(), text_columns);
  }

 private:
  static constexpr std::size_t text_columns = 70;  // beside the 30 of the option's name

  static std::string wrapped(const std::string& text, std::size_t columns) {
    std::istringstream words(text);
    std::string lines, word;
    std::size_t used = 0;
    while (words >> word) {
      const bool fits = used + 1 + word.size() <= columns;
      if (used > 0) lines += fits ? ' ' : '\n';
      used = (used > 0 && fits ? used + 1 : 0) + word.size();
      lines += word;
    }
    return lines;
  }
};

}  // namespace onestroke

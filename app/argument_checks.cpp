#include "app/argument_checks.h"

#include <sstream>
#include <utility>

namespace onestroke {

CLI::Validator check(std::function<std::string(const std::string&)> test) {
  return CLI::Validator([test = std::move(test)](std::string& text) { return test(text); }, "");
}

CLI::Validator number_between(double low, double high, const std::string& unit) {
  return check([=](const std::string& text) -> std::string {
    double value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
    std::ostringstream message;
    message << "\"" << text << "\" must be a number from " << low << " to " << high << unit;
    return message.str();
  });
}

CLI::Validator whole_number(int low, int high) {
  return check([=](const std::string& text) -> std::string {
    int value = 0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
    return "\"" + text + "\" must be a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  });
}

CLI::Validator not_empty() {
  return check([](const std::string& text) { return text.empty() ? "it must not be empty" : std::string(); });
}

CLI::Validator one_of(std::vector<Form> forms, const std::string& spelled) {
  return check([forms = std::move(forms), spelled](const std::string& text) -> std::string {
    const std::size_t colon = text.find(':');
    const bool more = colon != std::string::npos && colon + 1 < text.size();
    for (const Form& form : forms) {
      if (text.substr(0, colon) != form.word) continue;
      if (more ? form.more != More::none : form.more != More::must && colon == std::string::npos) return {};
    }
    return "\"" + text + "\" must be " + spelled;
  });
}

}  // namespace onestroke

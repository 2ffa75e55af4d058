#include "camera/synthetic_options.h"

#include "core/error.h"

#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

namespace onestroke {
namespace {

[[noreturn]] void refuse(std::string_view key, std::string_view value, const std::string& wanted) {
  throw UsageError("camera synthetic: " + std::string(key) + "=" + std::string(value) + " is not possible; give " +
                   wanted);
}

std::string short_text(double v) {
  std::ostringstream out;
  out << v;
  return out.str();
}

double number(std::string_view key, std::string_view value, double least, double most) {
  double v = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), v);
  if (error != std::errc{} || end != value.data() + value.size() || !(v >= least && v <= most)) {
    refuse(key, value, "a number from " + short_text(least) + " to " + short_text(most));
  }
  return v;
}

std::int64_t whole(std::string_view key, std::string_view value, std::int64_t least, std::int64_t most) {
  std::int64_t v = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), v);
  if (error != std::errc{} || end != value.data() + value.size() || v < least || v > most) {
    refuse(key, value, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return v;
}

int small(std::string_view key, std::string_view value, int least, int most) {
  return static_cast<int>(whole(key, value, least, most));
}

constexpr std::array<std::pair<std::string_view, ScriptKind>, 15> scripts{{{"hands", ScriptKind::hands},
                                                                           {"side", ScriptKind::side},
                                                                           {"link", ScriptKind::link},
                                                                           {"mirror", ScriptKind::mirror},
                                                                           {"overlay", ScriptKind::overlay},
                                                                           {"section", ScriptKind::section},
                                                                           {"measure", ScriptKind::measure},
                                                                           {"freeze", ScriptKind::freeze},
                                                                           {"snapshot", ScriptKind::snapshot},
                                                                           {"card", ScriptKind::card},
                                                                           {"menu", ScriptKind::menu},
                                                                           {"turn_x", ScriptKind::turn_x},
                                                                           {"turn_y", ScriptKind::turn_y},
                                                                           {"turn_z", ScriptKind::turn_z},
                                                                           {"still", ScriptKind::still}}};

/// "a, b or c".
std::string known_scripts() {
  std::string out;
  for (std::size_t i = 0; i < scripts.size(); ++i) {
    out += (i == 0 ? "" : i + 1 < scripts.size() ? ", " : " or ") + std::string(scripts[i].first);
  }
  return out;
}

ScriptKind script(std::string_view key, std::string_view value) {
  for (const auto& [name, kind] : scripts) {
    if (name == value) return kind;
  }
  refuse(key, value, known_scripts());
}

constexpr int most_id = 1'000'000'000;

void read_ids(SyntheticOptions& o, std::string_view key, std::string_view value) {
  const std::size_t plus = value.find('+');
  if (plus == std::string_view::npos) refuse(key, value, "two ids of the catalogue, as in ids=1+2");
  o.first_id = small(key, value.substr(0, plus), 0, most_id);
  o.second_id = small(key, value.substr(plus + 1), 0, most_id);
  if (o.first_id == o.second_id) refuse(key, value, "two different ids");
}

using Reader = void (*)(SyntheticOptions&, std::string_view key, std::string_view value);

constexpr std::array<std::pair<std::string_view, Reader>, 23> readers{{
    {"width", [](auto& o, auto k, auto v) { o.width = small(k, v, 16, 8192); }},
    {"height", [](auto& o, auto k, auto v) { o.height = small(k, v, 16, 8192); }},
    {"fov_deg", [](auto& o, auto k, auto v) { o.fov_deg = number(k, v, 5, 140); }},
    {"fps", [](auto& o, auto k, auto v) { o.fps = number(k, v, 0.1, 1000); }},
    {"seconds", [](auto& o, auto k, auto v) { o.seconds = number(k, v, 0, 1e6); }},
    {"seed", [](auto& o, auto k, auto v) { o.seed = static_cast<std::uint64_t>(whole(k, v, 0, INT64_MAX)); }},
    {"threads", [](auto& o, auto k, auto v) { o.threads = small(k, v, 1, 16); }},
    {"live", [](auto& o, auto k, auto v) { o.live = small(k, v, 0, 1) == 1; }},
    {"script", [](auto& o, auto k, auto v) { o.script = script(k, v); }},
    {"distance", [](auto& o, auto k, auto v) { o.distance = number(k, v, 50, 5000); }},
    {"step_deg", [](auto& o, auto k, auto v) { o.step_deg = number(k, v, 0.01, 180); }},
    {"marker", [](auto& o, auto k, auto v) { o.marker = small(k, v, 0, most_id); }},
    {"ids", read_ids},
    {"fingers", [](auto& o, auto k, auto v) { o.fingers = small(k, v, 0, 2); }},
    {"head", [](auto& o, auto k, auto v) { o.head = small(k, v, 0, 1) == 1; }},
    {"right_mm", [](auto& o, auto k, auto v) { o.right_mm = number(k, v, -1000, 1000); }},
    {"exposure_ms", [](auto& o, auto k, auto v) { o.exposure_ms = number(k, v, 0, 1000); }},
    {"readout_ms", [](auto& o, auto k, auto v) { o.readout_ms = number(k, v, 0, 1000); }},
    {"noise", [](auto& o, auto k, auto v) { o.noise = number(k, v, 0, 64); }},
    {"gain", [](auto& o, auto k, auto v) { o.gain = number(k, v, 0.001, 100); }},
    {"light_kelvin", [](auto& o, auto k, auto v) { o.light_kelvin = number(k, v, 2000, 12000); }},
    {"blur", [](auto& o, auto k, auto v) { o.blur = number(k, v, 0, 20); }},
    {"brightness", [](auto& o, auto k, auto v) { o.gain = number(k, v, 0.001, 100); }},
}};

std::string known_keys() {
  std::string out;
  for (const auto& [name, reader] : readers) out += (out.empty() ? "" : ", ") + std::string(name);
  return out;
}

}  // namespace

SyntheticOptions parse_synthetic_options(const std::string& text) {
  SyntheticOptions options;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const std::string_view whole_part = part;
    const std::size_t equals = whole_part.find('=');
    const std::string_view key = whole_part.substr(0, equals);
    bool found = false;
    for (const auto& [name, reader] : readers) {
      if (name != key) continue;
      if (equals == std::string_view::npos) refuse(key, "", "a value");
      reader(options, key, whole_part.substr(equals + 1));
      found = true;
    }
    if (!found) {
      throw UsageError("camera synthetic: no setting is called \"" + std::string(key) + "\"; known are " +
                       known_keys());
    }
  }
  return options;
}

}  // namespace onestroke

#include "app/model_card.h"

#include <filesystem>
#include <sstream>

namespace onestroke {
namespace {

constexpr std::size_t line_length = 40;

std::size_t length_of(const std::string& utf8) {
  std::size_t count = 0;
  for (const char c : utf8) count += (c & 0xc0) != 0x80;
  return count;
}

/// Broken at spaces; lines after the first are set in.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && length_of(line) + 1 + length_of(word) > line_length) {
      lines += line + "\n";
      line = "  " + word;
    } else {
      line += (line.empty() ? "" : " ") + word;
    }
  }
  return lines + line;
}

}  // namespace

std::string model_card(const MarkerSpec& marker) {
  std::string title = marker.model_name.empty() ? marker.name : marker.model_name;
  if (!marker.version.empty()) title += " " + marker.version;
  std::string card = wrapped(title);
  if (marker.model.empty()) return card + "\nno model";
  card += "\n" + wrapped(std::filesystem::path(marker.model).filename().string());
  for (const ModelNote& note : marker.notes) card += "\n" + wrapped(note.first + ": " + note.second);
  return card;
}

}  // namespace onestroke

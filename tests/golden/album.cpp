#include "golden/album.h"

#include <fstream>
#include <ostream>
#include <sstream>

namespace onestroke::golden {

namespace {

constexpr const char* bless_command = "tests/bless";

/// Without what the first pair of brackets says of the processor.
std::string kind_of(const std::string& gpu) {
  const std::size_t from = gpu.find(" ("), to = gpu.find("), ");
  if (from == std::string::npos || to == std::string::npos || to < from) return gpu;
  return gpu.substr(0, from) + gpu.substr(to + 1);
}

}  // namespace

bool draw_alike(const std::string& gpu, const std::string& other) {
  return kind_of(gpu) == kind_of(other);
}

Album::Album(Folders folders, std::string drawn_by, std::string bless, std::ostream& out)
    : folders_(std::move(folders)), drawn_by_(std::move(drawn_by)), bless_(std::move(bless)), out_(out) {}

std::string Album::recorded() const {
  std::string line;
  std::getline(std::ifstream(folders_.pictures / "made_with.txt"), line);
  return line;
}

bool Album::blesses(const std::string& name) const {
  std::istringstream names(bless_);
  for (std::string one; std::getline(names, one, ',');)
    if (one == name || one == "all") return true;
  return false;
}

std::string Album::check(const std::string& name, const Picture& actual, Tolerance tolerance) const {
  const bool alike = draw_alike(recorded(), drawn_by_);
  if (blesses(name) && (alike || bless_ == "all")) {
    // Processors round differently, which is no reason to change all pictures; one that is asked for by name is
    // changed.
    return bless(name, actual, alike && bless_ == "all" ? tolerance : Tolerance{.level = 0});
  }
  if (!alike)
    return name + " was drawn by " + (recorded().empty() ? "nobody knows what" : recorded()) +
           " and is not compared with what " + drawn_by_ +
           " draws: install that driver, or draw all golden pictures anew with " + bless_command;
  if (!std::filesystem::exists(file_of(name)))
    return "there is no golden picture " + file_of(name).string() + ": draw it with " + bless_command + " " + name;
  const Picture expected = read_png(file_of(name));
  const Comparison comparison = compare(expected, actual, tolerance);
  return comparison.same ? std::string() : differs(name, expected, actual, comparison);
}

std::string Album::differs(const std::string& name, const Picture& expected, const Picture& actual,
                           const Comparison& comparison) const {
  write_png(folders_.failures / (name + ".expected.png"), expected);
  write_png(folders_.failures / (name + ".actual.png"), actual);
  std::string look = "{expected,actual}";
  if (!comparison.difference.rgb.empty()) {
    write_png(folders_.failures / (name + ".difference.png"), comparison.difference);
    look = "{expected,actual,difference}";
  }
  return name + ": " + comparison.words + "\nlook at " + (folders_.failures / name).string() + "." + look +
         ".png; if the new picture is right, run " + bless_command + " " + name;
}

/// Says what became of the picture, for tests/bless to read. The driver is recorded there, when all
/// pictures are its own.
std::string Album::bless(const std::string& name, const Picture& actual, Tolerance forgiven) const {
  std::string what = "new";
  bool write = true;
  if (std::filesystem::exists(file_of(name))) {
    const Comparison comparison = compare(read_png(file_of(name)), actual, forgiven);
    write = !comparison.same;
    what = write                   ? "changed, " + comparison.words
           : comparison.worst == 0 ? "same"
                                   : "the same but for what its test forgives";
  }
  if (write) write_png(file_of(name), actual);
  out_ << "blessed " << name << ": " << what << "\ndrawn by " << drawn_by_ << std::endl;
  return {};
}

}  // namespace onestroke::golden

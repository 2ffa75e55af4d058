#pragma once

#include "marker/catalog.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace onestroke {

/// What a message calls an entry, e.g. `marker 3 ("m03")`. number counts from 1 in a file, and is the id in a store.
std::string entry_label(long long number, const std::string& name);

/// Throws Error, without naming the entry, where a marker alone is wrong: id, name, code, what is said of the model, or
/// code and shape at odds.
void check_marker(const MarkerSpec& marker);

/// Keeps account of what must be unique in a catalogue.
class Uniqueness {
 public:
  /// Throws Error, without naming the entry itself, where its id, name or code is taken; it then names who has it.
  void add(const MarkerSpec& marker, const std::string& label);

 private:
  std::map<int, std::string> ids_;
  std::map<std::string, std::string> names_;
  std::map<std::pair<std::size_t, std::uint64_t>, std::string> codes_;
};

void sort_by_id(Catalog& catalog);

}  // namespace onestroke

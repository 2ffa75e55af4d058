#pragma once

#include "marker/catalog.h"

#include <string>

namespace onestroke {

/// What is known of a marker's model, lines of about 40 characters: its name and version, its file, its notes.
std::string model_card(const MarkerSpec& marker);

}  // namespace onestroke

#include "app/say.h"

#include "core/error.h"

#include <iostream>

namespace onestroke {

void say(const std::string& line) {
  std::cerr << "onestroke: " << line << '\n';
}

void end_output(std::ostream& out) {
  if (!out.flush())
    throw Error("standard output cannot be written; check where it leads and that the disk is not full");
}

}  // namespace onestroke

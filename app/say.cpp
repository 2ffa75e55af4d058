#include "app/say.h"

#include <iostream>

namespace onestroke {

void say(const std::string& line) {
  std::cerr << "onestroke: " << line << '\n';
}

}  // namespace onestroke

#pragma once

namespace onestroke {

/// From now on Ctrl-C asks the program to end in good order, so that films are whole; a second one ends it at once.
void catch_interrupt();
/// True once it was asked.
bool interrupted();

}  // namespace onestroke

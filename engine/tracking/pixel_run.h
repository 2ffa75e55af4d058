#pragma once

namespace onestroke {

/// Pixels of one row, from x0 to before x1.
struct PixelRun {
  int y = 0, x0 = 0, x1 = 0;
};

}  // namespace onestroke

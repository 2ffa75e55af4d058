#pragma once

#include "core/time.h"

namespace onestroke {

/// What the clock of the machine that the guest runs on says.
class MachineClock {
 public:
  /// How far it is ahead of the guest's own, and by how much that may be wrong.
  struct Lead {
    Time at;  ///< On the guest's clock.
    Duration lead, error;
  };

  /// Throws Error where CAMERA_CLOCK names no port to ask at.
  MachineClock();
  ~MachineClock();
  MachineClock(const MachineClock&) = delete;

  /// Asks fifty times and keeps what came back soonest. Throws Error where there is no answer.
  Lead ask() const;

 private:
  Lead ask_once() const;

  int port_ = -1;
};

}  // namespace onestroke

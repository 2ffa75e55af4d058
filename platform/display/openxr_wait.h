#pragma once

#include "display/openxr.h"

#include <memory>

namespace onestroke {

/// A headset, as soon as there are a runtime and a headset, or the error that there are none once `give_up` says so; on
/// stderr a line that says what is waited for. Throws Error as OpenXrDisplay does for what waiting does not mend.
std::unique_ptr<Display> wait_for_headset(const OpenXrOptions& options, bool (*give_up)());

}  // namespace onestroke

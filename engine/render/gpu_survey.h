#pragma once

#include <string>
#include <vector>

namespace onestroke {

/// What there is of Vulkan.
struct GpuSurvey {
  struct Device {
    std::string name{}, driver{}, api{};
    std::string lacking{};  ///< Why it cannot be used, as Gpu has it; empty where it can.
  };

  std::string loader{};   ///< Its version; empty where it is missing.
  std::string failure{};  ///< What keeps Vulkan from starting, with the remedy; empty where it starts.
  bool validation = false;
  std::vector<Device> devices{};
};

/// Starts no device. Throws nothing of Vulkan's.
GpuSurvey survey_gpus();

}  // namespace onestroke

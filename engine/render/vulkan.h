#pragma once

// Every file that speaks Vulkan-Hpp includes this one, so that all see it configured alike (designated initialisers).
#define VULKAN_HPP_NO_CONSTRUCTORS
#include <vulkan/vulkan_raii.hpp>

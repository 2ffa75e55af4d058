#pragma once

#include <cstdint>
#include <span>

/// The shaders of this folder, compiled at build time: SPIR-V words for Vulkan 1.3, entry point "main".
namespace onestroke::spirv {

std::span<const std::uint32_t> passthrough_vert();
std::span<const std::uint32_t> passthrough_frag();
std::span<const std::uint32_t> finger_vert();
std::span<const std::uint32_t> finger_frag();
std::span<const std::uint32_t> full_screen_vert();
std::span<const std::uint32_t> depth_frag();
std::span<const std::uint32_t> foreground_frag();
std::span<const std::uint32_t> probe_frag();
std::span<const std::uint32_t> unpack_frag();
std::span<const std::uint32_t> model_vert();
std::span<const std::uint32_t> model_frag();
std::span<const std::uint32_t> cut_vert();
std::span<const std::uint32_t> cut_frag();
std::span<const std::uint32_t> quad_vert();
std::span<const std::uint32_t> quad_frag();
std::span<const std::uint32_t> line_vert();
std::span<const std::uint32_t> line_frag();
std::span<const std::uint32_t> imgui_vert();
std::span<const std::uint32_t> imgui_frag();

}  // namespace onestroke::spirv

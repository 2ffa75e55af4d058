#include "shaders/spirv.h"

namespace onestroke::spirv {

namespace {

#include "cut_frag.spv.h"
#include "cut_vert.spv.h"
#include "depth_frag.spv.h"
#include "finger_frag.spv.h"
#include "finger_vert.spv.h"
#include "foreground_frag.spv.h"
#include "full_screen_vert.spv.h"
#include "imgui_frag.spv.h"
#include "imgui_vert.spv.h"
#include "line_frag.spv.h"
#include "line_vert.spv.h"
#include "model_frag.spv.h"
#include "model_vert.spv.h"
#include "passthrough_frag.spv.h"
#include "passthrough_vert.spv.h"
#include "probe_frag.spv.h"
#include "quad_frag.spv.h"
#include "quad_vert.spv.h"
#include "unpack_frag.spv.h"

}  // namespace

std::span<const std::uint32_t> passthrough_vert() {
  return passthrough_vert_words;
}
std::span<const std::uint32_t> passthrough_frag() {
  return passthrough_frag_words;
}
std::span<const std::uint32_t> finger_vert() {
  return finger_vert_words;
}
std::span<const std::uint32_t> finger_frag() {
  return finger_frag_words;
}
std::span<const std::uint32_t> full_screen_vert() {
  return full_screen_vert_words;
}
std::span<const std::uint32_t> depth_frag() {
  return depth_frag_words;
}

std::span<const std::uint32_t> foreground_frag() {
  return foreground_frag_words;
}
std::span<const std::uint32_t> probe_frag() {
  return probe_frag_words;
}
std::span<const std::uint32_t> unpack_frag() {
  return unpack_frag_words;
}
std::span<const std::uint32_t> model_vert() {
  return model_vert_words;
}
std::span<const std::uint32_t> model_frag() {
  return model_frag_words;
}
std::span<const std::uint32_t> cut_vert() {
  return cut_vert_words;
}
std::span<const std::uint32_t> cut_frag() {
  return cut_frag_words;
}
std::span<const std::uint32_t> quad_vert() {
  return quad_vert_words;
}
std::span<const std::uint32_t> quad_frag() {
  return quad_frag_words;
}
std::span<const std::uint32_t> line_vert() {
  return line_vert_words;
}
std::span<const std::uint32_t> line_frag() {
  return line_frag_words;
}
std::span<const std::uint32_t> imgui_vert() {
  return imgui_vert_words;
}
std::span<const std::uint32_t> imgui_frag() {
  return imgui_frag_words;
}

}  // namespace onestroke::spirv

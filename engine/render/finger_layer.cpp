#include "render/finger_layer.h"

#include "render/lens_map.h"
#include "scene/frames.h"
#include "shaders/shared.h"

#include <algorithm>
#include <cmath>

namespace onestroke {

namespace {

constexpr std::uint32_t side = FingerMatte::side;

/// Cells of the surface, from first to before end.
struct Cells {
  std::uint32_t first, end;
};

// A lens bends the edges of a finger's rectangle by less than a cell.
Cells cells_between(double from, double to, const SurfaceAxis& axis) {
  return {static_cast<std::uint32_t>(std::max(std::floor(axis.cell_of(from)) - 1, 0.0)),
          static_cast<std::uint32_t>(std::min(std::ceil(axis.cell_of(to)) + 1, static_cast<double>(axis.cells)))};
}

}  // namespace

FingerLayer::FingerLayer(Device& device)
    : image_(device, {.format = vk::Format::eR8Unorm,
                      .width = side,
                      .height = side,
                      .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst}) {
  for (Buffer& buffer : staging_)
    buffer = Buffer(device, std::uint64_t{side} * side, vk::BufferUsageFlagBits::eTransferSrc, MemoryPool::Use::upload);
}

void FingerLayer::find(const Picture& picture, std::span<const CoveredCell> cells) {
  matte_.find(picture, cells);
  for (std::size_t i = 0; i < matte_.fingers().size(); ++i) {
    const FingerMatte::Finger& f = matte_.fingers()[i];
    const auto [left, top] = without_lens(picture.intrinsics, f.left, f.top);
    const auto [right, bottom] = without_lens(picture.intrinsics, f.right, f.bottom);
    bounds_[i] = {left, top, right, bottom};
  }
  pending_ = pending_ || !matte_.fingers().empty();
}

std::array<float, 2> FingerLayer::matte_from_picture(int width, int height) const {
  const double texels = double{side} * matte_.scale();
  return {static_cast<float>(width / texels), static_cast<float>(height / texels)};
}

void FingerLayer::record(FrameSlot& slot) {
  if (!pending_) return;
  pending_ = false;
  Buffer& staging = staging_[next_];
  next_ = (next_ + 1) % slots;
  std::memcpy(staging.mapped(), matte_.alpha().data(), matte_.alpha().size());
  fill_image(slot.commands, staging, image_);
}

void FingerLayer::draw(const vk::raii::CommandBuffer& commands, const Layouts& layouts, const Pipelines& pipelines,
                       const DepthSurface& surface, std::size_t picture) const {
  if (matte_.fingers().empty()) return;
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines.finger);
  for (std::size_t i = 0; i < matte_.fingers().size(); ++i) {
    const auto& [left, top, right, bottom] = bounds_[i];
    const Cells columns = cells_between(left, right, surface.across());
    const Cells rows = cells_between(top, bottom, surface.down());
    if (columns.first >= columns.end || rows.first >= rows.end) continue;
    gpu::DrawData data{};
    data.finger.y = static_cast<float>(picture);
    data.finger.x = static_cast<float>(matte_.fingers()[i].depth * metres_per_millimetre);
    commands.pushConstants<gpu::DrawData>(
        *layouts.pipeline, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, data);
    commands.draw(2 * (columns.end - columns.first + 1), rows.end - rows.first, 2 * columns.first, rows.first);
  }
}

}  // namespace onestroke

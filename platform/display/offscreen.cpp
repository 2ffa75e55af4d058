#include "display/offscreen.h"

#include "core/error.h"
#include "display/default_view.h"
#include "display/frame_files.h"
#include "render/image_target.h"

namespace onestroke {

namespace {

constexpr auto format = vk::Format::eR8G8B8A8Srgb;

/// One picture on its way from the GPU to the files. The image has a layer for each view, the bytes have the views side
/// by side.
struct Slot {
  ImageTarget target;
  Buffer bytes;
  vk::raii::CommandPool pool{nullptr};
  vk::raii::CommandBuffer commands{nullptr};
  vk::raii::Fence fence{nullptr};
  bool pending = false;  // handed to the GPU, not yet to the files
};

Slot make_slot(Device& device, int width, int height, int views) {
  Slot slot;
  slot.target = ImageTarget(device, format, width, height, views, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  const ImageInfo& image = slot.target.image().info();
  slot.bytes = Buffer(device, std::uint64_t{4} * image.width * image.height * image.layers,
                      vk::BufferUsageFlagBits::eTransferDst, MemoryPool::Use::readback);
  slot.pool = device.vk().createCommandPool({.queueFamilyIndex = device.queue_family()});
  slot.commands =
      std::move(device.vk().allocateCommandBuffers({.commandPool = *slot.pool, .commandBufferCount = 1}).front());
  slot.fence = device.vk().createFence({});
  return slot;
}

/// The copy is the same every time, so it is recorded once.
void record_copy(const Slot& slot) {
  slot.commands.begin({});
  const ImageInfo& image = slot.target.image().info();
  std::array<vk::BufferImageCopy, max_views> copies;
  for (std::uint32_t i = 0; i < image.layers; ++i)
    copies[i] = {
        .bufferOffset = std::uint64_t{4} * image.width * i,
        .bufferRowLength = image.width * image.layers,
        .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .baseArrayLayer = i, .layerCount = 1},
        .imageExtent = {image.width, image.height, 1}};
  slot.commands.copyImageToBuffer(slot.target.image().handle(), vk::ImageLayout::eTransferSrcOptimal,
                                  slot.bytes.handle(),
                                  vk::ArrayProxy<const vk::BufferImageCopy>(image.layers, copies.data()));
  const vk::MemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eAllTransfer,
                                   .srcAccessMask = vk::AccessFlagBits2::eTransferWrite,
                                   .dstStageMask = vk::PipelineStageFlagBits2::eHost,
                                   .dstAccessMask = vk::AccessFlagBits2::eHostRead};
  slot.commands.pipelineBarrier2({.memoryBarrierCount = 1, .pMemoryBarriers = &barrier});
  slot.commands.end();
}

void check(const OffscreenOptions& o) {
  if (o.width < 16 || o.height < 16 || o.width > 16384 || o.height > 16384)
    throw UsageError("an off-screen picture is 16 to 16384 pixels wide and high");
  if (!(o.rate > 0 && o.rate <= 1000)) throw UsageError("an off-screen display's rate is 0 to 1000 frames per second");
  if (o.views < 1 || o.views > 2) throw UsageError("an off-screen display has one view or two");
  if (o.width % o.views != 0) throw UsageError("an off-screen pair of views needs an even width");
  if (o.png_every < 0) throw UsageError("every how many frames a picture is written cannot be negative");
}

}  // namespace

struct OffscreenDisplay::Impl {
  OffscreenOptions options;
  FrameFiles files;
  std::shared_ptr<Device> device{};
  // While one is read and written to disk, the other is drawn into.
  std::array<Slot, 2> slots;
  std::int64_t frame = 0;
  std::string failure;
  bool closed = false, finished = false, lost = false;

  Slot& slot(std::int64_t n) { return slots[static_cast<std::size_t>(n % 2)]; }

  std::span<const std::uint8_t> bytes(const Slot& slot) const {
    return {reinterpret_cast<const std::uint8_t*>(slot.bytes.mapped()), slot.bytes.size()};
  }

  /// Hands a picture to the files, once.
  void deliver(Slot& slot) {
    if (!slot.pending) return;
    slot.pending = false;
    try {
      device->wait(*slot.fence);
    } catch (const vk::DeviceLostError&) {
      files.leave_out();
      throw;
    }
    files.add(bytes(slot));
  }

  /// Runs what may throw in the loop; the first error closes the display, unless another GPU may mend it.
  template <typename Work>
  void guard(Work&& work) noexcept {
    if (closed || lost) return;
    try {
      work();
    } catch (const vk::DeviceLostError&) {
      lost = true;
    } catch (const std::exception& error) {
      failure = error.what();
      closed = true;
    }
  }

  /// Hands the files all that is still to be had, oldest first. False where the GPU took some of it with it.
  bool deliver_all() {
    bool all = true;
    for (std::int64_t n = 0; n < 2; ++n) {
      lost = false;
      guard([&] { deliver(slot(frame + n)); });
      all = all && !lost;
    }
    lost = false;
    return all;
  }

  void let_go() {
    if (!device) return;
    device->wait_idle();
    for (Slot& slot : slots) {
      slot.commands = nullptr;  // before its pool
      slot = {};
    }
    device.reset();
    lost = false;
  }
};

OffscreenDisplay::OffscreenDisplay(const OffscreenOptions& options) {
  check(options);
  // An aggregate that cannot be moved has no make_unique.
  // NOLINTNEXTLINE(modernize-make-unique)
  impl_.reset(new Impl{.options = options, .files = FrameFiles(options), .slots = {}, .failure = {}});
}

OffscreenDisplay::~OffscreenDisplay() {
  // A picture may still be on its way.
  impl_->let_go();
}

void OffscreenDisplay::attach(Gpu& gpu) {
  if (impl_->device) impl_->deliver_all();
  impl_->let_go();
  impl_->device = gpu.device();
  const OffscreenOptions& o = impl_->options;
  for (auto& slot : impl_->slots) {
    slot = make_slot(*impl_->device, o.width / o.views, o.height, o.views);
    record_copy(slot);
  }
}

void OffscreenDisplay::begin(FrameInfo& frame) {
  const OffscreenOptions& o = impl_->options;
  Slot& slot = impl_->slot(impl_->frame);
  impl_->guard([&] { impl_->deliver(slot); });
  frame.should_render = !impl_->closed && !impl_->lost;
  frame.time = Time{} + Duration::from_seconds(static_cast<double>(impl_->frame) / o.rate);
  frame.target = &slot.target.target();
  frame.view_count = o.views;
  const int width = o.width / o.views;
  for (int i = 0; i < o.views; ++i) {
    View& view = frame.views[static_cast<std::size_t>(i)];
    view = default_view({0, 0, width, o.height});
    if (o.views == 2) view.T_world_view.translation.x = (i - 0.5) * o.eye_distance_mm;
  }
}

void OffscreenDisplay::end(const FrameInfo& frame) {
  if (!frame.should_render) return;
  impl_->guard([&] {
    Slot& slot = impl_->slot(impl_->frame);
    impl_->device->vk().resetFences(*slot.fence);
    const vk::CommandBufferSubmitInfo commands{.commandBuffer = *slot.commands};
    impl_->device->submit({.commandBufferInfoCount = 1, .pCommandBufferInfos = &commands}, *slot.fence);
    slot.pending = true;
    ++impl_->frame;
  });
}

bool OffscreenDisplay::closed() const {
  return impl_->closed;
}

bool OffscreenDisplay::gpu_lost() const {
  return impl_->lost;
}

void OffscreenDisplay::finish() {
  if (impl_->finished) return;
  impl_->finished = true;
  const bool all = impl_->deliver_all();
  impl_->guard([this] { impl_->files.finish(); });
  if (!all && impl_->failure.empty()) impl_->failure = "the GPU was lost with the last frames: they are missing";
  impl_->closed = true;
  if (!impl_->failure.empty()) throw Error(impl_->failure);
}

std::vector<std::string> OffscreenDisplay::report() const {
  return impl_->files.report();
}

std::span<const std::uint8_t> OffscreenDisplay::read_back() {
  if (impl_->frame == 0) throw Error("no frame has been drawn off-screen yet");
  const Slot& slot = impl_->slot(impl_->frame - 1);
  impl_->device->wait(*slot.fence);
  return impl_->bytes(slot);
}

}  // namespace onestroke

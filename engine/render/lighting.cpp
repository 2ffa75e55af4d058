#include "render/lighting.h"

#include <glm/gtc/packing.hpp>

namespace onestroke {

namespace {

constexpr std::size_t texel_bytes = 8;

}  // namespace

Lighting::Lighting(Device& device, std::shared_ptr<RoomLight> room)
    : seen_(std::move(room)),
      chosen_(&given_),
      cube_(device, {.format = vk::Format::eR16G16B16A16Sfloat,
                     .width = RoomLight::side,
                     .height = RoomLight::side,
                     .mip_levels = RoomLight::levels,
                     .layers = 6,
                     .cube = true,
                     .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst}) {
  for (Buffer& buffer : staging_)
    buffer = Buffer(device, cube_texels_before(RoomLight::side, RoomLight::levels) * texel_bytes,
                    vk::BufferUsageFlagBits::eTransferSrc, MemoryPool::Use::upload);
}

void Lighting::see(const Picture& picture) {
  seen_->see(picture);
  any_seen_ = true;
}

void Lighting::forget() {
  seen_->clear();
  any_seen_ = false;
}

void Lighting::record(FrameSlot& slot, const FrameScene& scene) {
  chosen_ = any_seen_ && !scene.light ? seen_.get() : &given_;
  const Light given = scene.light.value_or(Light{});
  if (chosen_ == &given_ && given_light_ != given) {
    given_.set(given);
    given_light_ = given;
  }
  if (uploaded_ == chosen_ && uploaded_version_ == chosen_->version()) return;
  uploaded_ = chosen_;
  uploaded_version_ = chosen_->version();
  upload(slot);
}

void Lighting::upload(FrameSlot& slot) {
  Buffer& staging = staging_[next_];
  next_ = (next_ + 1) % slots;
  std::array<vk::BufferImageCopy, RoomLight::levels> regions;
  std::uint64_t at = 0;
  for (int level = 0; level < RoomLight::levels; ++level) {
    const auto side = static_cast<std::uint32_t>(RoomLight::side >> level);
    regions[static_cast<std::size_t>(level)] = {.bufferOffset = at,
                                                .imageSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor,
                                                                     .mipLevel = static_cast<std::uint32_t>(level),
                                                                     .layerCount = 6},
                                                .imageExtent = {side, side, 1}};
    for (const glm::vec3& light : chosen_->mirrored(level)) {
      const std::uint64_t packed = glm::packHalf4x16(glm::vec4(light, 1.0F));
      std::memcpy(staging.mapped() + at, &packed, sizeof packed);
      at += texel_bytes;
    }
  }
  fill_image(slot.commands, staging, cube_, regions);
}

}  // namespace onestroke

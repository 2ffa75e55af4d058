#pragma once

#include "render/frame_ring.h"
#include "render/frame_scene.h"
#include "render/room_light.h"

#include <memory>
#include <optional>

namespace onestroke {

/// The light of a frame: the room's as the camera's pictures show it, or one that the scene gives. Keeps it on the GPU.
class Lighting {
 public:
  /// What is known of the room outlives a GPU.
  Lighting(Device& device, std::shared_ptr<RoomLight> room);

  const std::shared_ptr<RoomLight>& room() const { return seen_; }

  void see(const Picture& picture);
  /// There is no picture any more.
  void forget();

  /// Chooses the frame's light, and takes it to the GPU where it has changed.
  void record(FrameSlot& slot, const FrameScene& scene);
  /// As chosen last.
  const RoomLight& light() const { return *chosen_; }
  /// A cube map of directions in graphics axes, a level for every step of roughness; ready for sampling.
  vk::ImageView view() const { return cube_.view(); }

 private:
  static constexpr std::size_t slots = frames_in_flight + 1;

  void upload(FrameSlot& slot);

  std::shared_ptr<RoomLight> seen_;
  RoomLight given_;
  std::optional<Light> given_light_;
  bool any_seen_ = false;
  const RoomLight* chosen_;
  const RoomLight* uploaded_ = nullptr;
  std::uint64_t uploaded_version_ = 0;
  Image cube_;
  std::array<Buffer, slots> staging_;
  std::size_t next_ = 0;
};

}  // namespace onestroke

#pragma once

#include "core/picture.h"
#include "render/frame_ring.h"
#include "render/lens_map.h"

#include <optional>

namespace onestroke {

/// The camera's picture on its way to the GPU and there.
class PictureStore {
 public:
  explicit PictureStore(Device& device);

  /// Copies the picture's bytes to memory that no frame in flight reads. Throws Error where it is not sound.
  void set(const Picture& picture);
  void set_pose(const Pose& T_world_camera) { T_world_camera_ = T_world_camera; }
  void clear() { shown_ = false; }

  /// Unpacks the newest picture, if one has come since the last frame.
  void record(FrameSlot& slot);

  bool shown() const { return shown_; }
  /// Ready for sampling; a single black texel before the first picture.
  vk::ImageView view() const { return image_ ? image_.second_view() : blank_.view(); }
  /// The lens map, ready for sampling; a single texel without a meaning where the lens is ideal.
  vk::ImageView lens_view() const { return lens_ ? lens_.view() : blank_.view(); }
  /// See LensMap::placement(); all zero where the lens is ideal.
  const std::array<float, 4>& lens_placement() const { return lens_placement_; }
  bool ideal_lens() const { return !intrinsics_.distorted(); }
  /// What of the plane z = 1 the picture shows, with room for the glow round its edge.
  const PlaneBounds& bounds() const { return bounds_; }
  /// Where there is nothing but picture.
  const PlaneBounds& inside() const { return inside_; }
  const Intrinsics& intrinsics() const { return intrinsics_; }
  const Pose& T_world_camera() const { return T_world_camera_; }
  int width() const { return width_; }
  int height() const { return height_; }
  std::uint64_t sequence() const { return sequence_; }

 private:
  // One more than the frames in flight: the CPU fills one while the GPU may read the others.
  static constexpr std::size_t slots = frames_in_flight + 1;

  void fit(Graveyard& graveyard);
  void record_words(const vk::raii::CommandBuffer& commands);
  void record_unpacking(const vk::raii::CommandBuffer& commands) const;
  void follow_lens(const Picture& picture);
  void record_lens(FrameSlot& slot);

  Device& device_;
  vk::raii::DescriptorSetLayout set_layout_;
  vk::raii::PipelineLayout layout_;
  std::array<vk::raii::Pipeline, 4> pipelines_;  // By UNPACK_*.
  vk::raii::DescriptorPool descriptors_;
  std::array<vk::DescriptorSet, slots> sets_;
  std::array<Buffer, slots> staging_;
  std::size_t next_ = 0;
  bool pending_ = false, shown_ = false;
  std::uint32_t format_ = 0;
  vk::Extent2D words_size_{};
  Image words_, image_, blank_, lens_;
  vk::Format lens_format_;
  LensMap lens_map_;
  std::array<float, 4> lens_placement_{};
  bool lens_pending_ = false;
  PlaneBounds bounds_, inside_;
  int width_ = 0, height_ = 0;
  std::uint64_t sequence_ = 0;
  Intrinsics intrinsics_;
  Pose T_world_camera_;
};

}  // namespace onestroke

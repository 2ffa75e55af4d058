#pragma once

#include "render/frame_ring.h"
#include "render/imgui_pass.h"
#include "render/model_pass.h"
#include "render/overlay.h"
#include "render/picture_store.h"
#include "render/view.h"

#include <optional>

namespace onestroke {

/// Turns a scene into the commands of one frame. Keeps what lasts longer than a frame: pipelines and attachments.
class FrameRecorder {
 public:
  FrameRecorder(Device& device, const Layouts& layouts, const ModelStore& models);

  void record(FrameSlot& slot, const FrameScene& scene, std::span<const View> views, const RenderTarget& target,
              PictureStore& picture);

 private:
  void fit(const RenderTarget& target, Graveyard& graveyard);
  void fill_arena(FrameSlot& slot, const FrameScene& scene, std::span<const View> views, const PictureStore& picture);
  void write_set(const FrameSlot& slot, const PictureStore& picture);
  void record_views(const FrameSlot& slot, std::span<const View> views, bool passthrough);
  void record_overlay(const FrameSlot& slot);

  Device& device_;
  const Layouts& layouts_;
  ModelPass models_;
  Overlay overlay_;
  vk::raii::Sampler sampler_;
  Image glyphs_, color_, depth_;
  ImguiPass gui_;
  std::optional<Pipelines> pipelines_;
  // Offsets in the frame's arena.
  std::uint64_t views_at_ = 0, view_step_ = 0, quads_at_ = 0, lines_at_ = 0;
};

}  // namespace onestroke

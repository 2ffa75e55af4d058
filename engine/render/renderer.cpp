#include "render/renderer.h"

#include "core/error.h"
#include "render/frame_recorder.h"
#include "render/target.h"

#include <optional>

namespace onestroke {

struct Renderer::Impl {
  Impl(std::shared_ptr<Device> gpu, const RendererOptions& options)
      : device(std::move(gpu)),
        layouts(*device),
        maker(*device, layouts),
        picture(*device),
        lighting(*device, options.room ? options.room : std::make_shared<RoomLight>()),
        recorder(*device, layouts, models, options.multiview),
        ring(*device, *layouts.frame) {}

  /// Submits what `record` has made of a frame.
  template <typename Record>
  bool draw(Record&& record, const RenderTarget& target) noexcept;

  FrameSlot& record(const FrameScene& scene, const FrameInfo& frame, bool views_move) {
    FrameSlot& slot = ring.begin();
    models.record_uploads(slot);
    recorder.record(slot, scene, frame.seen(), *frame.target, {pictures(), lighting}, views_move);
    return slot;
  }

  SeenPictures pictures() { return {picture, second && second->store.shown() ? &*second : nullptr}; }

  std::shared_ptr<Device> device;
  Layouts layouts;
  ModelMaker maker;
  ModelStore models;
  SeenPicture picture;
  std::optional<SeenPicture> second;  // made for the first pair
  Lighting lighting;
  FrameRecorder recorder;
  FrameRing ring;  // last: its end waits for the GPU before the rest goes
  std::string failure;
  bool lost = false;
};

Renderer::Renderer(Gpu& gpu, const RendererOptions& options) : impl_(std::make_unique<Impl>(gpu.device(), options)) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

std::shared_ptr<PreparedModel> Renderer::prepare(const Model& model) const {
  try {
    return impl_->maker.make(model);
  } catch (const vk::SystemError& error) {
    throw Error("model " + model.name + " does not fit the GPU: use a smaller one (" + error.what() + ")");
  }
}

ModelHandle Renderer::adopt(std::shared_ptr<PreparedModel> prepared) {
  return impl_->models.adopt(std::move(prepared));
}

void Renderer::unload(ModelHandle model) {
  impl_->models.unload(model, impl_->ring.current().graveyard);
}

void Renderer::set_picture(const Picture& picture, std::span<const CoveredCell> covered) {
  impl_->picture.store.set(picture);
  impl_->lighting.see(picture);
  impl_->picture.fingers.find(picture, covered);
  if (impl_->second) impl_->second->store.clear();
}

void Renderer::set_second_picture(const Picture& picture, std::span<const CoveredCell> covered) {
  if (!impl_->second) impl_->second.emplace(*impl_->device);
  impl_->second->store.set(picture);
  impl_->second->fingers.find(picture, covered);
}

void Renderer::set_picture_pose(const Pose& T_world_camera) {
  PictureStore& first = impl_->picture.store;
  const Pose T_first_world = inverse(first.T_world_camera());
  first.set_pose(T_world_camera);
  if (!impl_->second) return;
  PictureStore& second = impl_->second->store;
  second.set_pose(T_world_camera * (T_first_world * second.T_world_camera()));
}

void Renderer::clear_picture() {
  impl_->picture.store.clear();
  impl_->lighting.forget();
  impl_->picture.fingers.clear();
  if (impl_->second) impl_->second->store.clear();
}

template <typename Record>
bool Renderer::Impl::draw(Record&& record, const RenderTarget& target) noexcept {
  try {
    record();
    ring.submit(target);
    return true;
  } catch (const vk::DeviceLostError&) {
    failure = "the GPU was lost: restart the program";
    lost = true;
  } catch (const std::exception& error) {
    failure = std::string("the GPU cannot draw: ") + error.what();
  }
  return false;
}

bool Renderer::draw(const FrameScene& scene, const FrameInfo& frame) noexcept {
  return impl_->draw([&] { impl_->record(scene, frame, false); }, *frame.target);
}

bool Renderer::draw(const FrameScene& scene, FrameInfo& frame, Display& display) noexcept {
  const auto record = [&] {
    FrameSlot& slot = impl_->record(scene, frame, true);
    if (display.move_views(frame)) impl_->recorder.move_views(slot, frame.seen(), impl_->pictures());
  };
  return impl_->draw(record, *frame.target);
}

const std::shared_ptr<RoomLight>& Renderer::room() const {
  return impl_->lighting.room();
}

const std::string& Renderer::failure() const {
  return impl_->failure;
}

bool Renderer::lost() const {
  return impl_->lost;
}

}  // namespace onestroke

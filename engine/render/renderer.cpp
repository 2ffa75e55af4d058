#include "render/renderer.h"

#include "core/error.h"
#include "render/frame_recorder.h"
#include "render/target.h"

namespace onestroke {

struct Renderer::Impl {
  explicit Impl(std::shared_ptr<Device> gpu)
      : device(std::move(gpu)),
        layouts(*device),
        maker(*device, layouts),
        picture(*device),
        recorder(*device, layouts, models),
        ring(*device, *layouts.frame) {}

  std::shared_ptr<Device> device;
  Layouts layouts;
  ModelMaker maker;
  ModelStore models;
  PictureStore picture;
  FrameRecorder recorder;
  FrameRing ring;  // last: its end waits for the GPU before the rest goes
  std::string failure;
};

Renderer::Renderer(Gpu& gpu) : impl_(std::make_unique<Impl>(gpu.device())) {}
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

void Renderer::set_picture(const Picture& picture) {
  impl_->picture.set(picture);
}

void Renderer::set_picture_pose(const Pose& T_world_camera) {
  impl_->picture.set_pose(T_world_camera);
}

void Renderer::clear_picture() {
  impl_->picture.clear();
}

bool Renderer::draw(const FrameScene& scene, const FrameInfo& frame) noexcept {
  try {
    FrameSlot& slot = impl_->ring.begin();
    impl_->models.record_uploads(slot);
    impl_->recorder.record(slot, scene, frame.seen(), *frame.target, impl_->picture);
    impl_->ring.submit(*frame.target);
    return true;
  } catch (const vk::DeviceLostError&) {
    impl_->failure = "the GPU was lost: restart the program";
  } catch (const std::exception& error) {
    impl_->failure = std::string("the GPU cannot draw: ") + error.what();
  }
  return false;
}

const std::string& Renderer::failure() const {
  return impl_->failure;
}

}  // namespace onestroke

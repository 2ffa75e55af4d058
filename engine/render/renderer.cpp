#include "render/renderer.h"

#include "core/error.h"
#include "render/frame_recorder.h"
#include "render/target.h"

namespace onestroke {

struct Renderer::Impl {
  Impl(std::shared_ptr<Device> gpu, const RendererOptions& options)
      : device(std::move(gpu)),
        layouts(*device),
        maker(*device, layouts),
        picture(*device),
        lighting(*device, options.room ? options.room : std::make_shared<RoomLight>()),
        fingers(*device),
        recorder(*device, layouts, models, options.multiview),
        ring(*device, *layouts.frame) {}

  std::shared_ptr<Device> device;
  Layouts layouts;
  ModelMaker maker;
  ModelStore models;
  PictureStore picture;
  Lighting lighting;
  FingerLayer fingers;
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
  impl_->picture.set(picture);
  impl_->lighting.see(picture);
  impl_->fingers.find(picture, covered);
}

void Renderer::set_picture_pose(const Pose& T_world_camera) {
  impl_->picture.set_pose(T_world_camera);
}

void Renderer::clear_picture() {
  impl_->picture.clear();
  impl_->lighting.forget();
  impl_->fingers.clear();
}

bool Renderer::draw(const FrameScene& scene, const FrameInfo& frame) noexcept {
  try {
    FrameSlot& slot = impl_->ring.begin();
    impl_->models.record_uploads(slot);
    impl_->recorder.record(slot, scene, frame.seen(), *frame.target, {impl_->picture, impl_->lighting, impl_->fingers});
    impl_->ring.submit(*frame.target);
    return true;
  } catch (const vk::DeviceLostError&) {
    impl_->failure = "the GPU was lost: restart the program";
    impl_->lost = true;
  } catch (const std::exception& error) {
    impl_->failure = std::string("the GPU cannot draw: ") + error.what();
  }
  return false;
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

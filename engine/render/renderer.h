#pragma once

#include "core/picture.h"
#include "render/display.h"
#include "render/finger_matte.h"
#include "render/frame_scene.h"

#include <memory>
#include <string>

namespace onestroke {

struct Model;
struct PreparedModel;
class RoomLight;

struct RendererOptions {
  /// Two eyes in one pass. Off, each has a pass of its own; the pictures are the same.
  bool multiview = true;
  /// What another renderer learnt of the room's light, see Renderer::room(); null to begin anew.
  std::shared_ptr<RoomLight> room{};
};

/// Draws frames. One thread, the GPU's, but for prepare().
class Renderer {
 public:
  explicit Renderer(Gpu& gpu, const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Makes a model's memory on the GPU and fills it, on any thread, while another one draws: for models that take long.
  /// Throws Error where there is no room or the model is not sound. What is returned must go before the renderer does.
  std::shared_ptr<PreparedModel> prepare(const Model& model) const;
  /// Takes in what was prepared, once; it can be drawn from the next frame on, with which it goes to the GPU. Never
  /// waits.
  ModelHandle adopt(std::shared_ptr<PreparedModel> prepared);
  /// Both at once; blocks while memory is filled.
  ModelHandle load(const Model& model) { return adopt(prepare(model)); }
  /// Frees the model once the frames in flight are done. The handle may be given to another model later.
  void unload(ModelHandle model);

  /// The camera picture for the frames from now on, at its own T_world_camera. The bytes are copied before this
  /// returns. Throws Error where the picture is not sound or a larger one finds no memory; never for pictures of the
  /// size seen before. `covered` are the rings of sticks that something covers in it, for FrameScene::fingers. All
  /// views see it, and the room's light is read from it.
  void set_picture(const Picture& picture, std::span<const CoveredCell> covered = {});
  /// The same for the second of a pair, after the first: where there are two views the second one sees this. The first
  /// pair makes what two pictures need.
  void set_second_picture(const Picture& picture, std::span<const CoveredCell> covered = {});
  /// The pose at which the picture was taken, where it is known better than when set_picture was called; the second of
  /// a pair goes along.
  void set_picture_pose(const Pose& T_world_camera);
  void clear_picture();

  /// Draws the scene into the frame's target and hands it to the GPU. Waits for the frame before last. False where the
  /// GPU is lost or out of memory, and then failure() says so; allocates nothing once warm.
  [[nodiscard]] bool draw(const FrameScene& scene, const FrameInfo& frame) noexcept;
  /// The same, and lets the display move the frame's views once all is ready to go to the GPU.
  [[nodiscard]] bool draw(const FrameScene& scene, FrameInfo& frame, Display& display) noexcept;
  const std::string& failure() const;
  /// What the pictures have told of the room's light; stays good where the GPU is lost.
  const std::shared_ptr<RoomLight>& room() const;
  /// True where draw() failed because the GPU was lost: a new Gpu may do, with a new Renderer and all that was loaded.
  bool lost() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke

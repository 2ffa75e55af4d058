#pragma once

#include "core/picture.h"
#include "render/display.h"
#include "render/finger_matte.h"
#include "render/frame_scene.h"

#include <memory>
#include <string>

namespace onestroke {

struct Model;

struct RendererOptions {
  /// Two eyes in one pass. Off, each has a pass of its own; the pictures are the same.
  bool multiview = true;
};

/// Draws frames. One thread, the GPU's.
class Renderer {
 public:
  explicit Renderer(Gpu& gpu, const RendererOptions& options = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Takes a model to the GPU; blocks for that. Throws Error where it has no room or the model is not sound.
  ModelHandle load(const Model& model);
  /// Frees the model once the frames in flight are done. The handle may be given to another model later.
  void unload(ModelHandle model);

  /// The camera picture for the frames from now on, at its own T_world_camera. The bytes are copied before this
  /// returns. Throws Error where the picture is not sound or a larger one finds no memory; never for pictures of the
  /// size seen before. `covered` are the rings of sticks that something covers in it, for FrameScene::fingers.
  void set_picture(const Picture& picture, std::span<const CoveredCell> covered = {});
  /// The pose at which the picture was taken, where it is known better than when set_picture was called.
  void set_picture_pose(const Pose& T_world_camera);
  void clear_picture();

  /// Draws the scene into the frame's target and hands it to the GPU. Waits for the frame before last. False where the
  /// GPU is lost or out of memory, and then failure() says so; allocates nothing once warm.
  [[nodiscard]] bool draw(const FrameScene& scene, const FrameInfo& frame) noexcept;
  const std::string& failure() const;
  /// True where draw() failed because the GPU was lost: a new Gpu may do, with a new Renderer and all that was loaded.
  bool lost() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace onestroke

#pragma once

#include "render/image_target.h"
#include "render/renderer.h"
#include "render_floor.h"

#include <map>

namespace onestroke::bench {

/// A camera picture of any format, made by formula, with the memory behind it.
class BenchPicture {
 public:
  BenchPicture(int width, int height, PixelFormat format);
  BenchPicture(const BenchPicture&) = delete;
  const Picture& picture() const { return picture_; }

 private:
  std::vector<std::uint8_t> bytes_;
  Picture picture_;
};

/// A renderer and an image to draw into, without a display around them: a frame's own work is all that is timed.
class RenderStage {
 public:
  /// Views of width x height, a layer each; the GPU outlives this.
  RenderStage(Gpu& gpu, int width, int height, int views, bool multiview = true);

  /// Draws and waits for the GPU. Throws Error where that fails.
  void draw(const FrameScene& scene);
  Renderer& renderer() { return renderer_; }
  RenderFloor& floor() { return floor_; }

  /// `count` models of so many triangles, near enough, that fill much of the views. They live as long as this.
  FrameScene scene_of(int count, int triangles);

 private:
  Gpu& gpu_;
  ImageTarget target_;
  RenderFloor floor_;
  Renderer renderer_;
  FrameInfo frame_;
  std::map<int, ModelHandle> models_;  // by triangles
  std::vector<ModelInstance> instances_;
};

}  // namespace onestroke::bench

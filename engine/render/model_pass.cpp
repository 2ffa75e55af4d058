#include "render/model_pass.h"

#include "render/cut_face.h"
#include "render/graphics_pipeline.h"
#include "render/level_choice.h"
#include "scene/frames.h"

#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace onestroke {

namespace {

glm::mat4 matrix_of(const ModelInstance& instance) {
  return glm::make_mat4(instance.world_graphics_from_model.data());
}

glm::vec3 centre_of(const GpuModel::Parts& parts) {
  glm::vec3 sum(0.0F);
  for (const auto& part : parts) sum += part.centre;
  return sum / static_cast<float>(std::max<std::size_t>(parts.size(), 1));
}

// By how much the matrix lengthens anything at most: exact where its axes stay at right angles, otherwise more.
float stretch_of(const glm::mat3& m) {
  const glm::mat3 square = glm::transpose(m) * m;
  float most = 0;
  for (glm::length_t i = 0; i < 3; ++i)
    most = std::max(most, std::abs(square[i].x) + std::abs(square[i].y) + std::abs(square[i].z));
  return std::sqrt(most);
}

const GpuModel::Parts& level_for(const GpuModel& model, const ModelInstance& instance, std::span<const View> views) {
  if (model.levels.size() == 1) return model.levels.front();
  const glm::mat4 m = matrix_of(instance);
  const double stretch = double{stretch_of(glm::mat3(m))} / metres_per_millimetre;
  const Ball ball{.centre_world = point_from_graphics(glm::vec3(m * glm::vec4(model.box.centre(), 1.0F))),
                  .radius = glm::distance(model.box.lower, model.box.upper) / 2.0 * stretch};
  double pixels = 0;
  for (const View& view : views) pixels = std::max(pixels, pixels_per_millimetre(view, ball));
  return model.levels[choose_level(model.errors, pixels * stretch)];
}

gpu::DrawData data_of(const ModelInstance& instance, const BallRange& shadow) {
  const glm::mat4 rows = glm::transpose(matrix_of(instance));
  const Color& t = instance.tint;
  gpu::DrawData data{};
  std::copy_n(&rows[0], 3, data.model_rows);
  data.tint = {t.r, t.g, t.b, t.a};
  data.shadow = {static_cast<float>(shadow.first), static_cast<float>(shadow.end), 0.0F, 0.0F};
  if (instance.clip_plane) {
    const ClipPlane& p = *instance.clip_plane;
    data.clip_plane = {p.a, p.b, p.c, p.d};
  }
  return data;
}

}  // namespace

/// Records draws, leaving out state that is already set.
struct ModelPass::Recorder {
  const vk::raii::CommandBuffer& commands;
  vk::PipelineLayout layout;
  vk::Rect2D area;
  glm::vec3 eye;
  vk::Pipeline bound_pipeline;
  const GpuModel* bound_model = nullptr;
  const ModelInstance* pushed = nullptr;
  bool has_layers = false;  // in the stencil

  void draw(const std::array<vk::raii::Pipeline, 2>& pipelines, const Draw& d, const GpuModel::Part& part) {
    prepare(pipelines[part.textured ? 1 : 0], d);
    const bool both_sides = part.double_sided || d.instance->clip_plane;
    commands.setCullMode(both_sides ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, 1, d.model->materials[part.material], {});
    commands.drawIndexed(part.index_count, 1, part.first_index, 0, 0);
  }

  /// Fills the face that the instance's plane cuts.
  void fill(const Pipelines& pipelines, const Draw& d) {
    if (std::exchange(has_layers, true)) clear_layers();
    prepare(pipelines.layers, d);
    commands.setCullMode(vk::CullModeFlagBits::eNone);
    for (const auto& part : *d.level)
      if (!part.blends) commands.drawIndexed(part.index_count, 1, part.first_index, 0, 0);
    bind(pipelines.cut);
    push(cut_face(*d.instance, d.model->box, eye));
    pushed = nullptr;
    commands.draw(4, 1, 0, 0);
  }

  void clear_layers() {
    const vk::ClearAttachment none{.aspectMask = vk::ImageAspectFlagBits::eStencil,
                                   .clearValue = {.depthStencil = {0.0F, no_layers}}};
    commands.clearAttachments(none, vk::ClearRect{.rect = area, .layerCount = 1});
  }

  void bind(const vk::raii::Pipeline& pipeline) {
    if (bound_pipeline != *pipeline) commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
    bound_pipeline = *pipeline;
  }

  void prepare(const vk::raii::Pipeline& pipeline, const Draw& d) {
    bind(pipeline);
    if (bound_model != d.model) {
      commands.bindVertexBuffers(0, d.model->vertices.handle(), vk::DeviceSize{0});
      commands.bindIndexBuffer(d.model->indices.handle(), 0, vk::IndexType::eUint32);
      bound_model = d.model;
    }
    if (pushed != d.instance) push_instance(*d.instance, d.shadow);
  }

  template <typename Data>
  void push(const Data& data) {
    commands.pushConstants<Data>(layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0,
                                 data);
  }

  void push_instance(const ModelInstance& instance, const BallRange& shadow) {
    push(data_of(instance, shadow));
    // A mirroring matrix turns every triangle over.
    const bool mirrors = glm::determinant(glm::mat3(matrix_of(instance))) < 0;
    commands.setFrontFace(mirrors ? vk::FrontFace::eClockwise : vk::FrontFace::eCounterClockwise);
    pushed = &instance;
  }
};

void ModelPass::prepare(std::span<const ModelInstance> instances, std::span<const View> views) {
  occluders_.clear();
  cuts_.clear();
  opaque_.clear();
  blended_.clear();
  shadows_.clear();
  for (const auto& instance : instances)
    if (const GpuModel* model = store_.find(instance.model); model && !instance.occluder && instance.tint.a > 0)
      shadows_.add(instance, model->balls);
  for (const auto& instance : instances) {
    const GpuModel* model = store_.find(instance.model);
    if (!model || instance.tint.a <= 0) continue;
    const BallRange shadow = shadows_.nearest_other(instance);
    const GpuModel::Parts& level = level_for(*model, instance, views);
    const bool faded = !instance.occluder && instance.tint.a < 1, filled = shows_cut(instance, model->box, views);
    if (faded || filled)
      (faded ? blended_ : cuts_)
          .push_back({.model = model, .level = &level, .instance = &instance, .shadow = shadow, .filled = filled});
    if (faded) continue;
    for (const auto& part : level) {
      auto& list = instance.occluder ? occluders_ : part.blends ? blended_ : opaque_;
      list.push_back({.model = model, .level = &level, .part = &part, .instance = &instance, .shadow = shadow});
    }
  }
}

void ModelPass::add_to(ScreenBounds& bounds) const {
  const ModelInstance* last = nullptr;
  for (const auto* list : {&opaque_, &blended_})
    for (const auto& d : *list)
      if (std::exchange(last, d.instance) != d.instance) bounds.add(d.model->box, matrix_of(*d.instance));
}

void ModelPass::record(const vk::raii::CommandBuffer& commands, const Layouts& layouts, const Pipelines& pipelines,
                       vk::Rect2D area, const glm::vec3& eye) {
  Recorder recorder{.commands = commands, .layout = *layouts.pipeline, .area = area, .eye = eye, .bound_pipeline = {}};
  for (const auto& d : occluders_) recorder.draw(pipelines.model_depth, d, *d.part);
  for (const auto& d : cuts_) recorder.fill(pipelines, d);
  for (const auto& d : opaque_) recorder.draw(pipelines.model, d, *d.part);
  record_blended(recorder, pipelines);
}

void ModelPass::record_blended(Recorder& recorder, const Pipelines& pipelines) {
  for (auto& d : blended_) {
    const glm::vec3 centre = d.part ? d.part->centre : centre_of(*d.level);
    d.distance = glm::length(glm::vec3(matrix_of(*d.instance) * glm::vec4(centre, 1.0F)) - recorder.eye);
  }
  std::sort(blended_.begin(), blended_.end(), [](const Draw& a, const Draw& b) { return a.distance > b.distance; });
  for (const auto& d : blended_) {
    if (d.part) {
      recorder.draw(pipelines.model_blend, d, *d.part);
      continue;
    }
    // A faded model first fills the depth buffer, so that only its nearest surface is seen and not its inside.
    for (const auto& part : *d.level)
      if (!part.blends) recorder.draw(pipelines.model_depth, d, part);
    if (d.filled) recorder.fill(pipelines, d);
    for (const auto& part : *d.level) recorder.draw(pipelines.model_blend, d, part);
  }
}

}  // namespace onestroke

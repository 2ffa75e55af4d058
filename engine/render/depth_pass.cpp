#include "render/depth_pass.h"

#include "render/graphics_pipeline.h"
#include "shaders/spirv.h"

namespace onestroke {

namespace {

using Layout = vk::ImageLayout;

PipelineRecipe depth_alone(vk::PipelineLayout layout, vk::Format format, std::uint32_t view_mask) {
  return {.vertex = {},
          .fragment = {},
          .layout = layout,
          .depth = format,
          .view_mask = view_mask,
          .tests_depth = true,
          .writes_depth = true,
          .writes_color = false};
}

void begin(const vk::raii::CommandBuffer& commands, const RenderTarget& target, const FramePass& pass,
           vk::Rect2D viewport) {
  const bool all_layers = pass.view_mask || target.layers == 1;
  const vk::RenderingAttachmentInfo depth{
      .imageView = all_layers ? target.depth.view : target.depth.layer_views.at(pass.first_view),
      .imageLayout = Layout::eDepthStencilAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eClear,
      .storeOp = vk::AttachmentStoreOp::eStore,
      .clearValue = {.depthStencil = {0.0F, 0}}};
  commands.beginRendering({.renderArea = viewport,
                           .layerCount = all_layers ? static_cast<std::uint32_t>(target.layers) : 1,
                           .viewMask = pass.view_mask,
                           .pDepthAttachment = &depth});
}

}  // namespace

const DepthPass::DepthPipelines& DepthPass::pipelines_for(vk::Format format, std::uint32_t view_mask) {
  auto& pipelines = pipelines_.at(view_mask ? 1 : 0);
  if (pipelines && pipelines->format == format) return *pipelines;
  if (pipelines) device_.vk().waitIdle();
  PipelineRecipe surface = depth_alone(*layouts_.pipeline, format, view_mask), foreground = surface;
  surface.vertex = spirv::passthrough_vert();
  surface.topology = vk::PrimitiveTopology::eTriangleStrip;
  foreground.vertex = spirv::full_screen_vert();
  foreground.fragment = spirv::depth_frag();
  return pipelines.emplace(DepthPipelines{.format = format,
                                          .surface = make_graphics_pipeline(device_, surface),
                                          .foreground = make_graphics_pipeline(device_, foreground)});
}

void DepthPass::record(const vk::raii::CommandBuffer& commands, const RenderTarget& target, const FramePass& pass,
                       vk::Rect2D viewport, const DepthSurface* surface) {
  const DepthPipelines& pipelines = pipelines_for(static_cast<vk::Format>(target.depth.format), pass.view_mask);
  begin(commands, target, pass, viewport);
  set_viewport(commands, viewport);
  if (surface) {
    const auto columns = static_cast<std::uint32_t>(surface->across().cells);
    const auto rows = static_cast<std::uint32_t>(surface->down().cells);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines.surface);
    commands.draw(2 * (columns + 1), rows, 0, 0);
  }
  if (pass.foreground.extent.width > 0) {
    commands.setScissor(0, pass.foreground);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipelines.foreground);
    commands.draw(3, 1, 0, 0);
  }
  commands.endRendering();
}

}  // namespace onestroke

#include "render/frame_targets.h"

#include "render/graphics_pipeline.h"

namespace onestroke {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;
using Usage = vk::ImageUsageFlagBits;

constexpr Access draw_color{Stage::eColorAttachmentOutput, Reach::eColorAttachmentRead | Reach::eColorAttachmentWrite};
constexpr Access draw_depth{Stage::eEarlyFragmentTests | Stage::eLateFragmentTests,
                            Reach::eDepthStencilAttachmentRead | Reach::eDepthStencilAttachmentWrite};

constexpr auto depth_and_stencil = vk::ImageAspectFlagBits::eDepth | vk::ImageAspectFlagBits::eStencil;

bool fits(const Image& image, const ImageInfo& wanted) {
  const ImageInfo& has = image.info();
  return image && has.format == wanted.format && has.width == wanted.width && has.height == wanted.height &&
         has.layers == wanted.layers;
}

}  // namespace

void FrameTargets::fit(const RenderTarget& target, std::uint32_t views_at_once, Graveyard& graveyard) {
  ImageInfo info{.format = static_cast<vk::Format>(target.format),
                 .width = static_cast<std::uint32_t>(target.width),
                 .height = static_cast<std::uint32_t>(target.height),
                 .layers = views_at_once,
                 .array = true,
                 .usage = Usage::eColorAttachment | Usage::eSampled};
  const bool tells_depth = target.depth.image != VK_NULL_HANDLE;
  if (fits(foreground_, info) && tells_depth == static_cast<bool>(depth_view_)) return;
  graveyard.bury(std::move(depth_view_));
  graveyard.bury(std::move(color_));
  graveyard.bury(std::move(depth_));
  graveyard.bury(std::move(foreground_));
  foreground_ = Image(device_, info);
  info.samples = sample_count;
  info.usage = Usage::eColorAttachment | Usage::eTransientAttachment;
  color_ = Image(device_, info);
  info.format = depth_format(device_);
  info.usage = Usage::eDepthStencilAttachment | (tells_depth ? Usage::eSampled : Usage::eTransientAttachment);
  depth_ = Image(device_, info);
  if (tells_depth) depth_view_ = std::make_shared<vk::raii::ImageView>(make_depth_view(device_, depth_));
}

void FrameTargets::begin_foreground(const vk::raii::CommandBuffer& commands, const FramePass& pass) const {
  const LayoutChange to_draw{Layout::eUndefined, Layout::eColorAttachmentOptimal};
  // The pass before may still be drawing these, or looking them up.
  image_barrier(commands, color_.handle(), to_draw, draw_color, draw_color);
  image_barrier(commands, foreground_.handle(), to_draw,
                {sampled_by_fragments.stage | draw_color.stage, draw_color.access}, draw_color);
  image_barrier(commands, depth_.handle(), {Layout::eUndefined, Layout::eDepthStencilAttachmentOptimal},
                {sampled_by_fragments.stage | draw_depth.stage, draw_depth.access}, draw_depth, depth_and_stencil);
  const vk::RenderingAttachmentInfo color{.imageView = color_.view(),
                                          .imageLayout = Layout::eColorAttachmentOptimal,
                                          .resolveMode = vk::ResolveModeFlagBits::eAverage,
                                          .resolveImageView = foreground_.view(),
                                          .resolveImageLayout = Layout::eColorAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                          .storeOp = vk::AttachmentStoreOp::eDontCare};
  const vk::RenderingAttachmentInfo depth{
      .imageView = depth_.view(),
      .imageLayout = Layout::eDepthStencilAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eClear,
      .storeOp = depth_view_ ? vk::AttachmentStoreOp::eStore : vk::AttachmentStoreOp::eDontCare,
      .clearValue = {.depthStencil = {0.0F, no_layers}}};
  commands.beginRendering({.renderArea = pass.foreground,
                           // Without a meaning where there is a view mask; some drivers keep the views within it.
                           .layerCount = color_.info().layers,
                           .viewMask = pass.view_mask,
                           .colorAttachmentCount = 1,
                           .pColorAttachments = &color,
                           .pDepthAttachment = &depth,
                           .pStencilAttachment = &depth});
}

void FrameTargets::end_foreground(const vk::raii::CommandBuffer& commands) const {
  commands.endRendering();
  image_barrier(commands, foreground_.handle(), {Layout::eColorAttachmentOptimal, Layout::eShaderReadOnlyOptimal},
                draw_color, sampled_by_fragments);
  if (depth_view_)
    image_barrier(commands, depth_.handle(),
                  {Layout::eDepthStencilAttachmentOptimal, Layout::eDepthStencilReadOnlyOptimal}, draw_depth,
                  sampled_by_fragments, depth_and_stencil);
}

void FrameTargets::open(const vk::raii::CommandBuffer& commands, const RenderTarget& target) {
  // Submission waits for the display's image at the stage of colour output.
  image_barrier(commands, target.image, {Layout::eUndefined, Layout::eColorAttachmentOptimal},
                {Stage::eColorAttachmentOutput, {}}, draw_color);
  if (target.depth.image)
    image_barrier(commands, target.depth.image, {Layout::eUndefined, Layout::eDepthStencilAttachmentOptimal},
                  {Stage::eAllCommands, {}}, draw_depth, vk::ImageAspectFlagBits::eDepth);
}

void FrameTargets::close(const vk::raii::CommandBuffer& commands, const RenderTarget& target) {
  const auto layout = static_cast<Layout>(target.final_layout);
  const Access after = layout == Layout::eTransferSrcOptimal ? Access{Stage::eAllTransfer, Reach::eTransferRead}
                                                             : Access{Stage::eAllCommands, {}};
  image_barrier(commands, target.image, {Layout::eColorAttachmentOptimal, layout}, draw_color, after);
}

void FrameTargets::begin_picture(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
                                 const FramePass& pass, vk::Rect2D viewport, const Color& background) {
  const bool all_layers = pass.view_mask || target.layers == 1;
  const vk::RenderingAttachmentInfo color{
      .imageView = all_layers ? target.view : target.layer_views.at(pass.first_view),
      .imageLayout = Layout::eColorAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eClear,
      .storeOp = vk::AttachmentStoreOp::eStore,
      .clearValue = {.color = {.float32 = std::array{background.r, background.g, background.b, background.a}}}};
  commands.beginRendering({.renderArea = viewport,
                           .layerCount = all_layers ? static_cast<std::uint32_t>(target.layers) : 1,
                           .viewMask = pass.view_mask,
                           .colorAttachmentCount = 1,
                           .pColorAttachments = &color});
}

}  // namespace onestroke

#include "render/frame_targets.h"

namespace onestroke {

namespace {

using Stage = vk::PipelineStageFlagBits2;
using Reach = vk::AccessFlagBits2;
using Layout = vk::ImageLayout;

constexpr Access draw_color{Stage::eColorAttachmentOutput, Reach::eColorAttachmentWrite};
constexpr Access draw_depth{Stage::eEarlyFragmentTests | Stage::eLateFragmentTests,
                            Reach::eDepthStencilAttachmentRead | Reach::eDepthStencilAttachmentWrite};

constexpr Access transfer_in{Stage::eAllTransfer, Reach::eTransferWrite};
constexpr Access transfer_out{Stage::eAllTransfer, Reach::eTransferRead};

bool fits(const Image& image, const ImageInfo& wanted) {
  const ImageInfo& has = image.info();
  return image && has.format == wanted.format && has.width == wanted.width && has.height == wanted.height &&
         has.layers == wanted.layers && has.usage == wanted.usage;
}

}  // namespace

void FrameTargets::fit(const RenderTarget& target, Way way, Graveyard& graveyard) {
  using Usage = vk::ImageUsageFlagBits;
  way_ = way;
  const bool by_layer = way == Way::by_layer;
  ImageInfo info{.format = static_cast<vk::Format>(target.format),
                 .width = static_cast<std::uint32_t>(target.width),
                 .height = static_cast<std::uint32_t>(target.height),
                 .layers = by_layer ? 1 : static_cast<std::uint32_t>(target.layers),
                 .samples = sample_count,
                 .usage = Usage::eColorAttachment | (by_layer ? Usage::eTransferSrc : Usage::eTransientAttachment)};
  if (fits(color_, info)) return;
  graveyard.bury(std::move(color_));
  graveyard.bury(std::move(depth_));
  color_ = Image(device_, info);
  info.format = depth_format;
  info.usage = Usage::eDepthStencilAttachment | Usage::eTransientAttachment;
  depth_ = Image(device_, info);
}

void FrameTargets::open(const vk::raii::CommandBuffer& commands, const RenderTarget& target) const {
  // Submission waits for the display's image at the stage of colour output.
  const Access before{Stage::eColorAttachmentOutput, {}};
  if (way_ == Way::by_layer)
    image_barrier(commands, target.image, {Layout::eUndefined, Layout::eTransferDstOptimal}, before, transfer_in);
  else
    image_barrier(commands, target.image, {Layout::eUndefined, Layout::eColorAttachmentOptimal}, before, draw_color);
}

void FrameTargets::close(const vk::raii::CommandBuffer& commands, const RenderTarget& target) const {
  const auto layout = static_cast<Layout>(target.final_layout);
  const Access after = layout == Layout::eTransferSrcOptimal ? transfer_out : Access{Stage::eAllCommands, {}};
  if (way_ == Way::by_layer)
    image_barrier(commands, target.image, {Layout::eTransferDstOptimal, layout}, transfer_in, after);
  else
    image_barrier(commands, target.image, {Layout::eColorAttachmentOptimal, layout}, draw_color, after);
}

void FrameTargets::begin_pass(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
                              std::uint32_t view_mask, const Color& background) const {
  // The pass before may still be writing these, or be copied from.
  const Access before{draw_color.stage | transfer_out.stage, draw_color.access};
  image_barrier(commands, color_.handle(), {Layout::eUndefined, Layout::eColorAttachmentOptimal}, before,
                {Stage::eColorAttachmentOutput, Reach::eColorAttachmentRead | Reach::eColorAttachmentWrite});
  image_barrier(commands, depth_.handle(), {Layout::eUndefined, Layout::eDepthAttachmentOptimal}, draw_depth,
                draw_depth, vk::ImageAspectFlagBits::eDepth);
  vk::RenderingAttachmentInfo color{
      .imageView = color_.view(),
      .imageLayout = Layout::eColorAttachmentOptimal,
      .resolveMode = vk::ResolveModeFlagBits::eAverage,
      .resolveImageView = target.view,
      .resolveImageLayout = Layout::eColorAttachmentOptimal,
      .loadOp = vk::AttachmentLoadOp::eClear,
      .storeOp = vk::AttachmentStoreOp::eDontCare,
      .clearValue = {.color = {.float32 = std::array{background.r, background.g, background.b, background.a}}}};
  if (way_ == Way::by_layer) {
    color.resolveMode = vk::ResolveModeFlagBits::eNone;
    color.resolveImageView = nullptr;
    color.storeOp = vk::AttachmentStoreOp::eStore;
  }
  const vk::RenderingAttachmentInfo depth{.imageView = depth_.view(),
                                          .imageLayout = Layout::eDepthAttachmentOptimal,
                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                          .storeOp = vk::AttachmentStoreOp::eDontCare,
                                          .clearValue = {.depthStencil = {.depth = 0}}};
  commands.beginRendering(
      {.renderArea = {.extent = {static_cast<std::uint32_t>(target.width), static_cast<std::uint32_t>(target.height)}},
       // Without a meaning where there is a view mask; some drivers keep the views within it all the same.
       .layerCount = color_.info().layers,
       .viewMask = view_mask,
       .colorAttachmentCount = 1,
       .pColorAttachments = &color,
       .pDepthAttachment = &depth});
}

void FrameTargets::end_pass(const vk::raii::CommandBuffer& commands, const RenderTarget& target,
                            std::uint32_t layer) const {
  commands.endRendering();
  if (way_ != Way::by_layer) return;
  image_barrier(commands, color_.handle(), {Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal}, draw_color,
                transfer_out);
  const vk::ImageResolve2 region{
      .srcSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .layerCount = 1},
      .dstSubresource = {.aspectMask = vk::ImageAspectFlagBits::eColor, .baseArrayLayer = layer, .layerCount = 1},
      .extent = {static_cast<std::uint32_t>(target.width), static_cast<std::uint32_t>(target.height), 1}};
  commands.resolveImage2({.srcImage = color_.handle(),
                          .srcImageLayout = Layout::eTransferSrcOptimal,
                          .dstImage = target.image,
                          .dstImageLayout = Layout::eTransferDstOptimal,
                          .regionCount = 1,
                          .pRegions = &region});
}

}  // namespace onestroke

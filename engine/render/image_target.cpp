#include "render/image_target.h"

namespace onestroke {

ImageTarget::ImageTarget(Device& device, vk::Format format, int width, int height, int views,
                         VkImageLayout final_layout)
    : image_(device, {.format = format,
                      .width = static_cast<std::uint32_t>(width),
                      .height = static_cast<std::uint32_t>(height),
                      .layers = static_cast<std::uint32_t>(views),
                      .usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc}),
      target_{.image = image_.handle(),
              .view = image_.view(),
              .format = static_cast<VkFormat>(format),
              .width = width,
              .height = height,
              .layers = views,
              .final_layout = final_layout} {
  for (std::uint32_t i = 0; i < image_.info().layers; ++i) {
    layers_.at(i) = make_layer_view(device, image_, i);
    target_.layer_views.at(i) = *layers_[i];
  }
}

}  // namespace onestroke

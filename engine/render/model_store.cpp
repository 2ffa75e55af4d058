#include "render/model_store.h"

#include "core/error.h"
#include "shaders/shared.h"

#include <algorithm>
#include <bit>

namespace onestroke {

namespace {

vk::raii::Sampler make_sampler(Device& device) {
  return device.vk().createSampler({.magFilter = vk::Filter::eLinear,
                                    .minFilter = vk::Filter::eLinear,
                                    .mipmapMode = vk::SamplerMipmapMode::eLinear,
                                    .anisotropyEnable = device.anisotropy(),
                                    .maxAnisotropy = std::min(8.0F, device.properties().limits.maxSamplerAnisotropy),
                                    .maxLod = VK_LOD_CLAMP_NONE});
}

[[noreturn]] void refuse(const Model& model, const std::string& what) {
  throw Error("model " + model.name + " is damaged, " + what + ": export it again");
}

void check(const Model& model) {
  if (model.vertices.empty() || model.indices.empty()) refuse(model, "it has no triangles");
  if (std::any_of(model.indices.begin(), model.indices.end(), [&](auto i) { return i >= model.vertices.size(); }))
    refuse(model, "an index points past the vertices");
  for (const auto& part : model.parts) {
    if (std::uint64_t{part.first_index} + part.index_count > model.indices.size())
      refuse(model, "a part points past the indices");
    if (part.material < 0 || static_cast<std::size_t>(part.material) >= model.materials.size())
      refuse(model, "a part has no material");
  }
  const auto count = static_cast<int>(model.images.size());
  for (const auto& m : model.materials)
    for (const int texture : {m.base_color_texture, m.metallic_roughness_texture, m.normal_texture, m.occlusion_texture,
                              m.emissive_texture})
      if (texture < -1 || texture >= count) refuse(model, "a material has no texture");
  for (const auto& image : model.images)
    if (image.width <= 0 || image.height <= 0 ||
        image.rgba.size() !=
            std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
      refuse(model, "a texture lacks pixels");
}

Image upload_texture(Device& device, const ModelImage& image) {
  const auto width = static_cast<std::uint32_t>(image.width), height = static_cast<std::uint32_t>(image.height);
  return upload_image(device,
                      {.format = image.srgb ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
                       .width = width,
                       .height = height,
                       .mip_levels = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)))},
                      std::as_bytes(std::span(image.rgba)));
}

gpu::MaterialData data_of(const ModelMaterial& m) {
  const bool mask = m.alpha_mode == ModelMaterial::AlphaMode::mask;
  const bool blend = m.alpha_mode == ModelMaterial::AlphaMode::blend;
  return {.base_color = {m.base_color[0], m.base_color[1], m.base_color[2], m.base_color[3]},
          .emissive = {m.emissive[0], m.emissive[1], m.emissive[2], mask ? m.alpha_cutoff : -1.0F},
          .factors = {m.metallic, m.roughness, m.normal_scale, m.occlusion_strength},
          .flags = {m.normal_texture >= 0 ? 1.0F : 0.0F, blend ? 1.0F : 0.0F, 0.0F, 0.0F}};
}

GpuModel::Part part_of(const Model& model, const ModelPart& part) {
  const ModelMaterial& material = model.materials[static_cast<std::size_t>(part.material)];
  glm::vec3 lower(INFINITY), upper(-INFINITY);
  for (std::uint32_t i = 0; i < part.index_count; ++i) {
    const auto& p = model.vertices[model.indices[part.first_index + i]].position;
    lower = glm::min(lower, glm::vec3(p[0], p[1], p[2]));
    upper = glm::max(upper, glm::vec3(p[0], p[1], p[2]));
  }
  return {.first_index = part.first_index,
          .index_count = part.index_count,
          .material = static_cast<std::uint32_t>(part.material),
          .centre = part.index_count ? (lower + upper) * 0.5F : glm::vec3(0.0F),
          .blends = material.alpha_mode == ModelMaterial::AlphaMode::blend,
          .double_sided = material.double_sided};
}

}  // namespace

ModelStore::ModelStore(Device& device, const Layouts& layouts)
    : device_(device), layouts_(layouts), sampler_(make_sampler(device)) {
  constexpr std::array white{std::byte{255}, std::byte{255}, std::byte{255}, std::byte{255}};
  white_ = upload_image(device, {.format = vk::Format::eR8G8B8A8Unorm, .width = 1, .height = 1}, white);
}

ModelHandle ModelStore::load(const Model& model) {
  check(model);
  auto gpu = std::make_shared<GpuModel>();
  gpu->vertices =
      upload_buffer(device_, std::as_bytes(std::span(model.vertices)), vk::BufferUsageFlagBits::eVertexBuffer);
  gpu->indices = upload_buffer(device_, std::as_bytes(std::span(model.indices)), vk::BufferUsageFlagBits::eIndexBuffer);
  for (const auto& image : model.images) gpu->images.push_back(upload_texture(device_, image));
  for (const auto& part : model.parts) gpu->parts.push_back(part_of(model, part));
  gpu->balls = contact_balls(model);
  if (!model.materials.empty()) add_materials(*gpu, model);

  const auto vacant = std::find(models_.begin(), models_.end(), nullptr);
  const auto index = static_cast<std::uint32_t>(vacant - models_.begin());
  if (vacant == models_.end())
    models_.push_back(std::move(gpu));
  else
    *vacant = std::move(gpu);
  return ModelHandle{index};
}

void ModelStore::add_materials(GpuModel& gpu, const Model& model) {
  const auto count = static_cast<std::uint32_t>(model.materials.size());
  const std::array sizes{vk::DescriptorPoolSize{vk::DescriptorType::eUniformBuffer, count},
                         vk::DescriptorPoolSize{vk::DescriptorType::eCombinedImageSampler, 5 * count}};
  gpu.descriptors =
      device_.vk().createDescriptorPool({.maxSets = count, .poolSizeCount = 2, .pPoolSizes = sizes.data()});
  const std::uint64_t alignment = device_.properties().limits.minUniformBufferOffsetAlignment;
  const std::uint64_t step = (sizeof(gpu::MaterialData) + alignment - 1) / alignment * alignment;
  std::vector<std::byte> bytes(step * count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto data = data_of(model.materials[i]);
    std::memcpy(bytes.data() + i * step, &data, sizeof data);
  }
  gpu.material_data = upload_buffer(device_, bytes, vk::BufferUsageFlagBits::eUniformBuffer);
  for (std::size_t i = 0; i < count; ++i) {
    const auto set =
        device_.vk()
            .allocateDescriptorSets(
                {.descriptorPool = *gpu.descriptors, .descriptorSetCount = 1, .pSetLayouts = &*layouts_.material})
            .front()
            .release();
    gpu.materials.push_back(write_material(gpu, model.materials[i], set, i * step));
  }
}

vk::DescriptorSet ModelStore::write_material(const GpuModel& gpu, const ModelMaterial& m, vk::DescriptorSet set,
                                             std::uint64_t data_at) const {
  // In the order of the bindings.
  const std::array textures{m.base_color_texture, m.metallic_roughness_texture, m.normal_texture, m.occlusion_texture,
                            m.emissive_texture};
  const vk::DescriptorBufferInfo data{
      .buffer = gpu.material_data.handle(), .offset = data_at, .range = sizeof(gpu::MaterialData)};
  std::array<vk::DescriptorImageInfo, textures.size()> images;
  std::array<vk::WriteDescriptorSet, textures.size() + 1> writes;
  writes[0] = {.dstSet = set,
               .dstBinding = BINDING_MATERIAL,
               .descriptorCount = 1,
               .descriptorType = vk::DescriptorType::eUniformBuffer,
               .pBufferInfo = &data};
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const Image& image = textures[i] < 0 ? white_ : gpu.images[static_cast<std::size_t>(textures[i])];
    images[i] = {
        .sampler = *sampler_, .imageView = image.view(), .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
    writes[i + 1] = {.dstSet = set,
                     .dstBinding = static_cast<std::uint32_t>(BINDING_BASE_COLOR + i),
                     .descriptorCount = 1,
                     .descriptorType = vk::DescriptorType::eCombinedImageSampler,
                     .pImageInfo = &images[i]};
  }
  device_.vk().updateDescriptorSets(writes, {});
  return set;
}

void ModelStore::unload(ModelHandle handle, Graveyard& graveyard) {
  const auto index = static_cast<std::size_t>(handle);
  if (index < models_.size() && models_[index]) graveyard.bury(std::shared_ptr<void>(std::move(models_[index])));
}

const GpuModel* ModelStore::find(ModelHandle handle) const {
  const auto index = static_cast<std::size_t>(handle);
  return index < models_.size() ? models_[index].get() : nullptr;
}

}  // namespace onestroke

#include "render/model_maker.h"

#include "core/error.h"
#include "shaders/shared.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

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

void check_parts(const Model& model, const std::vector<ModelPart>& parts) {
  for (const auto& part : parts) {
    if (std::uint64_t{part.first_index} + part.index_count > model.indices.size())
      refuse(model, "a part points past the indices");
    if (part.material < 0 || static_cast<std::size_t>(part.material) >= model.materials.size())
      refuse(model, "a part has no material");
  }
}

void check(const Model& model) {
  if (model.vertices.empty() || model.indices.empty()) refuse(model, "it has no triangles");
  if (std::any_of(model.indices.begin(), model.indices.end(), [&](auto i) { return i >= model.vertices.size(); }))
    refuse(model, "an index points past the vertices");
  check_parts(model, model.parts);
  for (const auto& level : model.levels) {
    if (level.parts.size() != model.parts.size()) refuse(model, "a level lacks parts");
    check_parts(model, level.parts);
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

ImageInfo info_of(const ModelImage& image) {
  const auto width = static_cast<std::uint32_t>(image.width), height = static_cast<std::uint32_t>(image.height);
  return {.format = image.srgb ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm,
          .width = width,
          .height = height,
          .mip_levels = static_cast<std::uint32_t>(std::bit_width(std::max(width, height)))};
}

gpu::MaterialData data_of(const ModelMaterial& m) {
  const bool mask = m.alpha_mode == ModelMaterial::AlphaMode::mask;
  const bool blend = m.alpha_mode == ModelMaterial::AlphaMode::blend;
  return {.base_color = {m.base_color[0], m.base_color[1], m.base_color[2], m.base_color[3]},
          .emissive = {m.emissive[0], m.emissive[1], m.emissive[2], mask ? m.alpha_cutoff : -1.0F},
          .factors = {m.metallic, m.roughness, m.normal_scale, m.occlusion_strength},
          .flags = {m.normal_texture >= 0 ? 1.0F : 0.0F, blend ? 1.0F : 0.0F, 0.0F, 0.0F}};
}

glm::vec3 position_of(const ModelVertex& v) {
  return {v.position[0], v.position[1], v.position[2]};
}

GpuModel::Part part_of(const Model& model, const ModelPart& part) {
  const ModelMaterial& material = model.materials[static_cast<std::size_t>(part.material)];
  Box box;
  for (std::uint32_t i = 0; i < part.index_count; ++i)
    box.add(position_of(model.vertices[model.indices[part.first_index + i]]));
  return {.first_index = part.first_index,
          .index_count = part.index_count,
          .material = static_cast<std::uint32_t>(part.material),
          .centre = part.index_count ? box.centre() : glm::vec3(0.0F),
          .blends = material.alpha_mode == ModelMaterial::AlphaMode::blend,
          .double_sided = material.double_sided,
          .textured = material.textured() || material.alpha_mode == ModelMaterial::AlphaMode::mask};
}

void add_level(const Model& model, const std::vector<ModelPart>& parts, float error, GpuModel& gpu) {
  gpu.errors.push_back(error);
  auto& level = gpu.levels.emplace_back();
  for (const auto& part : parts) level.push_back(part_of(model, part));
}

void add_geometry(const Model& model, GpuModel& gpu) {
  add_level(model, model.parts, 0, gpu);
  for (const auto& level : model.levels) add_level(model, level.parts, level.error, gpu);
  // Parts are sorted by where they are in full, so that their order does not hang on the level.
  for (auto& level : gpu.levels)
    for (std::size_t i = 0; i < level.size(); ++i) level[i].centre = gpu.levels.front()[i].centre;
  for (const auto& v : model.vertices) gpu.box.add(position_of(v));
}

}  // namespace

ModelMaker::ModelMaker(Device& device, const Layouts& layouts)
    : device_(device), layouts_(layouts), sampler_(make_sampler(device)) {
  constexpr std::array white{std::byte{255}, std::byte{255}, std::byte{255}, std::byte{255}};
  white_ = upload_image(device, {.format = vk::Format::eR8G8B8A8Unorm, .width = 1, .height = 1}, white);
}

std::shared_ptr<PreparedModel> ModelMaker::make(const Model& model) const {
  check(model);
  auto prepared = std::make_shared<PreparedModel>(device_);
  GpuModel& gpu = *prepared->model;
  Upload& upload = prepared->upload;
  gpu.vertices = upload.buffer(std::as_bytes(std::span(model.vertices)), vk::BufferUsageFlagBits::eVertexBuffer);
  gpu.indices = upload.buffer(std::as_bytes(std::span(model.indices)), vk::BufferUsageFlagBits::eIndexBuffer);
  for (const auto& image : model.images)
    gpu.images.push_back(upload.image(info_of(image), std::as_bytes(std::span(image.rgba))));
  add_geometry(model, gpu);
  if (model.casts_shadow) gpu.balls = contact_balls(model);
  if (!model.materials.empty()) add_materials(*prepared, model);
  return prepared;
}

void ModelMaker::add_materials(PreparedModel& prepared, const Model& model) const {
  GpuModel& gpu = *prepared.model;
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
  gpu.material_data = prepared.upload.buffer(bytes, vk::BufferUsageFlagBits::eUniformBuffer);
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

vk::DescriptorSet ModelMaker::write_material(const GpuModel& gpu, const ModelMaterial& m, vk::DescriptorSet set,
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

}  // namespace onestroke

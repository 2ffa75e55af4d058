#include "scene/gltf_reader.h"

#include "core/error.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace onestroke {

namespace {

// More elements than this are damage, not a model.
constexpr std::size_t most_elements = std::size_t{1} << 27;
// glTF's own limit.
constexpr std::size_t most_stride = 252;

int component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

template <class T>
T load(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <class T>
float load_integer(const std::uint8_t* at, bool normalized) {
  const auto value = static_cast<float>(load<T>(at));
  return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F) : value;
}

float load_number(const std::uint8_t* at, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return load_integer<std::int8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load_integer<std::uint8_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return load_integer<std::int16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load_integer<std::uint16_t>(at, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load_integer<std::uint32_t>(at, normalized);
    default:
      return load<float>(at);
  }
}

std::string name_of(int accessor) {
  return "accessor " + std::to_string(accessor);
}

}  // namespace

void GltfReader::fail(const std::string& what) const {
  throw Error(file_ + ": " + what + "; export the model again");
}

std::span<const std::uint8_t> GltfReader::view(int index) const {
  const std::string name = "buffer view " + std::to_string(index);
  if (index < 0 || static_cast<std::size_t>(index) >= model_.bufferViews.size()) fail(name + " is missing");
  const tinygltf::BufferView& v = model_.bufferViews[static_cast<std::size_t>(index)];
  if (v.buffer < 0 || static_cast<std::size_t>(v.buffer) >= model_.buffers.size())
    fail(name + " names a buffer that is missing");
  const std::vector<unsigned char>& data = model_.buffers[static_cast<std::size_t>(v.buffer)].data;
  if (v.byteOffset > data.size() || v.byteLength > data.size() - v.byteOffset)
    fail(name + " reaches past the end of its buffer");
  return std::span(data).subspan(v.byteOffset, v.byteLength);
}

const tinygltf::Accessor& GltfReader::accessor(int index) const {
  if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size()) fail(name_of(index) + " is missing");
  const tinygltf::Accessor& a = model_.accessors[static_cast<std::size_t>(index)];
  if (a.count == 0 || a.count > most_elements)
    fail(name_of(index) + " says it has " + std::to_string(a.count) + " elements");
  if (component_size(a.componentType) == 0) fail(name_of(index) + " has numbers of an unknown type");
  return a;
}

int GltfReader::components(int index) const {
  return tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor(index).type));
}

std::size_t GltfReader::count(int index) const {
  return accessor(index).count;
}

GltfReader::Elements GltfReader::elements(int view_index, std::size_t offset, int component_type, int components,
                                          std::size_t count, const std::string& owner) const {
  const std::span<const std::uint8_t> bytes = view(view_index);
  const int number = component_size(component_type);
  if (number == 0) fail(owner + " has numbers of an unknown type");
  const auto size = static_cast<std::size_t>(number * components);
  const std::size_t declared = model_.bufferViews[static_cast<std::size_t>(view_index)].byteStride;
  const std::size_t stride = declared == 0 ? size : declared;
  if (stride < size || stride > most_stride) fail(owner + " has a stride of " + std::to_string(stride) + " bytes");
  if (count > most_elements || offset > bytes.size() ||
      (count > 0 && (count - 1) * stride + size > bytes.size() - offset))
    fail(owner + " reaches past the end of its buffer view");
  return {bytes.subspan(offset), stride, component_type};
}

std::uint32_t GltfReader::whole(const Elements& e, std::size_t index) const {
  const std::uint8_t* at = e.bytes.data() + index * e.stride;
  switch (e.component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *at;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return load<std::uint32_t>(at);
    default:
      fail("its indices are not unsigned whole numbers");
  }
}

std::vector<float> GltfReader::numbers(int index, int components) const {
  const tinygltf::Accessor& a = accessor(index);
  if (this->components(index) != components)
    fail(name_of(index) + " does not have " + std::to_string(components) + " numbers an element");
  const auto width = static_cast<std::size_t>(components);
  std::vector<float> result(a.count * width, 0.0F);
  if (a.bufferView >= 0) {
    const Elements e = elements(a.bufferView, a.byteOffset, a.componentType, components, a.count, name_of(index));
    const auto number = static_cast<std::size_t>(component_size(a.componentType));
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] =
          load_number(e.bytes.data() + (i / width) * e.stride + (i % width) * number, a.componentType, a.normalized);
  } else if (!a.sparse.isSparse) {
    fail(name_of(index) + " has no data");
  }
  if (a.sparse.isSparse) apply_sparse(index, components, result);
  return result;
}

void GltfReader::apply_sparse(int index, int components, std::vector<float>& numbers) const {
  const tinygltf::Accessor& a = accessor(index);
  const auto& sparse = a.sparse;
  const std::string name = name_of(index) + "'s sparse part";
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) fail(name + " is damaged");
  const auto count = static_cast<std::size_t>(sparse.count);
  const Elements where = elements(sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                                  sparse.indices.componentType, 1, count, name);
  const Elements what = elements(sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                                 a.componentType, components, count, name);
  const auto width = static_cast<std::size_t>(components);
  const auto number = static_cast<std::size_t>(component_size(a.componentType));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t target = whole(where, i);
    if (target >= a.count) fail(name + " changes an element that is not there");
    for (std::size_t k = 0; k < width; ++k)
      numbers[target * width + k] =
          load_number(what.bytes.data() + i * what.stride + k * number, a.componentType, a.normalized);
  }
}

std::vector<std::uint32_t> GltfReader::indices(int index) const {
  const tinygltf::Accessor& a = accessor(index);
  if (components(index) != 1 || a.sparse.isSparse) fail(name_of(index) + " is not a plain list of indices");
  const Elements e = elements(a.bufferView, a.byteOffset, a.componentType, 1, a.count, name_of(index));
  std::vector<std::uint32_t> result(a.count);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = whole(e, i);
  return result;
}

}  // namespace onestroke

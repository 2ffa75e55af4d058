#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace onestroke {

/// Reads numbers out of a parsed glTF file, trusting nothing that the file says: every index, offset and length is
/// checked before memory is touched. All members throw Error that names the file and the element.
class GltfReader {
 public:
  /// The model must outlive the reader; file is its name in messages.
  GltfReader(const tinygltf::Model& model, std::string file) : model_(model), file_(std::move(file)) {}

  const tinygltf::Model& model() const { return model_; }
  [[noreturn]] void fail(const std::string& what) const;

  /// The bytes of a buffer view.
  std::span<const std::uint8_t> view(int index) const;
  /// How many numbers an element has.
  int components(int accessor) const;
  std::size_t count(int accessor) const;
  /// All elements one after another, `components` numbers each, normalized integers as glTF says, sparse ones filled
  /// in.
  std::vector<float> numbers(int accessor, int components) const;
  /// Whole numbers from 0, of any unsigned type, one an element.
  std::vector<std::uint32_t> indices(int accessor) const;

 private:
  // Elements of one type at regular distances, known to lie inside their buffer view.
  struct Elements {
    std::span<const std::uint8_t> bytes;
    std::size_t stride = 0;
    int component_type = 0;
  };

  const tinygltf::Accessor& accessor(int index) const;
  Elements elements(int view_index, std::size_t offset, int component_type, int components, std::size_t count,
                    const std::string& owner) const;
  std::uint32_t whole(const Elements& e, std::size_t index) const;
  void apply_sparse(int index, int components, std::vector<float>& numbers) const;

  const tinygltf::Model& model_;
  std::string file_;
};

}  // namespace onestroke

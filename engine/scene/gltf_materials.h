#pragma once

#include "scene/gltf_reader.h"
#include "scene/model.h"

namespace onestroke {

/// How images reach us from tinygltf: still encoded, decoded once the whole file is known to be sound. To be given to
/// TinyGLTF::SetImageLoader.
bool keep_encoded_image(tinygltf::Image* image, int index, std::string* error, std::string* warning, int width,
                        int height, const unsigned char* bytes, int size, void* user);

/// Fills materials and images: every material of the file in its order, and those images that a material uses, decoded.
void read_materials(const GltfReader& reader, Model& model);

/// The set of texture coordinates (TEXCOORD_n) that the material's textures use. They must agree.
int texture_coordinate_set(const GltfReader& reader, int material);

}  // namespace onestroke

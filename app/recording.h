#pragma once

#include "app/command_line.h"
#include "camera/recorder.h"
#include "core/camera.h"
#include "marker/catalog.h"

#include <memory>
#include <string>

namespace onestroke {

/// What --record asks for: a recording of what is tracked, with the catalogue, which was read from `catalog_file`;
/// nullptr where the folder's name is empty. Where it ends early that is said on standard error at once. Throws Error
/// where the folder is not empty or cannot be written.
std::unique_ptr<Recorder> open_recorder(const std::filesystem::path& folder, const SourceOptions& source,
                                        const Camera& camera, Catalog catalog,
                                        const std::filesystem::path& catalog_file);

/// Ends it, when nothing is tracked any more. Returns what there is, one line.
std::string finish(Recorder& recorder);

}  // namespace onestroke

#pragma once

#include "app/command_line.h"
#include "core/camera.h"
#include "core/head_tracker.h"
#include "marker/catalog.h"

#include <memory>

namespace onestroke {

/// Opens the camera that the command line asks for, or both as one. `mount` is on whose head the first one sits: a
/// synthetic one sees from there. Throws Error, or UsageError where its words are wrong.
std::unique_ptr<Camera> open_source(const SourceOptions& options, const Catalog& catalog, const HeadMount& mount = {});
/// The same, and a device's pictures say where in the world they were taken: each camera is a HeadCamera.
std::unique_ptr<Camera> open_worn_source(const SourceOptions& options, const Catalog& catalog, const HeadMount& mount);

}  // namespace onestroke

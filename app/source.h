#pragma once

#include "app/command_line.h"
#include "core/camera.h"
#include "core/head_tracker.h"
#include "marker/catalog.h"

#include <memory>

namespace onestroke {

/// Opens the camera that the command line asks for; `mount` is whose head a synthetic one sees from. Throws Error, or
/// UsageError where its words are wrong.
std::unique_ptr<Camera> open_source(const SourceOptions& options, const Catalog& catalog, const HeadMount& mount = {});

}  // namespace onestroke

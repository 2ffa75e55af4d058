#include "app/recording.h"

#include "app/say.h"

namespace onestroke {
namespace {

namespace fs = std::filesystem;

/// From the recording's folder the models are where they were.
void find_models_from_anywhere(Catalog& catalog, const fs::path& catalog_file) {
  std::error_code unknown;
  const fs::path folder = fs::absolute(catalog_file, unknown).parent_path();
  if (unknown) return;
  for (MarkerSpec& marker : catalog.markers)
    if (!marker.model.empty()) marker.model = (folder / marker.model).lexically_normal().string();
}

}  // namespace

std::unique_ptr<Recorder> open_recorder(const fs::path& folder, const SourceOptions& source, const Camera& camera,
                                        Catalog catalog, const fs::path& catalog_file) {
  if (folder.empty()) return nullptr;
  find_models_from_anywhere(catalog, catalog_file);
  return std::make_unique<Recorder>(
      folder, RecordingHeader{.program = ONESTROKE_VERSION, .camera = source.camera, .rate = camera.rate()}, catalog,
      RecorderListeners{.failed = say, .writes = {}});
}

std::string finish(Recorder& recorder) {
  recorder.close();
  return "wrote " + std::to_string(recorder.written()) + (recorder.written() == 1 ? " picture, " : " pictures, ") +
         std::to_string(recorder.left_out()) + " left out, to " + recorder.folder().string();
}

}  // namespace onestroke

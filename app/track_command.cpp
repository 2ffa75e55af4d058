#include "app/track_command.h"

#include "app/interrupt.h"
#include "app/overlay_drawing.h"
#include "app/pose_line.h"
#include "app/progress.h"
#include "app/recording.h"
#include "app/say.h"
#include "app/source.h"
#include "app/track_crew.h"
#include "core/error.h"
#include "display/png_file.h"

#include <algorithm>
#include <fstream>
#include <iostream>

namespace onestroke {
namespace {

/// Where the lines go, and how it is called in messages.
class Output {
 public:
  Output(const std::filesystem::path& file, std::ostream& otherwise) : out_(file.empty() ? otherwise : file_) {
    if (file.empty()) return;
    name_ = file.string();
    file_.open(file, std::ios::binary | std::ios::trunc);
    check();
  }

  void write(const std::string& line) {
    out_ << line << '\n' << std::flush;
    check();
  }

 private:
  void check() const {
    if (!out_)
      throw Error(name_ +
                  " cannot be written; check that its folder exists, that you may write there and that the "
                  "disk is not full");
  }

  std::string name_ = "standard output";
  std::ofstream file_;
  std::ostream& out_;
};

/// The folder of --overlay; none where its name is empty.
class OverlayFolder {
 public:
  OverlayFolder(std::filesystem::path folder, const std::string& camera) : folder_(std::move(folder)) {
    if (folder_.empty()) return;
    constexpr std::string_view pictures = "folder:";
    std::error_code failed;
    std::filesystem::create_directories(folder_, failed);
    if (failed || !std::filesystem::is_directory(folder_, failed))
      throw Error("folder " + folder_.string() + " cannot be made; check that you may write there");
    if (camera.starts_with(pictures) && std::filesystem::equivalent(folder_, camera.substr(pictures.size()), failed))
      throw UsageError("--overlay " + folder_.string() + " holds the camera's own pictures; give another folder");
  }

  void add(const Picture& picture, const Catalog& catalog, const FrameRecord& record) const {
    if (folder_.empty()) return;
    Canvas canvas(picture);
    draw_overlay(canvas, picture.intrinsics, catalog, record);
    // The name keeps its ending, since two pictures may differ in that alone.
    std::filesystem::path file = folder_ / picture_name(picture);
    if (file.extension() != ".png") file += ".png";
    write_png(file, canvas.width(), canvas.height(), canvas.rgba());
  }

 private:
  std::filesystem::path folder_;
};

std::size_t pictures_expected(const Camera& camera, const std::optional<int>& frames) {
  const std::size_t limit = frames ? static_cast<std::size_t>(*frames) : 0;
  if (limit == 0 || camera.length() == 0) return std::max(limit, camera.length());
  return std::min(limit, camera.length());
}

}  // namespace

int track_command(const TrackOptions& options, std::ostream& out) {
  const Catalog catalog = load_catalog(options.catalog);
  const std::unique_ptr<Camera> camera = open_source(options.source, catalog);
  const OverlayFolder overlay(options.overlay, options.source.camera);
  Output output(options.output, out);
  Progress progress(options.output.empty() && output_is_terminal());
  const std::size_t expected = pictures_expected(*camera, options.frames);
  std::size_t done = 0, found = 0;

  const std::unique_ptr<Recorder> recorder =
      open_recorder(options.record, options.source, *camera, catalog, options.catalog);
  TrackCrew crew(*camera, catalog, {.independent = options.independent}, options.threads, options.frames,
                 recorder.get());
  if (recorder) {
    // So that it is whole.
    catch_interrupt();
    crew.stop_when(interrupted);
  }
  const auto describe = [&](const Picture& picture, const FrameRecord& record) {
    overlay.add(picture, catalog, record);
    return pose_line(picture, record);
  };
  crew.run(describe, [&](const std::string& line, const FrameRecord& record) {
    output.write(line);
    found += static_cast<std::size_t>(
        std::ranges::count_if(record.seen(), [](const MarkerObservation& m) { return m.state != MarkerState::lost; }));
    progress.say(++done, expected, ", " + std::to_string(found) + " markers found");
  });
  if (recorder) say(finish(*recorder));
  if (camera->lost() > 0)
    say(std::to_string(camera->lost()) + " of the camera's pictures did not come, or came damaged");
  if (!camera->message().empty() && !crew.stopped_early()) throw Error(camera->message());
  return recorder && !recorder->failure().empty() ? 1 : 0;
}

}  // namespace onestroke

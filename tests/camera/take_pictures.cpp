// Takes pictures in the guest with our own live camera, and writes what it saw to the folder of CAMERA_RESULTS:
//   pictures.jsonl  a line for each picture: "sequence"; "start_ns", "length_ns" and "readout_ns" of its exposure;
//                   "got_ns"; "fingerprint" of its JPEG where it came as one, otherwise of its pixels
//   said.jsonl      what the camera said, and from when it was in which trouble
//   clock.jsonl     how far this machine's clock is ahead of the guest's, before and after
//   end.json        how many pictures were lost and how it ended
#include "camera/libcamera_source.h"
#include "camera/live_camera.h"
#include "core/error.h"
#include "fingerprint.h"
#include "machine_clock.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>

namespace onestroke {
namespace {

using nlohmann::json;

struct Options {
  std::string name;
  LiveOptions live;
  std::uint64_t count = 0;
  double seconds = 60;
};

void read(CLI::App& app, Options& options, int argc, char** argv) {
  options.live.size = PictureSize{640, 480};
  std::optional<double> exposure_ms;
  app.add_option("--camera", options.name, "Its id or model");
  app.add_option("--format", options.live.format, "yuyv or mjpeg");
  app.add_option("--exposure-ms", exposure_ms);
  app.add_option("--gain", options.live.gain);
  app.add_option("--white-balance", options.live.white_balance);
  app.add_option("--count", options.count, "End after so many pictures")->required();
  app.add_option("--seconds", options.seconds, "End after so many seconds at the latest");
  app.parse(argc, argv);
  if (exposure_ms) options.live.exposure = Duration::from_ms(*exposure_ms);
}

class Witness {
 public:
  explicit Witness(const std::filesystem::path& results)
      : results_(results),
        pictures_(results / "pictures.jsonl"),
        said_(results / "said.jsonl"),
        leads_(results / "clock.jsonl") {
    ask_clock();
  }

  void hear(const std::string& line) { said_ << json{{"time_ns", Time::now().ns}, {"said", line}} << std::endl; }

  void look(const Camera& camera) {
    if (camera.trouble() == trouble_) return;
    trouble_ = camera.trouble();
    said_ << json{{"time_ns", Time::now().ns}, {"trouble", trouble_}} << std::endl;
  }

  void add(const Picture& picture) {
    const std::size_t pixels = picture.strides[0] * static_cast<std::size_t>(picture.height);
    const std::span<const std::uint8_t> bytes =
        picture.jpeg.empty() ? std::span(picture.planes[0], pixels) : picture.jpeg;
    pictures_ << json{{"sequence", picture.sequence},
                      {"start_ns", picture.exposure.start.ns},
                      {"length_ns", picture.exposure.length.ns},
                      {"readout_ns", picture.exposure.readout.ns},
                      {"got_ns", Time::now().ns},
                      {"fingerprint", fingerprint(bytes)}}
              << '\n';
  }

  void end(const Camera& camera) {
    ask_clock();
    std::ofstream(results_ / "end.json") << json{{"lost", camera.lost()}, {"message", camera.message()}} << '\n';
  }

 private:
  void ask_clock() {
    const MachineClock::Lead lead = clock_.ask();
    leads_ << json{{"at_ns", lead.at.ns}, {"lead_ns", lead.lead.ns}, {"error_ns", lead.error.ns}} << std::endl;
  }

  const std::filesystem::path results_;
  const MachineClock clock_;
  std::ofstream pictures_, said_, leads_;
  std::string trouble_;
};

int run(int argc, char** argv) {
  CLI::App app("Takes pictures in the guest.");
  Options options;
  try {
    read(app, options, argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  const char* const results = std::getenv("CAMERA_RESULTS");
  if (!results) throw Error("CAMERA_RESULTS names no folder; run this with with_camera");
  Witness witness(results);
  options.live.say = [&](const std::string& line) { witness.hear(line); };
  const LensSource lens({}, std::numbers::pi / 3);
  const std::unique_ptr<Camera> camera =
      make_live_camera(make_libcamera_source(options.name, options.live), lens, {}, options.live);
  const Time until = Time::now() + Duration::from_seconds(options.seconds);
  Camera::Status status = Camera::Status::busy;
  for (std::uint64_t taken = 0; taken < options.count && Time::now() < until && status != Camera::Status::end;) {
    PictureHandle picture;
    status = camera->next(picture);
    witness.look(*camera);
    if (status != Camera::Status::ok) continue;
    witness.add(*picture);
    ++taken;
  }
  witness.end(*camera);
  return 0;
}

}  // namespace
}  // namespace onestroke

int main(int argc, char** argv) try { return onestroke::run(argc, argv); } catch (const std::exception& error) {
  std::cerr << "take_pictures: " << error.what() << '\n';
  return 1;
}

#include "photoreal_set.h"

#include "camera/picture_file.h"
#include "core/error.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <fstream>

namespace onestroke::accuracy {
namespace {

using nlohmann::json;

Pose pose_of(const json& marker) {
  return {to_quat(marker.at("R").get<Mat3>()),
          {marker.at("t").at(0).get<double>(), marker.at("t").at(1).get<double>(), marker.at("t").at(2).get<double>()}};
}

}  // namespace

struct PhotorealSet::Frames {
  struct Frame {
    std::string image, group;
    Intrinsics intrinsics;
    Exposure exposure;
    std::vector<Truth> truth;
  };
  std::vector<Frame> all;

  void read(const json& frame) {
    Frame f;
    f.image = frame.at("image").get<std::string>();
    f.group = frame.at("group").get<std::string>();
    const json& camera = frame.at("camera");
    f.intrinsics.fx = camera.at("fx").get<double>();
    f.intrinsics.fy = camera.at("fy").get<double>();
    f.intrinsics.cx = camera.at("cx").get<double>();
    f.intrinsics.cy = camera.at("cy").get<double>();
    if (frame.contains("rolling")) {
      const json& rolling = frame.at("rolling");
      f.exposure.length = Duration::from_seconds(rolling.at("exposure_s").get<double>());
      f.exposure.readout = Duration::from_seconds(rolling.at("readout_s").get<double>());
    }
    for (const json& m : frame.at("markers"))
      f.truth.push_back({m.at("id").get<int>(), pose_of(m), m.value("cells_visible", max_cells)});
    all.push_back(std::move(f));
  }
};

PhotorealSet::PhotorealSet(std::filesystem::path folder)
    : folder_(std::move(folder)),
      catalog_(load_catalog(folder_ / "catalog.json")),
      frames_(std::make_unique<Frames>()) {
  const std::filesystem::path file = folder_ / "truth.json";
  try {
    std::ifstream stream(file);
    const json truth = json::parse(stream);
    for (const json& frame : truth.at("frames")) frames_->read(frame);
  } catch (const json::exception& e) {
    throw Error(file.string() + " tells no truth of pictures (" + e.what() + "); name another folder");
  }
}

PhotorealSet::~PhotorealSet() = default;

void PhotorealSet::visit(const std::string& group, const Visit& visit) const {
  DecodedPicture decoded;
  for (const Frames::Frame& f : frames_->all) {
    if (f.group != group) continue;
    const std::filesystem::path file = folder_ / group / f.image;
    const std::string trouble = read_picture_file(file, decoded);
    if (!trouble.empty()) throw Error(file.string() + ": " + trouble);
    Picture picture;
    picture.width = decoded.width;
    picture.height = decoded.height;
    picture.planes[0] = decoded.rgb.data();
    picture.strides[0] = 3 * static_cast<std::size_t>(decoded.width);
    picture.intrinsics = f.intrinsics;
    picture.exposure = f.exposure;
    visit(f.image, picture, f.truth);
  }
}

std::filesystem::path photoreal_folder() {
  const char* folder = std::getenv("ONESTROKE_PHOTOREAL");
  return folder ? folder : "";
}

}  // namespace onestroke::accuracy

// played_pictures CATALOGUE FOLDER COUNT: draws what the played camera shows, a stick that turns by 0.4 degrees a
// picture before a head that sways, 640 x 480, to FOLDER/mjpeg/NNNN.jpg, FOLDER/yuyv/NNNN.yuyv and, with where the
// stick truly is, FOLDER/truth.jsonl.
#include "camera/open_camera.h"
#include "core/error.h"
#include "marker/catalog.h"

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <vector>

namespace onestroke {
namespace {

using Bytes = std::vector<unsigned char>;

void write(const std::filesystem::path& file, const Bytes& bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!out) throw Error(file.string() + " cannot be written; check that the disk is not full");
}

/// Baseline, 4:2:0, quality 95.
Bytes to_jpeg(const Picture& picture) {
  cv::Mat bgr(picture.height, picture.width, CV_8UC3);
  for (int y = 0; y < picture.height; ++y) {
    const std::uint8_t* const rgb = picture.planes[0] + static_cast<std::size_t>(y) * picture.strides[0];
    for (int x = 0; x < picture.width; ++x) bgr.at<cv::Vec3b>(y, x) = {rgb[3 * x + 2], rgb[3 * x + 1], rgb[3 * x]};
  }
  Bytes bytes;
  cv::imencode(".jpg", bgr, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  return bytes;
}

std::uint8_t to_byte(double value) {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
}

/// BT.601 of limited range; colour is the mean of two pixels'.
Bytes to_yuyv(const Picture& picture) {
  Bytes bytes;
  for (int y = 0; y < picture.height; ++y) {
    const std::uint8_t* rgb = picture.planes[0] + static_cast<std::size_t>(y) * picture.strides[0];
    for (int x = 0; x < picture.width; x += 2, rgb += 6) {
      const auto luma = [](const std::uint8_t* p) {
        return to_byte(16 + (65.481 * p[0] + 128.553 * p[1] + 24.966 * p[2]) / 255);
      };
      const double r = (rgb[0] + rgb[3]) / 2., g = (rgb[1] + rgb[4]) / 2., b = (rgb[2] + rgb[5]) / 2.;
      bytes.insert(bytes.end(), {luma(rgb), to_byte(128 + (-37.797 * r - 74.203 * g + 112.0 * b) / 255), luma(rgb + 3),
                                 to_byte(128 + (112.0 * r - 93.786 * g - 18.214 * b) / 255)});
    }
  }
  return bytes;
}

nlohmann::json truth_of(const Camera& camera, const Picture& picture) {
  nlohmann::json markers = nlohmann::json::array();
  for (const TrueMarker& marker : camera.truth(picture)) {
    const Vec3 t = marker.T_camera_marker.translation;
    markers.push_back({{"id", marker.id},
                       {"R", to_matrix(marker.T_camera_marker.rotation)},
                       {"t", {t.x, t.y, t.z}},
                       {"cells_visible", marker.cells_visible}});
  }
  return markers;
}

void draw(const std::filesystem::path& catalogue, const std::filesystem::path& folder, int count) {
  const Catalog catalog = load_catalog(catalogue);
  CameraOptions options;
  options.spec = "synthetic:width=640,height=480,fov_deg=35,script=turn_z,head=1,step_deg=0.4";
  options.catalog = &catalog;
  const std::unique_ptr<Camera> camera = open_camera(options);
  for (const char* const format : {"mjpeg", "yuyv"}) std::filesystem::create_directories(folder / format);
  std::ofstream truth(folder / "truth.jsonl");
  for (int i = 0; i < count; ++i) {
    PictureHandle picture;
    if (camera->next(picture) != Camera::Status::ok) throw Error("the synthetic camera has no picture");
    std::string name = std::to_string(i);
    name.insert(0, 4 - name.size(), '0');
    write(folder / "mjpeg" / (name + ".jpg"), to_jpeg(*picture));
    write(folder / "yuyv" / (name + ".yuyv"), to_yuyv(*picture));
    truth << nlohmann::json{{"image", name}, {"markers", truth_of(*camera, *picture)}} << '\n';
  }
}

}  // namespace
}  // namespace onestroke

int main(int argc, char** argv) try {
  if (argc != 4) throw onestroke::Error("give a catalogue, a folder and how many");
  onestroke::draw(argv[1], argv[2], std::stoi(argv[3]));
  return 0;
} catch (const std::exception& error) {
  std::cerr << "played_pictures: " << error.what() << '\n';
  return 1;
}

#include "photographs.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <map>
#include <memory>
#include <set>

namespace onestroke::accuracy {
namespace {

constexpr std::array packages{
    "lomiri-wallpapers-16.04", "lomiri-wallpapers-20.04",     "lxqt-themes",     "mate-backgrounds", "opencv-doc",
    "palapeli-data",           "plasma-workspace-wallpapers", "ukui-wallpapers", "visp-images-data"};

constexpr int width = 1280, part_height = 960;
// Smaller ones are icons and pieces of screens.
constexpr int min_width = 320, min_height = 200;
// Parts of one picture.
constexpr int max_parts = 4;

bool is_picture(const std::filesystem::path& file) {
  const std::string kind = file.extension().string();
  return kind == ".jpg" || kind == ".jpeg" || kind == ".png" || kind == ".pgm";
}

bool has_one_of(const std::string& text, std::initializer_list<const char*> parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const char* part) { return text.find(part) != std::string::npos; });
}

// Of ViSP's pictures the camera's own: of films every tenth.
bool is_camera_picture(const std::string& file) {
  if (has_one_of(file, {"/calibration/", "/AprilTag/AprilTag"})) return true;
  const bool film = has_one_of(file, {"/cube/image", "/castel/image"});
  return film && file.ends_with("0.pgm");
}

// Buttons, graphs and screens come as PNG in the OpenCV manual, previews stand beside KDE's wallpapers, and drawings
// beside photographs in LXQt's and Palapeli's.
bool is_photograph(const std::string& package, const std::filesystem::path& file) {
  if (!is_picture(file) || file.stem() == "screenshot") return false;
  const std::string name = file;
  if (package == "lxqt-themes")
    return has_one_of(name, {"/wallpapers/"}) &&
           !has_one_of(name, {"logo", "origami", "plasma", "triangles", "waves", "simple"});
  if (package == "palapeli-data") return has_one_of(name, {"/collection/"});
  if (package == "visp-images-data") return is_camera_picture(name);
  return package != "opencv-doc" || file.extension() == ".jpg";
}

std::vector<std::string> files_of(const std::string& package) {
  std::vector<std::string> files;
  const std::string command = "dpkg-query --listfiles " + package + " 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> list(popen(command.c_str(), "r"), pclose);
  std::array<char, 4096> line{};
  while (list && std::fgets(line.data(), static_cast<int>(line.size()), list.get())) {
    std::string file = line.data();
    file.erase(file.find_last_not_of('\n') + 1);
    if (is_photograph(package, file) && std::filesystem::is_regular_file(file)) files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// One wallpaper in several sizes is one picture: the largest file counts. They share a folder, or a name but for its
// last part.
std::string motif(const std::string& file) {
  const std::filesystem::path path(file);
  const std::string folder = path.parent_path().filename();
  if (folder == "images" || folder == "images_dark") return path.parent_path();
  const std::string stem = path.stem();
  const std::size_t size = stem.rfind('_');
  const bool sized = size != std::string::npos &&
                     stem.find_first_not_of("0123456789x", size + 1) == std::string::npos &&
                     stem.find('x', size) != std::string::npos;
  return path.parent_path() / (sized ? stem.substr(0, size) : stem);
}

}  // namespace

std::vector<Photograph> photographs() {
  std::vector<Photograph> found;
  std::set<std::size_t> known;
  for (const std::string package : packages) {
    std::map<std::string, std::string> motifs;
    for (const std::string& file : files_of(package)) {
      std::string& best = motifs[motif(file)];
      if (best.empty() || std::filesystem::file_size(file) > std::filesystem::file_size(best)) best = file;
    }
    for (const auto& [name, file] : motifs)
      if (known.insert(std::hash<std::string>{}(bytes_of(file))).second) found.push_back({package, file});
  }
  return found;
}

std::vector<cv::Rect> views_of(cv::Size size) {
  if (size.width < min_width || size.height < min_height) return {};
  std::vector<cv::Rect> views{{{}, size}};
  const int across = size.width / width, down = size.height / part_height;
  if (across < 2) return views;
  for (int i = 0; i < std::min(across * down, max_parts); ++i)
    views.push_back({i % across * width, i / across * part_height, width, part_height});
  return views;
}

cv::Mat3b read_view(const cv::Mat3b& bgr, const cv::Rect& view) {
  cv::Mat3b rgb;
  cv::cvtColor(bgr(view), rgb, cv::COLOR_BGR2RGB);
  const double scale = static_cast<double>(width) / rgb.cols;
  if (scale != 1) cv::resize(rgb, rgb, cv::Size(), scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
  return rgb;
}

}  // namespace onestroke::accuracy

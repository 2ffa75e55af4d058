#include "camera/folder_camera.h"

#include "camera/picture_file.h"
#include "core/error.h"
#include "core/picture_pool.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace onestroke {
namespace {

constexpr std::size_t buffers = 7;
constexpr double pictures_per_second = 30;

std::vector<std::string> picture_names(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    std::string ending = entry.path().extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool picture = ending == ".jpg" || ending == ".jpeg" || ending == ".png";
    if (picture && !entry.is_directory(error)) names.push_back(entry.path().filename().string());
  }
  if (error)
    throw Error("camera folder:" + folder.string() + " cannot be opened (" + error.message() +
                "); give a folder of pictures");
  if (names.empty())
    throw Error("camera folder:" + folder.string() + " holds no .jpg, .jpeg or .png; give a folder of pictures");
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

class FolderCamera : public Camera {
 public:
  FolderCamera(const std::filesystem::path& folder, const LensSource& lens, Duration readout)
      : folder_(folder), names_(picture_names(folder)), readout_(readout) {
    if (!read(0)) return;
    intrinsics_ = lens.intrinsics(decoded_.width, decoded_.height, (folder_ / names_[0]).string());
    width_ = decoded_.width;
    height_ = decoded_.height;
    pool_.emplace(buffers, decoded_.rgb.size());
    ahead_ = true;
  }

  Status next(PictureHandle& picture) override {
    if (!message_.empty() || next_ == names_.size()) return Status::end;
    PictureHandle::Loan* loan = pool_->acquire();
    if (!loan) return Status::busy;
    if ((!ahead_ && !read(next_)) || !same_size()) {
      pool_->give_back(*loan);
      return Status::end;
    }
    ahead_ = false;
    std::copy(decoded_.rgb.begin(), decoded_.rgb.end(), pool_->bytes(*loan).begin());
    fill(*loan);
    picture = PictureHandle(*loan);
    ++next_;
    return Status::ok;
  }

  std::string message() const override { return message_; }
  bool live() const override { return false; }
  double rate() const override { return pictures_per_second; }
  std::size_t length() const override { return names_.size(); }

 private:
  /// Fills decoded_, or says why not.
  bool read(std::size_t index) {
    const std::string wrong = read_picture_file(folder_ / names_[index], decoded_);
    if (!wrong.empty())
      message_ = "picture " + (folder_ / names_[index]).string() + " " + wrong + "; remove or replace it";
    return wrong.empty();
  }

  bool same_size() {
    if (decoded_.width == width_ && decoded_.height == height_) return true;
    message_ = "picture " + (folder_ / names_[next_]).string() + " has " + std::to_string(decoded_.width) + " x " +
               std::to_string(decoded_.height) + " pixels and those before it " + std::to_string(width_) + " x " +
               std::to_string(height_) + "; keep one size in a folder";
    return false;
  }

  void fill(PictureHandle::Loan& loan) const {
    Picture& p = loan.picture;
    p.width = width_;
    p.height = height_;
    p.format = PixelFormat::rgb8;
    p.planes[0] = pool_->bytes(loan).data();
    p.strides[0] = 3 * static_cast<std::size_t>(width_);
    p.sequence = next_;
    p.exposure = {Time{Duration::from_seconds(static_cast<double>(next_) / pictures_per_second).ns}, {}, readout_};
    p.intrinsics = intrinsics_;
    p.source = names_[next_].c_str();
  }

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  Duration readout_;
  Intrinsics intrinsics_;
  int width_ = 0, height_ = 0;
  DecodedPicture decoded_;
  bool ahead_ = false;  ///< decoded_ already holds picture next_.
  std::optional<PicturePool> pool_;
  std::size_t next_ = 0;
  std::string message_;
};

}  // namespace

std::unique_ptr<Camera> open_folder(const std::filesystem::path& folder, const LensSource& lens, Duration readout) {
  return std::make_unique<FolderCamera>(folder, lens, readout);
}

}  // namespace onestroke

#include "camera/folder_camera.h"

#include "camera/picture_file.h"
#include "core/error.h"
#include "core/lower_case.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace onestroke {
namespace {

constexpr double pictures_per_second = 30;

std::vector<std::string> picture_names(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string ending = lower_case(entry.path().extension().string());
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

Time time_of(std::size_t index) {
  return {Duration::from_seconds(static_cast<double>(index) / pictures_per_second).ns};
}

class FolderCamera final : public RecordedCamera {
 public:
  FolderCamera(const std::filesystem::path& folder, const LensSource& lens, Duration readout)
      : RecordedCamera("folder " + folder.string()), folder_(folder), names_(picture_names(folder)), readout_(readout) {
    if (!decode(0)) return;
    intrinsics_ = lens.intrinsics(decoded_.width, decoded_.height, (folder_ / names_[0]).string());
    width_ = decoded_.width;
    height_ = decoded_.height;
    set_buffers(decoded_.rgb.size());
    set_first({}, 0);
    ahead_ = 0;
  }

  double rate() const override { return pictures_per_second; }

 protected:
  std::size_t pictures() const override { return names_.size(); }

  bool read(PictureHandle::Loan& loan) override {
    if (next_ == names_.size() || (ahead_ != next_ && !decode(next_)) || !same_size()) return false;
    ahead_.reset();
    std::copy(decoded_.rgb.begin(), decoded_.rgb.end(), pool().bytes(loan).begin());
    fill(loan);
    ++next_;
    return true;
  }

  bool go_to(Duration after_start) override {
    next_ = 0;
    while (next_ < names_.size() && time_of(next_) - Time{} < after_start) ++next_;
    return next_ < names_.size();
  }

 private:
  /// Fills decoded_, or says why not.
  bool decode(std::size_t index) {
    const std::string wrong = read_picture_file(folder_ / names_[index], decoded_);
    if (!wrong.empty()) fail("picture " + (folder_ / names_[index]).string() + " " + wrong + "; remove or replace it");
    return wrong.empty();
  }

  bool same_size() {
    if (decoded_.width == width_ && decoded_.height == height_) return true;
    fail("picture " + (folder_ / names_[next_]).string() + " has " + std::to_string(decoded_.width) + " x " +
         std::to_string(decoded_.height) + " pixels and those before it " + std::to_string(width_) + " x " +
         std::to_string(height_) + "; keep one size in a folder");
    return false;
  }

  void fill(PictureHandle::Loan& loan) {
    Picture& p = loan.picture;
    p.width = width_;
    p.height = height_;
    p.format = PixelFormat::rgb8;
    p.planes[0] = pool().bytes(loan).data();
    p.strides[0] = 3 * static_cast<std::size_t>(width_);
    p.sequence = next_;
    p.exposure = {time_of(next_), {}, readout_};
    p.intrinsics = intrinsics_;
    p.source = names_[next_].c_str();
  }

  std::filesystem::path folder_;
  std::vector<std::string> names_;
  Duration readout_;
  Intrinsics intrinsics_;
  int width_ = 0, height_ = 0;
  DecodedPicture decoded_;
  std::optional<std::size_t> ahead_;  // which picture decoded_ holds before it is read
  std::size_t next_ = 0;
};

}  // namespace

std::unique_ptr<RecordedCamera> open_folder(const std::filesystem::path& folder, const LensSource& lens,
                                            Duration readout) {
  return std::make_unique<FolderCamera>(folder, lens, readout);
}

}  // namespace onestroke

#include "camera/libcamera_source.h"

#include "camera/libcamera_controls.h"
#include "camera/libcamera_stream.h"
#include "camera/libcamera_system.h"
#include "camera/live_session.h"
#include "camera/v4l2_controls.h"
#include "core/error.h"
#include "core/lower_case.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace onestroke {
namespace {

using CameraPointer = std::shared_ptr<libcamera::Camera>;

std::string words_of(const std::vector<CameraPointer>& cameras) {
  std::string words;
  for (const CameraPointer& camera : cameras)
    words += (words.empty() ? "" : ", ") + ("\"" + model_of(*camera) + "\" (" + camera->id() + ")");
  return words;
}

std::vector<OfferedFormat> formats_of(const libcamera::StreamFormats& formats, const LiveOptions& wishes) {
  std::vector<OfferedFormat> offered;
  for (const libcamera::PixelFormat& format : formats.pixelformats()) {
    OfferedFormat& one = offered.emplace_back(OfferedFormat{.name = format.toString()});
    for (const libcamera::Size& size : formats.sizes(format))
      one.sizes.push_back({static_cast<int>(size.width), static_cast<int>(size.height)});
    // A camera that scales lists a few of the sizes that it has.
    const auto listed = [&](const PictureSize& s) {
      return s.width == wishes.size->width && s.height == wishes.size->height;
    };
    if (!wishes.size || std::ranges::any_of(one.sizes, listed)) continue;
    const libcamera::Size wish(static_cast<unsigned>(wishes.size->width), static_cast<unsigned>(wishes.size->height));
    if (formats.range(format).contains(wish)) one.sizes.push_back(*wishes.size);
  }
  return offered;
}

class LibcameraSource final : public CaptureSource {
 public:
  LibcameraSource(std::string name, const LiveOptions& options)
      : system_(LibcameraSystem::get()), wanted_(std::move(name)), options_(options) {}

  std::string name() const override {
    if (!model_.empty()) return model_;
    return wanted_.empty() ? "libcamera" : wanted_;
  }

  std::unique_ptr<CaptureStream> start(Waker& waker, Refused& refused) override {
    if (std::exchange(started_, true)) renew_system();
    const CameraPointer camera = find(refused);
    if (!camera) return nullptr;
    id_ = camera->id();
    model_ = model_of(*camera);
    auto config = camera->generateConfiguration({libcamera::StreamRole::VideoRecording});
    if (!config || config->empty()) {
      refused = {CaptureRefusal::failed, "camera " + name() + " offers no stream of pictures; try another camera"};
      return nullptr;
    }
    LibcameraStream::Setup setup{
        .choice = choose_format(formats_of(config->at(0).formats(), options_), options_, name()),
        .controls = libcamera::ControlList()};
    const std::filesystem::path node = usb_node(id_);
    // What sensors' drivers stamp is the frame's first row on its way; see README.
    setup.stamped = node.empty() ? StampMoment::readout_start : StampMoment::reception;
    std::vector<std::string> shortfalls;
    setup.controls = controls_for(camera->controls(), options_, shortfalls);
    try {
      auto stream = std::make_unique<LibcameraStream>(camera, std::move(config), setup, waker);
      if (camera->controls().find(libcamera::controls::ColourTemperature.id()) == camera->controls().end())
        set_v4l2_controls(node, options_, shortfalls);
      tell(setup.choice, shortfalls);
      return stream;
    } catch (const std::system_error& error) {
      refused = refusal_of(error);
    }
    return nullptr;
  }

 private:
  /// libcamera 0.0.3 keeps a list of devices with what has gone, and reads freed memory when one of them comes again.
  void renew_system() {
    system_.reset();
    system_ = LibcameraSystem::get();
  }

  CameraPointer find(Refused& refused) const {
    const std::vector<CameraPointer> cameras = system_->cameras();
    // The one that it was before, or another of the same kind in its place.
    for (const CameraPointer& camera : cameras)
      if (!id_.empty() && camera->id() == id_) return camera;
    for (const CameraPointer& camera : cameras)
      if (!id_.empty() && model_of(*camera) == model_) return camera;
    if (const CameraPointer camera = id_.empty() ? named(cameras) : nullptr) return camera;
    if (const std::filesystem::path node = cameras.empty() ? forbidden_node() : ""; !node.empty())
      refused = {CaptureRefusal::denied,
                 "this user may not open " + node.string() + ": add yourself to the group video and log in again"};
    else if (cameras.empty())
      refused = {CaptureRefusal::absent, "no camera is connected that libcamera knows: plug one in"};
    else
      refused = {CaptureRefusal::absent, "no camera is called \"" + (id_.empty() ? wanted_ : model_) +
                                             "\": give --camera libcamera:NAME with one of " + words_of(cameras)};
    return nullptr;
  }

  CameraPointer named(const std::vector<CameraPointer>& cameras) const {
    if (wanted_.empty()) return cameras.empty() ? nullptr : cameras.front();
    for (const CameraPointer& camera : cameras)
      if (camera->id() == wanted_ || model_of(*camera) == wanted_) return camera;
    std::vector<CameraPointer> alike;
    for (const CameraPointer& camera : cameras)
      if (lower_case(camera->id() + "\n" + model_of(*camera)).find(lower_case(wanted_)) != std::string::npos)
        alike.push_back(camera);
    return alike.size() == 1 ? alike.front() : nullptr;
  }

  Refused refusal_of(const std::system_error& error) const {
    const int code = error.code().value();
    const std::string who = "camera " + name();
    if (code == EBUSY) return {CaptureRefusal::busy, "another program has it; close that, and it is used at once"};
    if (code == EACCES || code == EPERM)
      return {CaptureRefusal::denied, who + " may not be opened by this user: join the group video and log in again"};
    if (code == ENODEV || code == ENOENT) return {CaptureRefusal::absent, who + " has just gone: plug it in again"};
    return {CaptureRefusal::failed, who + " cannot be started, " + error.what() + ": unplug it and plug it in again"};
  }

  void tell(const FormatChoice& choice, const std::vector<std::string>& shortfalls) {
    if (told_ || !options_.say) return;
    told_ = true;
    options_.say("camera " + name() + ": " + std::to_string(choice.size.width) + " x " +
                 std::to_string(choice.size.height) + " pixels, " + choice.name);
    for (const std::string& line : shortfalls) options_.say("camera " + name() + ": " + line);
  }

  std::shared_ptr<LibcameraSystem> system_;
  const std::string wanted_;
  const LiveOptions options_;
  std::string id_, model_;  // of the camera that was started last
  bool started_ = false, told_ = false;
};

}  // namespace

std::unique_ptr<CaptureSource> make_libcamera_source(const std::string& name, const LiveOptions& options) {
  return std::make_unique<LibcameraSource>(name, options);
}

std::vector<CameraListing> list_cameras() {
  const std::shared_ptr<LibcameraSystem> system = LibcameraSystem::get();
  std::vector<CameraListing> list;
  for (const CameraPointer& camera : system->cameras()) {
    CameraListing& one = list.emplace_back(CameraListing{.id = camera->id(), .model = model_of(*camera)});
    if (const auto config = camera->generateConfiguration({libcamera::StreamRole::VideoRecording});
        config && !config->empty())
      one.formats = formats_of(config->at(0).formats(), {});
    for (const auto& [id, info] : camera->controls()) one.controls.push_back(id->name());
    try {
      one.usual = choose_format(one.formats, {}, one.model);
    } catch (const Error& error) {
      one.unusable = error.what();
    }
  }
  return list;
}

std::string forbidden_camera() {
  return forbidden_node().string();
}

std::string copies_words(CaptureCoding coding) {
  switch (coding) {
    case CaptureCoding::mjpeg:
      return "decoded once, and copied once for the GPU";
    case CaptureCoding::bgr8:
      return "turned from BGR once, and copied once for the GPU";
    case CaptureCoding::nv12:
    case CaptureCoding::yuyv:
    case CaptureCoding::rgb8:
      break;
  }
  return "copied at most once for the tracker (not where it has " + std::to_string(LiveSession::pictures) +
         " buffers), and once for the GPU";
}

std::string libcamera_version() {
  return libcamera::CameraManager::version();
}

}  // namespace onestroke

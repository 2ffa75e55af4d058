#include "camera/libcamera_stream.h"

#include <cerrno>
#include <system_error>

namespace onestroke {
namespace {

// More than a stream ever has.
constexpr std::size_t asked_buffers = 8;

void check(int result, const char* doing) {
  if (result < 0) throw std::system_error(-result, std::generic_category(), doing);
}

}  // namespace

LibcameraStream::LibcameraStream(std::shared_ptr<libcamera::Camera> camera,
                                 std::unique_ptr<libcamera::CameraConfiguration> config, const Setup& setup,
                                 Waker& waker)
    : camera_(std::move(camera)), waker_(waker), stamped_(setup.stamped) {
  try {
    check(camera_->acquire(), "taking the camera");
    acquired_ = true;
    configure(*config, setup);
    map_buffers();
    start(setup);
  } catch (...) {
    stop();
    throw;
  }
}

LibcameraStream::~LibcameraStream() {
  stop();
}

void LibcameraStream::configure(libcamera::CameraConfiguration& config, const Setup& setup) {
  libcamera::StreamConfiguration& wanted = config.at(0);
  const libcamera::Size size(static_cast<unsigned>(setup.choice.size.width),
                             static_cast<unsigned>(setup.choice.size.height));
  const libcamera::PixelFormat format = libcamera::PixelFormat::fromString(setup.choice.name);
  wanted.pixelFormat = format;
  wanted.size = size;
  wanted.bufferCount = asked_buffers;
  wanted.stride = 0;
  // What the tracker and the GPU take YUV for.
  if (setup.choice.coding == CaptureCoding::nv12 || setup.choice.coding == CaptureCoding::yuyv)
    wanted.colorSpace = libcamera::ColorSpace::Smpte170m;
  if (config.validate() == libcamera::CameraConfiguration::Invalid || wanted.size != size ||
      wanted.pixelFormat != format)
    throw std::system_error(EINVAL, std::generic_category(), "setting " + setup.choice.name + " " + size.toString());
  check(camera_->configure(&config), "setting its format");
  stream_ = wanted.stream();
  format_ = {.coding = setup.choice.coding,
             .size = setup.choice.size,
             .strides = {wanted.stride, setup.choice.coding == CaptureCoding::nv12 ? wanted.stride : 0}};
}

void LibcameraStream::map_buffers() {
  allocator_ = std::make_unique<libcamera::FrameBufferAllocator>(camera_);
  check(allocator_->allocate(stream_), "allocating its buffers");
  const std::size_t height = static_cast<std::size_t>(format_.size.height);
  for (const auto& buffer : allocator_->buffers(stream_)) {
    std::vector<MemoryPlane> planes;
    for (const auto& plane : buffer->planes()) planes.push_back({plane.fd.get(), plane.offset, plane.length});
    // Both in one piece, and not told apart.
    if (format_.coding == CaptureCoding::nv12 && planes.size() == 1) {
      const std::size_t luma = format_.strides[0] * height;
      planes.push_back({planes[0].descriptor, planes[0].offset + luma, planes[0].length - luma});
    }
    memory_.emplace_back(planes);
  }
}

void LibcameraStream::start(const Setup& setup) {
  const auto& buffers = allocator_->buffers(stream_);
  for (std::size_t i = 0; i < buffers.size(); ++i) {
    std::unique_ptr<libcamera::Request> request = camera_->createRequest(i);
    if (!request) throw std::system_error(ENOMEM, std::generic_category(), "making a request");
    check(request->addBuffer(stream_, buffers[i].get()), "giving it a buffer");
    requests_.push_back(std::move(request));
  }
  // Functions of a class that is none of libcamera's objects are called at once, on its thread.
  camera_->requestCompleted.connect(this, &LibcameraStream::completed);
  camera_->disconnected.connect(this, &LibcameraStream::disconnected);
  check(camera_->start(&setup.controls), "starting it");
  running_ = true;
  // Some of its drivers heed the controls of requests alone.
  requests_.front()->controls().merge(setup.controls);
  for (const auto& request : requests_) check(camera_->queueRequest(request.get()), "asking for a picture");
}

void LibcameraStream::completed(libcamera::Request* request) {
  done_.push(static_cast<std::size_t>(request->cookie()));
  waker_.wake();
}

void LibcameraStream::disconnected() {
  gone_.store(true, std::memory_order_release);
  waker_.wake();
}

std::span<const std::uint8_t> LibcameraStream::plane(std::size_t buffer, std::size_t index) const {
  return memory_[buffer].plane(index);
}

std::optional<Capture> LibcameraStream::take() noexcept {
  std::optional<std::size_t> index;
  done_.drain([&](std::size_t i) { index = i; }, 1);
  if (!index) return std::nullopt;
  const libcamera::Request& request = *requests_[*index];
  const libcamera::FrameMetadata& frame = request.findBuffer(stream_)->metadata();
  const libcamera::ControlList& told = const_cast<libcamera::Request&>(request).metadata();
  Capture capture;
  capture.buffer = *index;
  capture.sequence = frame.sequence;
  capture.stamp_ns = static_cast<std::int64_t>(frame.timestamp);
  capture.damaged =
      request.status() != libcamera::Request::RequestComplete || frame.status != libcamera::FrameMetadata::FrameSuccess;
  for (const auto& plane : frame.planes()) capture.bytes += plane.bytesused;
  if (const auto stamp = told.get(libcamera::controls::SensorTimestamp)) capture.stamp_ns = *stamp;
  if (const auto exposure = told.get(libcamera::controls::ExposureTime))
    capture.exposure = Duration{std::int64_t{*exposure} * 1000};
  memory_[*index].begin_reading();
  return capture;
}

void LibcameraStream::give(std::size_t buffer) noexcept {
  memory_[buffer].end_reading();
  if (!running_) return;
  requests_[buffer]->reuse(libcamera::Request::ReuseBuffers);
  // Where it fails the device is away, which is told otherwise.
  camera_->queueRequest(requests_[buffer].get());
}

void LibcameraStream::stop() noexcept {
  if (running_) camera_->stop();
  running_ = false;
  if (!acquired_) return;
  camera_->requestCompleted.disconnect(this);
  camera_->disconnected.disconnect(this);
  requests_.clear();
  allocator_.reset();
  camera_->release();
  camera_.reset();
  acquired_ = false;
}

}  // namespace onestroke

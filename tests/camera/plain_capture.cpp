// plain_capture FORMAT COUNT [SECONDS]: takes pictures of 640 x 480 by libcamera and nothing of ours, so that the guest
// and the played camera can be tried by themselves. FORMAT is MJPEG or YUYV. Says so when it has the camera. Writes to
// pictures.jsonl in the folder of CAMERA_RESULTS a line for each picture: "sequence", "time_ns", "good", "bytes" and
// "fingerprint"; and to clock.jsonl how far the machine's clock is ahead before and after. Then holds the camera for so
// many seconds.
#include "core/error.h"
#include "fingerprint.h"
#include "machine_clock.h"

#include <libcamera/libcamera.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>

#include <condition_variable>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <mutex>
#include <queue>
#include <thread>

namespace onestroke {
namespace {

using nlohmann::json;

// Slots are plain functions: one of an object's would be called on a thread that has libcamera's event loop.
std::mutex mutex;
std::condition_variable completion;
std::queue<libcamera::Request*> completed;

void on_completed(libcamera::Request* request) {
  const std::scoped_lock lock(mutex);
  completed.push(request);
  completion.notify_one();
}

libcamera::Request* next_completed() {
  constexpr std::chrono::seconds longest(10);
  std::unique_lock lock(mutex);
  if (!completion.wait_for(lock, longest, [] { return !completed.empty(); })) throw Error("no picture comes");
  libcamera::Request* const request = completed.front();
  completed.pop();
  return request;
}

/// A buffer's bytes.
class Mapped {
 public:
  explicit Mapped(const libcamera::FrameBuffer::Plane& plane)
      : length_(plane.offset + plane.length),
        offset_(plane.offset),
        at_(mmap(nullptr, length_, PROT_READ, MAP_SHARED, plane.fd.get(), 0)) {
    if (at_ == MAP_FAILED) throw Error("a buffer cannot be mapped");
  }
  Mapped(Mapped&& other) noexcept
      : length_(other.length_), offset_(other.offset_), at_(std::exchange(other.at_, MAP_FAILED)) {}
  ~Mapped() {
    if (at_ != MAP_FAILED) munmap(at_, length_);
  }
  std::span<const std::uint8_t> bytes(std::size_t used) const {
    return {static_cast<const std::uint8_t*>(at_) + offset_, used};
  }

 private:
  std::size_t length_, offset_;
  void* at_;
};

void check(int result, const char* what) {
  if (result < 0) throw Error(std::string(what) + ": " + std::strerror(-result));
}

json line_of(libcamera::Request& request, const libcamera::FrameBuffer& buffer, const Mapped& mapped) {
  const auto& data = buffer.metadata();
  const std::size_t used = data.planes()[0].bytesused;
  return {{"sequence", data.sequence},
          {"time_ns", request.metadata().get(libcamera::controls::SensorTimestamp).value_or(-1)},
          {"good", data.status == libcamera::FrameMetadata::FrameSuccess},
          {"bytes", used},
          {"fingerprint", fingerprint(mapped.bytes(used))}};
}

json line_of(const MachineClock::Lead& lead) {
  return {{"at_ns", lead.at.ns}, {"lead_ns", lead.lead.ns}, {"error_ns", lead.error.ns}};
}

void take(libcamera::Camera& camera, libcamera::Stream* stream, int count, const std::filesystem::path& results) {
  libcamera::FrameBufferAllocator allocator(camera.shared_from_this());
  check(allocator.allocate(stream), "allocate");
  std::vector<std::unique_ptr<libcamera::Request>> requests;
  std::map<const libcamera::FrameBuffer*, Mapped> mapped;
  for (const auto& buffer : allocator.buffers(stream)) {
    requests.push_back(camera.createRequest());
    check(requests.back()->addBuffer(stream, buffer.get()), "addBuffer");
    mapped.emplace(buffer.get(), Mapped(buffer->planes()[0]));
  }
  check(camera.start(), "start");
  for (const auto& request : requests) check(camera.queueRequest(request.get()), "queueRequest");
  std::ofstream lines(results / "pictures.jsonl");
  for (int i = 0; i < count; ++i) {
    libcamera::Request* const request = next_completed();
    const libcamera::FrameBuffer& buffer = *request->findBuffer(stream);
    lines << line_of(*request, buffer, mapped.at(&buffer)) << '\n';
    request->reuse(libcamera::Request::ReuseBuffers);
    check(camera.queueRequest(request), "queueRequest");
  }
  check(camera.stop(), "stop");
}

void take_with_times(libcamera::Camera& camera, libcamera::Stream* stream, int count) {
  const std::filesystem::path results = std::getenv("CAMERA_RESULTS");
  const MachineClock clock;
  std::ofstream leads(results / "clock.jsonl");
  leads << line_of(clock.ask()) << '\n';
  take(camera, stream, count, results);
  leads << line_of(clock.ask()) << '\n';
}

void run(const std::string& format, int count, int hold_seconds) {
  libcamera::CameraManager manager;
  check(manager.start(), "start of the manager");
  if (manager.cameras().empty()) throw Error("there is no camera");
  {
    const std::shared_ptr<libcamera::Camera> camera = manager.cameras().front();
    check(camera->acquire(), "acquire");
    std::cout << "has " << camera->id() << std::endl;
    camera->requestCompleted.connect(&on_completed);
    const auto configuration = camera->generateConfiguration({libcamera::StreamRole::VideoRecording});
    libcamera::StreamConfiguration& wanted = configuration->at(0);
    wanted.pixelFormat = libcamera::PixelFormat::fromString(format);
    wanted.size = {640, 480};
    if (configuration->validate() != libcamera::CameraConfiguration::Valid) throw Error("the format is not there");
    check(camera->configure(configuration.get()), "configure");
    if (count > 0) take_with_times(*camera, wanted.stream(), count);
    std::this_thread::sleep_for(std::chrono::seconds(hold_seconds));
    check(camera->release(), "release");
  }
  manager.stop();
}

}  // namespace
}  // namespace onestroke

int main(int argc, char** argv) try {
  if (argc < 3) throw onestroke::Error("give a format and how many");
  onestroke::run(argv[1], std::stoi(argv[2]), argc > 3 ? std::stoi(argv[3]) : 0);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "plain_capture: " << error.what() << '\n';
  return 1;
}

#include "camera/recorder.h"

#include "core/picture_planes.h"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <utility>

namespace onestroke {
namespace {

// Short against the time in which a queue fills.
void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::size_t bytes_of(const Picture& p) {
  return p.jpeg.empty() ? plane_bytes(p.format, p.width, p.height) : p.jpeg.size();
}

/// The picture as it is in the buffer: its JPEG, or else its planes.
Picture copied(const Picture& from, std::uint8_t* buffer) {
  Picture to = from;
  to.second = nullptr;
  to.source = "";
  if (from.jpeg.empty()) {
    copy_planes(from, buffer);
    set_planes(to, buffer);
  } else {
    std::ranges::copy(from.jpeg, buffer);
    to.planes = {};
    to.jpeg = {buffer, from.jpeg.size()};
  }
  return to;
}

}  // namespace

Recorder::Recorder(const std::filesystem::path& folder, const RecordingHeader& header, const Catalog& catalog,
                   RecorderListeners listeners)
    : writer_(folder, header, catalog), listeners_(std::move(listeners)) {
  writing_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "recording");
    write_until(stop);
  });
  copying_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "recording copy");
    copy_until(stop);
  });
}

Recorder::~Recorder() {
  close();
}

bool Recorder::add(const PictureHandle& picture, const FrameRecord& record) noexcept {
  if (failed_.load(std::memory_order_relaxed)) {
    ++missed_;
    return true;
  }
  // So that the copying thread never has to wait with the camera's buffers in its hands.
  if (on_the_way_.load(std::memory_order_acquire) == waiting) return false;
  const bool added = lent_.push_with([&](LentPicture& slot) {
    slot.picture = picture;
    copy_record(record, slot.record);
    slot.missed = missed_;
  });
  if (!added) return false;
  on_the_way_.fetch_add(1, std::memory_order_relaxed);
  missed_ = 0;
  return true;
}

void Recorder::close() noexcept {
  if (!copying_.joinable()) return;
  copying_.request_stop();
  copying_.join();
  writing_.request_stop();
  writing_.join();
  left_out_ += missed_;
  if (failed_) return;
  try {
    if (missed_ > 0) writer_.leave_out(missed_);
    writer_.finish();
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

std::string Recorder::failure() const {
  return failed_.load(std::memory_order_acquire) ? failure_ : std::string();
}

void Recorder::copy_until(const std::stop_token& stop) noexcept {
  for (;;) {
    // Read before looking: what was added before the end is then certainly copied.
    const bool last = stop.stop_requested();
    lent_.drain([this](const LentPicture& lent) {
      try {
        while (!copy(lent)) pause();
      } catch (const std::exception& error) {
        fail(error.what());
      }
    });
    if (last) return;
    pause();
  }
}

bool Recorder::copy(const LentPicture& lent) {
  return copied_.push_with([&](CopiedPicture& slot) { copy_into(slot, lent); });
}

void Recorder::copy_into(CopiedPicture& slot, const LentPicture& lent) {
  const Picture& picture = *lent.picture;
  const std::size_t place = copies_++ % waiting, bytes = bytes_of(picture);
  slot.pair = picture.second != nullptr;
  std::vector<std::uint8_t>& buffer = buffers_[place];
  buffer.resize(std::max(buffer.size(), bytes + (slot.pair ? bytes_of(*picture.second) : 0)));
  slot.picture = copied(picture, buffer.data());
  names_[place] = picture.source;
  slot.picture.source = names_[place].c_str();
  if (slot.pair) slot.second = copied(*picture.second, buffer.data() + bytes);
  copy_record(lent.record, slot.record);
  slot.missed = lent.missed;
}

void Recorder::write_until(const std::stop_token& stop) noexcept {
  for (;;) {
    const bool last = stop.stop_requested();
    copied_.drain([this](const CopiedPicture& copied) {
      try {
        write(copied);
      } catch (const std::exception& error) {
        fail(error.what());
        ++left_out_;
      }
      on_the_way_.fetch_sub(1, std::memory_order_release);
    });
    if (last) return;
    pause();
  }
}

void Recorder::write(const CopiedPicture& copied) {
  left_out_ += copied.missed;
  if (failed_) {
    ++left_out_;
    return;
  }
  if (listeners_.writes) listeners_.writes();
  if (copied.missed > 0) writer_.leave_out(copied.missed);
  Picture picture = copied.picture;
  if (copied.pair) picture.second = &copied.second;
  writer_.write(picture, copied.record);
  ++written_;
}

void Recorder::fail(const char* why) noexcept {
  if (failing_.exchange(true)) return;
  try {
    failure_ = "the recording ends early: " + std::string(why);
    if (listeners_.failed) listeners_.failed(failure_);
  } catch (const std::exception&) {
    // Without its words a failure is one all the same.
  }
  failed_.store(true, std::memory_order_release);
}

}  // namespace onestroke

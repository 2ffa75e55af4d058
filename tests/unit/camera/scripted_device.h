#pragma once

#include "camera/capture.h"

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace onestroke::test {

/// A device whose every move a test makes, from any thread.
class ScriptedDevice {
 public:
  explicit ScriptedDevice(CaptureFormat format, std::size_t buffers, std::size_t bytes_each)
      : format_(format), memory_(buffers, std::vector<std::uint8_t>(bytes_each)) {
    free_.reserve(2 * buffers);
    filled_.reserve(buffers);
  }

  /// What start() answers from now on.
  void refuse(std::optional<CaptureSource::Refused> refused) {
    const std::lock_guard lock(mutex_);
    refused_ = std::move(refused);
  }
  void set_stamped(StampMoment moment) { stamped_ = moment; }

  /// Fills a buffer with `bytes` and hands it over; false where the stream is stopped or has none left.
  bool send(std::span<const std::uint8_t> bytes, std::uint64_t sequence, std::int64_t stamp_ns,
            std::optional<Duration> exposure = std::nullopt, bool damaged = false) {
    const std::lock_guard lock(mutex_);
    if (!waker_ || free_.empty()) return false;
    Capture capture;
    capture.buffer = free_.front();
    free_.erase(free_.begin());
    std::ranges::copy(bytes, memory_[capture.buffer].begin());
    capture.bytes = bytes.size();
    capture.sequence = sequence;
    capture.stamp_ns = stamp_ns;
    capture.exposure = exposure;
    capture.damaged = damaged;
    filled_.push_back(capture);
    waker_->wake();
    return true;
  }
  void unplug() {
    const std::lock_guard lock(mutex_);
    gone_ = true;
    if (waker_) waker_->wake();
  }

  int starts() const { return count(starts_); }
  int stops() const { return count(stops_); }
  /// Buffers that are the device's to fill.
  int free_buffers() const {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(free_.size());
  }
  /// Buffers that were given twice, or given although the device had them.
  int misgiven() const { return count(misgiven_); }

  std::unique_ptr<CaptureSource> source() { return std::make_unique<Source>(*this); }

 private:
  class Stream final : public CaptureStream {
   public:
    explicit Stream(ScriptedDevice& device) : device_(device), memory_(device.memory_) {}
    ~Stream() override { stop(); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    const CaptureFormat& format() const override { return device_.format_; }
    StampMoment stamped() const override { return device_.stamped_; }
    std::size_t buffers() const override { return memory_.size(); }
    std::span<const std::uint8_t> plane(std::size_t buffer, std::size_t index) const override {
      const std::vector<std::uint8_t>& memory = device_.memory_[buffer];
      const std::size_t luma = device_.format_.strides[0] * static_cast<std::size_t>(device_.format_.size.height);
      if (device_.format_.coding != CaptureCoding::nv12) return index == 0 ? memory : std::span<const std::uint8_t>{};
      return index == 0 ? std::span(memory).first(luma) : std::span(memory).subspan(luma);
    }
    std::optional<Capture> take() noexcept override {
      const std::lock_guard lock(device_.mutex_);
      if (device_.filled_.empty()) return std::nullopt;
      const Capture capture = device_.filled_.front();
      device_.filled_.erase(device_.filled_.begin());
      return capture;
    }
    void give(std::size_t buffer) noexcept override {
      const std::lock_guard lock(device_.mutex_);
      if (std::ranges::find(device_.free_, buffer) != device_.free_.end()) ++device_.misgiven_;
      device_.free_.push_back(buffer);
    }
    bool gone() const noexcept override {
      const std::lock_guard lock(device_.mutex_);
      return device_.gone_;
    }
    void stop() noexcept override {
      const std::lock_guard lock(device_.mutex_);
      if (std::exchange(stopped_, true)) return;
      ++device_.stops_;
      device_.waker_ = nullptr;
    }

   private:
    ScriptedDevice& device_;
    std::vector<std::vector<std::uint8_t>>& memory_;
    bool stopped_ = false;
  };

  class Source final : public CaptureSource {
   public:
    explicit Source(ScriptedDevice& device) : device_(device) {}
    std::string name() const override { return "scripted"; }
    std::unique_ptr<CaptureStream> start(Waker& waker, Refused& refused) override {
      {
        const std::lock_guard lock(device_.mutex_);
        if (device_.refused_) {
          refused = *device_.refused_;
          return nullptr;
        }
        ++device_.starts_;
        device_.gone_ = false;
        device_.waker_ = &waker;
        device_.filled_.clear();
        device_.free_.clear();
        for (std::size_t i = 0; i < device_.memory_.size(); ++i) device_.free_.push_back(i);
      }
      return std::make_unique<Stream>(device_);
    }

   private:
    ScriptedDevice& device_;
  };

  int count(const int& counter) const {
    const std::lock_guard lock(mutex_);
    return counter;
  }

  mutable std::mutex mutex_;
  const CaptureFormat format_;
  StampMoment stamped_ = StampMoment::exposure_start;
  std::vector<std::vector<std::uint8_t>> memory_;
  std::vector<std::size_t> free_;
  std::vector<Capture> filled_;
  std::optional<CaptureSource::Refused> refused_;
  Waker* waker_ = nullptr;
  bool gone_ = false;
  int starts_ = 0, stops_ = 0, misgiven_ = 0;
};

}  // namespace onestroke::test

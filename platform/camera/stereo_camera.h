#pragma once

#include "camera/pair_pool.h"
#include "core/camera.h"

#include <array>
#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace onestroke {

/// The cameras of two eyes as one: what both took at about the same time is one picture and its second. The first is
/// the left one, and its picture gives the pair its number. Pictures belong together where the middles of their
/// exposures are at most half a period of the faster camera apart, or, where the rate is not known, by their order.
///
/// Two devices take their pictures on a thread each, so that neither waits for the other longer than a picture's time
/// and a half. Where one has taken none for a while the other goes on alone, without a second. Of a device's pictures
/// that nobody takes the newest two are kept. Of two recordings the first says when there is a picture; the second's
/// that fit none are left out. Allocates nothing once warm.
class StereoCamera final : public Camera {
 public:
  /// How long a device is waited for before the other one goes on alone.
  static constexpr Duration silence = Duration::from_ms(500);

  /// T_first_second is where the second camera is as the first sees it; none where both say by themselves where in the
  /// world they are. Throws Error where one is a device and the other a recording.
  StereoCamera(std::unique_ptr<Camera> first, std::unique_ptr<Camera> second,
               const std::optional<Pose>& T_first_second);
  /// Waits for both cameras to come out of next().
  ~StereoCamera() override;

  Status next(PictureHandle& picture) override;
  std::string message() const override;
  bool live() const override { return live_; }
  double rate() const override { return eyes_[0].camera->rate(); }
  std::size_t length() const override { return eyes_[0].camera->length(); }
  double period() const override { return eyes_[0].camera->period(); }
  /// Of the first, where both are in trouble: one alone still gives pictures.
  std::string_view trouble() const override;
  std::uint64_t lost() const override;
  bool seek(Duration after_start) override;
  /// Of the picture of either eye.
  std::span<const TrueMarker> truth(const Picture& picture) const override;

  /// Pairs that are lent at this moment; as PairPool::lent().
  std::size_t lent() const { return pairs_.lent(); }

 private:
  static constexpr std::size_t most_waiting = 2;

  /// One camera and what it took last.
  struct Eye {
    std::unique_ptr<Camera> camera;
    std::array<PictureHandle, most_waiting> waiting;  // the oldest first
    std::size_t count = 0;
    Time came;  // the newest
    std::atomic<bool> ended{false};
    std::atomic<std::uint64_t> left_out{0};

    const Picture& oldest() const { return *waiting.front(); }
    void push(PictureHandle picture);
    PictureHandle pop();
  };
  enum class Choice { wait, both, first, second, end };

  void start();
  void take_pictures(Eye& eye, const std::stop_token& stop);
  Status next_live(PictureHandle& picture);
  Status next_recorded(PictureHandle& picture);
  Choice choose(Time now);
  Status fill(Eye& eye);
  Duration between() const;
  bool together() const;
  void lend(PairPool::Pair& pair, Choice choice, PictureHandle& picture);

  const std::optional<Pose> T_first_second_;
  std::array<Eye, 2> eyes_;
  PairPool pairs_;
  const bool live_;
  const double rate_;          // of the faster one; 0 where it is not known
  Pose T_world_first_;         // of the last picture of the first
  std::uint64_t numbers_ = 0;  // one more than that of the last pair
  std::atomic<bool> sought_{false};
  std::mutex mutex_;  // over what waits
  std::condition_variable came_;
  std::array<std::jthread, 2> threads_;
};

}  // namespace onestroke

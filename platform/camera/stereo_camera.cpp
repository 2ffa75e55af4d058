#include "camera/stereo_camera.h"

#include "core/error.h"

#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace onestroke {
namespace {

// As many as two cameras may have lent.
constexpr std::size_t most_pairs = 24;
constexpr double usual_rate = 30;
// After so long a caller may want to stop.
constexpr Duration longest_wait = Duration::from_ms(50);

std::chrono::nanoseconds chrono(Duration d) {
  return std::chrono::nanoseconds(d.ns);
}

}  // namespace

void StereoCamera::Eye::push(PictureHandle picture) {
  came = Time::now();
  if (count == waiting.size()) {
    pop();
    left_out.fetch_add(1, std::memory_order_relaxed);
  }
  waiting[count++] = std::move(picture);
}

PictureHandle StereoCamera::Eye::pop() {
  PictureHandle picture = std::move(waiting.front());
  std::move(waiting.begin() + 1, waiting.end(), waiting.begin());
  --count;
  return picture;
}

StereoCamera::StereoCamera(std::unique_ptr<Camera> first, std::unique_ptr<Camera> second,
                           const std::optional<Pose>& T_first_second)
    : T_first_second_(T_first_second),
      pairs_(most_pairs),
      live_(first->live()),
      rate_(std::min(first->rate(), second->rate()) > 0 ? std::max(first->rate(), second->rate()) : 0) {
  if (first->live() != second->live())
    throw Error("of two cameras one is a device and the other a recording: give two of a kind");
  eyes_[0].camera = std::move(first);
  eyes_[1].camera = std::move(second);
}

StereoCamera::~StereoCamera() {
  for (std::jthread& thread : threads_) thread.request_stop();
}

void StereoCamera::start() {
  for (std::size_t i = 0; i < eyes_.size(); ++i) {
    eyes_[i].came = Time::now();
    threads_[i] = std::jthread([this, i](const std::stop_token& stop) {
      pthread_setname_np(pthread_self(), i == 0 ? "left camera" : "right camera");
      take_pictures(eyes_[i], stop);
    });
  }
}

void StereoCamera::take_pictures(Eye& eye, const std::stop_token& stop) {
  while (!stop.stop_requested() && !eye.ended) {
    PictureHandle picture;
    const Status status = eye.camera->next(picture);
    if (status == Status::busy) {
      std::this_thread::sleep_for(std::chrono::microseconds(300));
      continue;
    }
    const std::lock_guard lock(mutex_);
    if (status == Status::ok) eye.push(std::move(picture));
    if (status == Status::end) eye.ended = true;
    came_.notify_one();
  }
}

Camera::Status StereoCamera::next(PictureHandle& picture) {
  return live_ ? next_live(picture) : next_recorded(picture);
}

/// From the first's oldest picture to the second's.
Duration StereoCamera::between() const {
  return eyes_[1].oldest().exposure.middle() - eyes_[0].oldest().exposure.middle();
}

bool StereoCamera::together() const {
  const Duration apart = between(), half = Duration::from_seconds(0.5 / rate_);
  return apart <= half && -apart <= half;
}

StereoCamera::Choice StereoCamera::choose(Time now) {
  Eye &first = eyes_[0], &second = eyes_[1];
  // One camera may take longer to hand on what it took at the same time.
  const Duration patience = Duration::from_seconds(1.5 / (rate_ > 0 ? rate_ : usual_rate));
  const auto silent = [now](const Eye& eye) { return eye.ended || now - eye.came > silence; };
  while (first.count > 0 && second.count > 0) {
    if (rate_ <= 0 || together()) return Choice::both;
    if (between() > Duration{}) return Choice::first;
    second.pop();
  }
  if (first.count > 0) return silent(second) || now - first.came > patience ? Choice::first : Choice::wait;
  if (second.count > 0 && silent(first)) return Choice::second;
  return first.ended && second.ended ? Choice::end : Choice::wait;
}

Camera::Status StereoCamera::next_live(PictureHandle& picture) {
  if (!threads_[0].joinable()) start();
  const Time until = Time::now() + longest_wait;
  std::unique_lock lock(mutex_);
  for (;;) {
    const Time now = Time::now();
    const Choice choice = choose(now);
    if (choice == Choice::end) return Status::end;
    if (choice != Choice::wait) {
      PairPool::Pair* const pair = pairs_.acquire();
      if (!pair) return Status::busy;
      lend(*pair, choice, picture);
      return Status::ok;
    }
    if (now >= until) return Status::busy;
    // Short enough to find out in time that the other one's picture does not come.
    constexpr Duration glance = Duration::from_ms(5);
    came_.wait_for(lock, chrono(std::min(glance, until - now)));
  }
}

/// Where the eye has no picture waiting, its next one.
Camera::Status StereoCamera::fill(Eye& eye) {
  if (eye.count > 0) return Status::ok;
  if (eye.ended) return Status::end;
  PictureHandle picture;
  const Status status = eye.camera->next(picture);
  if (status == Status::ok) eye.push(std::move(picture));
  if (status == Status::end) eye.ended = true;
  return status;
}

Camera::Status StereoCamera::next_recorded(PictureHandle& picture) {
  Eye &first = eyes_[0], &second = eyes_[1];
  if (sought_.exchange(false)) {
    for (Eye& eye : eyes_) {
      while (eye.count > 0) eye.pop();
      eye.ended = false;
    }
  }
  PairPool::Pair* const pair = pairs_.acquire();
  if (!pair) return Status::busy;
  const auto without = [&](Status status) {
    pairs_.give_back(*pair);
    return status;
  };
  if (const Status status = fill(first); status != Status::ok) return without(status);
  Choice choice = Choice::wait;
  while (choice == Choice::wait) {
    const Status status = fill(second);
    if (status == Status::busy) return without(status);
    // One that is damaged ends both; one that is merely shorter leaves the rest to the first.
    if (status == Status::end && !second.camera->message().empty()) return without(status);
    if (status == Status::end || (rate_ > 0 && !together() && between() > Duration{}))
      choice = Choice::first;
    else if (rate_ <= 0 || together())
      choice = Choice::both;
    else
      second.pop();
  }
  lend(*pair, choice, picture);
  return Status::ok;
}

void StereoCamera::lend(PairPool::Pair& pair, Choice choice, PictureHandle& picture) {
  if (choice != Choice::second) {
    pair.held[0] = eyes_[0].pop();
    pair.picture = *pair.held[0];
    T_world_first_ = pair.picture.T_world_camera;
  }
  if (choice != Choice::first) {
    pair.held[1] = eyes_[1].pop();
    pair.right = *pair.held[1];
    if (T_first_second_) pair.right.T_world_camera = T_world_first_ * *T_first_second_;
  }
  if (choice == Choice::both) pair.join();
  if (choice == Choice::second) pair.picture = pair.right;
  // Devices that take turns have numbers of their own.
  if (live_) pair.picture.sequence = std::max(pair.picture.sequence, numbers_);
  numbers_ = pair.picture.sequence + 1;
  picture = PictureHandle(pair);
}

std::string StereoCamera::message() const {
  const std::string first = eyes_[0].camera->message();
  return first.empty() ? eyes_[1].camera->message() : first;
}

std::string_view StereoCamera::trouble() const {
  std::string_view words;
  for (const Eye& eye : eyes_) {
    if (eye.ended) continue;
    const std::string_view own = eye.camera->trouble();
    if (own.empty()) return {};
    if (words.empty()) words = own;
  }
  return words;
}

std::uint64_t StereoCamera::lost() const {
  std::uint64_t sum = 0;
  for (const Eye& eye : eyes_) sum += eye.camera->lost() + eye.left_out.load(std::memory_order_relaxed);
  return sum;
}

bool StereoCamera::seek(Duration after_start) {
  const bool first = eyes_[0].camera->seek(after_start), second = eyes_[1].camera->seek(after_start);
  sought_ = true;
  return first && second;
}

std::span<const TrueMarker> StereoCamera::truth(const Picture& picture) const {
  const PairPool::Pair* const pair = pairs_.find(picture);
  if (!pair) return {};
  const std::size_t eye = &picture == &pair->right || !pair->held[0] ? 1 : 0;
  return eyes_[eye].camera->truth(*pair->held[eye]);
}

}  // namespace onestroke

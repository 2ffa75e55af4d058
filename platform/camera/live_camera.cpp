#include "camera/live_camera.h"

#include "camera/live_session.h"
#include "core/error.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <vector>

namespace onestroke {
namespace {

// How long next() may wait, so that whoever calls it can stop.
constexpr Duration longest_wait = Duration::from_ms(50);
// Between two tries to start a camera that cannot be had.
constexpr Duration try_again = Duration::from_ms(500);
constexpr double usual_rate = 30;
// So many pictures may wait; older ones are left out.
constexpr std::size_t waiting = 2;
// Damaged pictures one after another before anybody is told.
constexpr int damaged_told = 5;

/// What trouble() says.
constexpr const char* words_absent = "the camera is unplugged: plug it in again";
constexpr const char* words_busy = "another program has the camera: close it";
constexpr const char* words_denied = "this user may not open the camera: join the group video";
constexpr const char* words_silent = "the camera sends nothing: it is started again";
constexpr const char* words_failed = "the camera cannot be started: unplug it and plug it in again";
constexpr const char* words_damaged = "the camera's pictures come damaged: try another cable or port";

const char* words_of(CaptureRefusal refusal) {
  switch (refusal) {
    case CaptureRefusal::absent:
      return words_absent;
    case CaptureRefusal::busy:
      return words_busy;
    case CaptureRefusal::denied:
      return words_denied;
    case CaptureRefusal::failed:
      break;
  }
  return words_failed;
}

class LiveCamera final : public Camera {
 public:
  LiveCamera(std::unique_ptr<CaptureSource> source, const LensSource& lens, Duration readout,
             const LiveOptions& options)
      : source_(std::move(source)), lens_(lens), readout_(readout), options_(options) {
    const std::optional<CaptureSource::Refused> refused = start();
    if (!refused) return;
    if (refused->refusal != CaptureRefusal::busy) throw Error(refused->why);
    trouble(words_busy, ": " + refused->why);
  }

  ~LiveCamera() override {
    if (session_) session_->stream().stop();
  }

  Status next(PictureHandle& picture) override {
    try {
      return next_picture(picture);
    } catch (const std::exception& error) {
      message_ = error.what();
      return Status::end;
    }
  }

  std::string message() const override { return message_; }
  bool live() const override { return true; }
  double rate() const override { return options_.rate.value_or(usual_rate); }
  std::size_t length() const override { return 0; }
  std::string_view trouble() const override { return trouble_.load(std::memory_order_acquire); }
  std::uint64_t lost() const override { return lost_.load(std::memory_order_relaxed); }

 private:
  Status next_picture(PictureHandle& picture) {
    std::erase_if(old_, [](const auto& session) { return session->idle(); });
    if (!session_ && !start_again()) return Status::busy;
    for (bool waited = false;; waited = true) {
      session_->requeue();
      if (session_->stream().gone()) return lose(words_absent, " is gone; it is used again as soon as it is back");
      if (take(picture)) return Status::ok;
      // Who holds all its pictures has silenced it.
      if (session_->starved()) heard_ = Time::now();
      const Duration silence = Time::now() - heard_;
      if (silence >= options_.patience) return lose(words_silent, silence_words(silence));
      if (waited) return Status::busy;
      waker_.sleep(std::min(longest_wait, options_.patience - silence));
    }
  }

  static std::string silence_words(Duration silence) {
    std::array<char, 96> words{};
    std::snprintf(words.data(), words.size(), " has sent nothing for %.1f s and is started again", silence.seconds());
    return words.data();
  }

  void say(const std::string& line) const {
    if (options_.say) options_.say("camera " + source_->name() + line);
  }

  /// Why not, where it could not.
  std::optional<CaptureSource::Refused> start() {
    tried_ = Time::now();
    CaptureSource::Refused refused;
    std::unique_ptr<CaptureStream> stream = source_->start(waker_, refused);
    if (!stream) return refused;
    session_ = std::make_unique<LiveSession>(std::move(stream), waker_);
    const CaptureFormat& format = session_->format();
    intrinsics_ = lens_.intrinsics(format.size.width, format.size.height, "camera " + source_->name());
    clock_ = {};
    last_.reset();
    waiting_count_ = 0;
    damaged_ = 0;
    heard_ = Time::now();
    return std::nullopt;
  }

  bool start_again() {
    const Duration since = Time::now() - tried_;
    if (since < try_again) {
      waker_.sleep(std::min(longest_wait, try_again - since));
      return false;
    }
    const std::optional<CaptureSource::Refused> refused = start();
    if (refused) trouble(words_of(refused->refusal), ": " + refused->why);
    return !refused;
  }

  /// Says what happened once, and shows it until pictures come again.
  void trouble(const char* words, const std::string& line) {
    if (trouble_.exchange(words, std::memory_order_acq_rel) != words) say(line);
  }

  Status lose(const char* words, const std::string& line) {
    session_->stream().stop();
    // Pictures of it may still be shown.
    old_.push_back(std::move(session_));
    trouble(words, line);
    tried_ = {};
    return Status::busy;
  }

  bool take(PictureHandle& picture) {
    fetch();
    while (waiting_count_ > 0) {
      if (make(oldest(), picture)) return true;
    }
    return false;
  }

  /// Of those that wait, which is then one less.
  Capture oldest() {
    const Capture capture = waiting_.front();
    std::shift_left(waiting_.begin(), waiting_.end(), 1);
    --waiting_count_;
    return capture;
  }

  /// What the device has filled; of more than can wait the newest.
  void fetch() {
    while (const auto capture = session_->stream().take()) {
      heard_ = Time::now();
      if (waiting_count_ == waiting_.size()) session_->stream().give(oldest().buffer);
      waiting_[waiting_count_++] = *capture;
    }
  }

  bool make(const Capture& capture, PictureHandle& picture) {
    if (!in_turn(capture)) {
      session_->stream().give(capture.buffer);
      return false;
    }
    const LiveSession::Made made = session_->make(capture, picture, describe(capture));
    if (made == LiveSession::Made::damaged) note_damage();
    if (made != LiveSession::Made::ok) return false;
    damaged_ = 0;
    if (std::string_view(trouble_.exchange("", std::memory_order_acq_rel)) != "") say(" gives pictures again");
    return true;
  }

  /// Counts those that did not come. A picture that comes after a newer one has been counted, and is of no use.
  bool in_turn(const Capture& capture) {
    if (!last_) {
      shift_ = given_ - capture.sequence;
    } else if (capture.sequence <= *last_) {
      return false;
    } else {
      lost_.fetch_add(capture.sequence - *last_ - 1, std::memory_order_relaxed);
    }
    last_ = capture.sequence;
    given_ = capture.sequence + shift_ + 1;
    return true;
  }

  void note_damage() {
    lost_.fetch_add(1, std::memory_order_relaxed);
    if (++damaged_ == damaged_told) trouble(words_damaged, " sends damaged pictures: try another cable or port");
  }

  Picture describe(const Capture& capture) {
    const CaptureFormat& format = session_->format();
    Picture p;
    p.width = format.size.width;
    p.height = format.size.height;
    p.intrinsics = intrinsics_;
    p.sequence = given_ - 1;
    const StampClock::Clock before = clock_.clock();
    const Time stamp = clock_.monotonic(capture.stamp_ns, ClockReading::now());
    if (clock_.clock() != before && clock_.clock() != said_clock_) {
      said_clock_ = clock_.clock();
      say(": " + clock_.words());
    }
    p.exposure =
        exposure_of(stamp, session_->stream().stamped(),
                    capture.exposure.value_or(options_.exposure.value_or(Duration{})), readout_, options_.clock_offset);
    return p;
  }

  std::unique_ptr<CaptureSource> source_;
  const LensSource lens_;
  const Duration readout_;
  const LiveOptions options_;
  Waker waker_;
  std::vector<std::unique_ptr<LiveSession>> old_;  // of which a picture may be held
  std::unique_ptr<LiveSession> session_;
  std::array<Capture, waiting> waiting_{};
  std::size_t waiting_count_ = 0;
  // Its own count of pictures begins anew with each session, and ours goes on: given_ is the next that is expected.
  std::optional<std::uint64_t> last_;
  std::uint64_t given_ = 0, shift_ = 0;
  Intrinsics intrinsics_;
  StampClock clock_;
  StampClock::Clock said_clock_ = StampClock::Clock::unknown;
  Time tried_, heard_;
  int damaged_ = 0;
  std::atomic<const char*> trouble_{""};
  std::atomic<std::uint64_t> lost_{0};
  std::string message_;
};

}  // namespace

std::unique_ptr<Camera> make_live_camera(std::unique_ptr<CaptureSource> source, const LensSource& lens,
                                         Duration readout, const LiveOptions& options) {
  return std::make_unique<LiveCamera>(std::move(source), lens, readout, options);
}

}  // namespace onestroke

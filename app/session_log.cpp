#include "app/session_log.h"

#include "core/error.h"

#include <pthread.h>

#include <chrono>
#include <utility>

namespace onestroke {
namespace {

std::string cannot_be_written(const std::filesystem::path& file) {
  return file.string() +
         " cannot be written; check that its folder exists, that you may write there and that the disk is not full";
}

}  // namespace

SessionLog::SessionLog(std::filesystem::path file, const SessionHeader& header) : file_(std::move(file)) {
  out_.open(file_, std::ios::binary | std::ios::trunc);
  write_line(session_line(header));
  if (!out_.flush()) throw Error(cannot_be_written(file_));
  writer_ = std::jthread([this](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), "session log");
    write_until(stop);
  });
}

SessionLog::~SessionLog() {
  close();
}

void SessionLog::add(const FrameRecord& record, Time now, bool picture, const PictureLens& lens,
                     const SecondLens& second) noexcept {
  const bool added = queue_.push_with([&](SessionFrame& slot) {
    slot.now = now;
    slot.picture = picture;
    copy_record(record, slot.record);
    slot.lens = lens;
    slot.second = second;
    slot.latency = latency_;
    slot.keys = keys_;
    slot.events = events_;
    slot.missed = missed_;
  });
  if (!added) {
    ++missed_;
    return;
  }
  keys_.clear();
  events_.clear();
  missed_ = 0;
}

void SessionLog::close() noexcept {
  if (!writer_.joinable()) return;
  writer_.request_stop();
  writer_.join();
  try {
    if (missed_ > 0 && !failed_) write_line(session_line_missed(missed_));
    out_.close();
    if (!out_) fail();
  } catch (const std::exception&) {
    fail();
  }
}

std::string SessionLog::failure() const {
  return failed_.load(std::memory_order_acquire) ? failure_ : std::string();
}

void SessionLog::write_until(const std::stop_token& stop) noexcept {
  for (;;) {
    // Read before looking: what was added before the end is then certainly written.
    const bool last = stop.stop_requested();
    try {
      queue_.drain([this](const SessionFrame& frame) {
        if (!failed_) write(frame);
      });
      if (!failed_ && !out_.flush()) fail();
    } catch (const std::exception&) {
      fail();
    }
    if (last) return;
    // Short against the time that it takes to fill the queue.
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

void SessionLog::write(const SessionFrame& frame) {
  if (frame.missed > 0) write_line(session_line_missed(frame.missed));
  SessionTexts now{.record = session_text(frame.record), .lens = {}, .second = session_text(frame.second)};
  if (frame.lens.width > 0) now.lens = session_text(frame.lens);
  const auto if_other = [](const std::string& text, const std::string& before) {
    return text == before ? std::string() : text;
  };
  write_line(session_line(frame, {.record = if_other(now.record, written_.record),
                                  .lens = if_other(now.lens, written_.lens),
                                  .second = if_other(now.second, written_.second)}));
  written_ = std::move(now);
}

void SessionLog::write_line(const std::string& line) {
  out_ << line << '\n';
}

void SessionLog::fail() noexcept {
  if (failed_) return;
  try {
    failure_ = "the session's log ends early: " + cannot_be_written(file_);
  } catch (const std::exception&) {
    // Without its words a failure is one all the same.
  }
  failed_.store(true, std::memory_order_release);
}

}  // namespace onestroke

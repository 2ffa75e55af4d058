#include "scripted_head.h"

#include "core/error.h"
#include "scene/frames.h"

#include <arpa/inet.h>
#include <glm/gtc/quaternion.hpp>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace onestroke {

namespace {

constexpr std::uint16_t port = 4242;
constexpr std::chrono::milliseconds between_sends(2);

// How long the service and the display's history may take to notice, and what is a stall.
constexpr Duration looked_round = Duration::from_ms(15), longest_gap = Duration::from_ms(6);

// What Monado 25's service reads (its r_remote_data): a mark, the head, two controllers. All are still where they are
// zero, but for the head's pose: a quaternion x y z w and metres, after those of two eyes that it does not look at.
constexpr std::size_t record_bytes = 376, pose_at = 8 + 96, hands_at = 8 + 128, hand_bytes = 120;
// In a controller's part: its pose, velocities, curls of five fingers, how far the trigger is pulled, then what is not
// used here; flags for a hand and a controller that are there, and of each button whether it is clicked and touched.
constexpr std::size_t curls_at = 52, trigger_at = 72, there_at = 104, b_at = 110, trigger_click_at = 112;

using Record = std::array<char, record_bytes>;

Record record_of(const Pose& T_stage_head) {
  const glm::mat4 m = to_graphics(T_stage_head);
  const glm::quat q = glm::quat_cast(m);
  const std::array<float, 7> pose{q.x, q.y, q.z, q.w, m[3].x, m[3].y, m[3].z};
  Record record{};
  std::memcpy(record.data(), "mndrmt3", 8);
  std::memcpy(record.data() + pose_at, pose.data(), sizeof pose);
  return record;
}

void add_hand(Record& record, std::size_t which, const ScriptedHand& hand) {
  char* const at = record.data() + hands_at + which * hand_bytes;
  const std::array<float, 7> pose{0, 0, 0, 1, which == 0 ? -0.2F : 0.2F, 1.3F, -0.5F};
  std::memcpy(at, pose.data(), sizeof pose);
  std::array<float, 5> curls;
  curls.fill(hand.curl);
  std::memcpy(at + curls_at, curls.data(), sizeof curls);
  const float pulled = hand.trigger ? 1 : 0;
  std::memcpy(at + trigger_at, &pulled, sizeof pulled);
  std::fill_n(at + there_at, 2, char{1});
  std::fill_n(at + b_at, 2, static_cast<char>(hand.b));
  std::fill_n(at + trigger_click_at, 2, static_cast<char>(hand.trigger));
}

int connect_to_service() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw Error("nobody listens to port 4242: start Monado's service with a scripted head");
  const int at_once = 1;
  setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &at_once, sizeof at_once);
  return socket;
}

}  // namespace

ScriptedHead::ScriptedHead(Path path) : path_(std::move(path)), socket_(connect_to_service()) {
  sender_ = std::jthread([this](const std::stop_token& stop) { send(stop); });
}

ScriptedHead::~ScriptedHead() {
  sender_ = {};
  close(socket_);
}

void ScriptedHead::move() {
  const std::scoped_lock lock(mutex_);
  moving_since_ = Time::now();
}

void ScriptedHead::use_hands(const ScriptedHand& left, const ScriptedHand& right) {
  const std::scoped_lock lock(mutex_);
  hands_ = {left, right};
}

void ScriptedHead::set_world(const Pose& T_world_stage) {
  const std::scoped_lock lock(mutex_);
  T_world_stage_ = T_world_stage;
}

void ScriptedHead::send(const std::stop_token& stop) {
  for (; !stop.stop_requested(); std::this_thread::sleep_for(between_sends)) {
    const std::scoped_lock lock(mutex_);
    const Time now = Time::now();
    const Pose pose = path_(moving_since_ ? (now - *moving_since_).seconds() : 0);
    Record record = record_of(pose);
    for (std::size_t i = 0; hands_ && i < hands_->size(); ++i) add_hand(record, i, hands_->at(i));
    // As soon as it is written the service may have it.
    if (::send(socket_, record.data(), record.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(record.size())) return;
    sent_.push_back({Time::now(), pose});
  }
}

bool ScriptedHead::on_time(Time time) const {
  const std::scoped_lock lock(mutex_);
  const auto first = std::ranges::lower_bound(sent_, time - looked_round, {}, &Sent::time);
  const auto end = std::ranges::upper_bound(sent_, time + looked_round, {}, &Sent::time);
  if (first == sent_.begin() || end == sent_.end()) return false;
  return std::adjacent_find(std::prev(first), std::next(end), [](const Sent& a, const Sent& b) {
           return b.time - a.time > longest_gap;
         }) == std::next(end);
}

std::optional<Pose> ScriptedHead::head_at(Time time) const {
  const std::scoped_lock lock(mutex_);
  const auto after = std::ranges::upper_bound(sent_, time, {}, &Sent::time);
  if (after == sent_.begin()) return std::nullopt;
  return T_world_stage_ * std::prev(after)->T_stage_head;
}

}  // namespace onestroke

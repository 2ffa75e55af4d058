#include "app/difference_desk.h"

#include "core/error.h"
#include "scene/difference_map.h"
#include "scene/mesh_levels.h"

#include <pthread.h>

#include <algorithm>
#include <limits>
#include <new>

namespace onestroke {
namespace {

/// Thrown through work that nobody waits for any more.
struct Stopped {};

// An order: from its lowest bit the alignment, the places of the two markers in the catalogue, and a number that is new
// with each order.
constexpr int laid_at = 1, base_at = 17, number_at = 33;
constexpr std::uint64_t place_mask = 0xFFFF;
constexpr std::uint64_t no_place = place_mask;  // as the base's: nothing is wanted
constexpr std::uint64_t stopping = std::numeric_limits<std::uint64_t>::max();

std::uint64_t order_of(std::uint64_t number, std::uint64_t base, std::uint64_t laid, Alignment alignment) {
  return number << number_at | base << base_at | laid << laid_at | static_cast<std::uint64_t>(alignment);
}
std::uint64_t base_of(std::uint64_t order) {
  return order >> base_at & place_mask;
}
std::uint64_t laid_of(std::uint64_t order) {
  return order >> laid_at & place_mask;
}

// How far the work is when both models are loaded, compared, and the map has its levels; the rest is filling memory.
constexpr double loaded = 0.2, compared = 0.85, levelled = 0.95;

// One processor is left to the frames.
int thread_count() {
  return std::max(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1);
}

}  // namespace

DifferenceDesk::DifferenceDesk(const Catalog& catalog, const std::filesystem::path& catalog_file, Renderer& renderer)
    : renderer_(renderer), cache_(difference_folders(catalog_file)) {
  for (const MarkerSpec& marker : catalog.markers) {
    carried_.push_back({.marker_id = marker.id, .name = marker.name, .model = {}});
    if (!marker.model.empty()) carried_.back().model = {catalog_file.parent_path() / marker.model, marker.import};
  }
  shown_.reserve(most_results);
  thread_ = std::jthread([this] { work(); });
}

DifferenceDesk::~DifferenceDesk() {
  ordered_.store(stopping, std::memory_order_release);
  ordered_.notify_one();
}

void DifferenceDesk::request(int base_id, int laid_id, Alignment alignment) {
  take_in();
  const Wish wish{base_id, laid_id, alignment};
  if (wish_ == wish) return;
  wish_ = wish;
  begin(wish);
}

void DifferenceDesk::wait() {
  for (take_in(); state_ == State::working; take_in()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void DifferenceDesk::begin(const Wish& wish) {
  reason_.clear();
  const auto place_of = [this](int id) {
    return static_cast<std::size_t>(std::ranges::find(carried_, id, &Carried::marker_id) - carried_.begin());
  };
  const std::size_t base = place_of(wish.base_id), laid = place_of(wish.laid_id);
  const std::uint64_t number = (order_ >> number_at) + 1;
  order_ = order_of(number, no_place, no_place, {});
  if (find_shown(wish)) {
    state_ = State::ready;
  } else if (std::max(base, laid) >= std::min<std::size_t>(carried_.size(), no_place)) {
    state_ = State::failed;
    reason_ = "a marker is not in the catalogue";
  } else {
    state_ = State::working;
    order_ = order_of(number, base, laid, wish.alignment);
  }
  ordered_.store(order_, std::memory_order_release);
  ordered_.notify_one();
}

bool DifferenceDesk::find_shown(const Wish& wish) {
  const auto found = std::ranges::find(shown_, wish, &Shown::wish);
  if (found == shown_.end()) return false;
  found->used = ++times_;
  at_ = static_cast<std::size_t>(found - shown_.begin());
  return true;
}

void DifferenceDesk::take_in() {
  const std::unique_ptr<Answer> answer = answers_.take();
  if (!answer) return;
  if (answer->reason.empty()) return keep(*answer);
  if (answer->order != order_) return;
  state_ = State::failed;
  reason_ = std::move(answer->reason);
}

// Also what is no longer wanted: it may be again.
void DifferenceDesk::keep(Answer& answer) {
  if (std::ranges::find(shown_, answer.wish, &Shown::wish) != shown_.end()) return;
  auto place = shown_.end();
  if (shown_.size() == most_results) {
    place = std::ranges::min_element(shown_, {}, &Shown::used);
    renderer_.unload(place->result.map);
    if (place->result.veil) renderer_.unload(*place->result.veil);
  } else {
    place = shown_.insert(shown_.end(), Shown{});
  }
  *place = {.wish = answer.wish, .result = answer.result, .used = ++times_};
  place->result.map = renderer_.adopt(std::move(answer.map));
  if (answer.veil) place->result.veil = renderer_.adopt(std::move(answer.veil));
  if (wish_ == answer.wish && find_shown(answer.wish)) state_ = State::ready;
}

int DifferenceDesk::percent() const {
  const std::uint64_t progress = progress_.load(std::memory_order_relaxed);
  return progress >> 8U == order_ << 8U >> 8U ? static_cast<int>(progress & 0xFFU) : 0;
}

void DifferenceDesk::say(Order order, double share) {
  if (ordered_.load(std::memory_order_relaxed) != order) throw Stopped{};
  progress_.store(order << 8U | static_cast<std::uint64_t>(100 * share), std::memory_order_relaxed);
}

void DifferenceDesk::work() {
  // Those that it starts are called alike.
  pthread_setname_np(pthread_self(), "differences");
  for (Order order = 0;;) {
    ordered_.wait(order, std::memory_order_acquire);
    order = ordered_.load(std::memory_order_acquire);
    if (order == stopping) return;
    if (base_of(order) == no_place) continue;
    try {
      answers_.publish(answer(order));
    } catch (const Stopped&) {
      // The next order is there.
    }
  }
}

std::unique_ptr<DifferenceDesk::Answer> DifferenceDesk::answer(Order order) {
  auto answer = std::make_unique<Answer>();
  answer->order = order;
  answer->wish = {carried_[base_of(order)].marker_id, carried_[laid_of(order)].marker_id,
                  static_cast<Alignment>(order & 1U)};
  try {
    compare_models(*answer);
  } catch (const std::bad_alloc&) {
    answer->reason = "not enough memory to compare them";
  } catch (const std::exception& error) {
    answer->reason = error.what();
  }
  return answer;
}

void DifferenceDesk::compare_models(Answer& answer) {
  const Order order = answer.order;
  const auto part = [this, order](double from, double to) {
    return [this, order, from, to](double share) { say(order, from + share * (to - from)); };
  };
  const Carried &base_carried = carried_[base_of(order)], &laid_carried = carried_[laid_of(order)];
  std::erase_if(loaded_,
                [&](const Loaded& one) { return one.wish != base_carried.model && one.wish != laid_carried.model; });
  const auto base = load(base_carried, part(0, loaded / 2)), laid = load(laid_carried, part(loaded / 2, loaded));

  const DifferenceCache::Key key = DifferenceCache::key_of(*laid, *base, answer.wish.alignment);
  say(order, loaded);
  std::optional<ModelDifference> difference = cache_.find(key);
  if (!difference) {
    difference =
        compare(*laid, *base, answer.wish.alignment, {.threads = thread_count(), .progress = part(loaded, compared)});
    cache_.keep(key, *difference);
  }
  answer.result.base_from_laid = difference->base_from_laid;
  answer.result.statistics = difference->statistics;

  Model map = difference_map(*laid, *difference);
  add_levels(map, part(compared, levelled));
  say(order, levelled);
  answer.map = renderer_.prepare(map);
  if (const Model veil = difference_veil(*base, *difference); !veil.indices.empty())
    answer.veil = renderer_.prepare(veil);
}

std::shared_ptr<const ComparedModel> DifferenceDesk::load(const Carried& carried, const LoadProgress& progress) {
  if (!carried.model) throw Error(carried.name + " carries no model");
  const auto known = std::ranges::find_if(loaded_, [&](const Loaded& one) { return one.wish == *carried.model; });
  if (known != loaded_.end()) return known->model;
  try {
    Model model = load_model(carried.model->file, carried.model->import, progress);
    model.name = carried.name;
    loaded_.push_back({*carried.model, std::make_shared<const ComparedModel>(model)});
  } catch (const Error& error) {
    throw Error(without_folder(error.what(), carried.model->file));
  }
  return loaded_.back().model;
}

}  // namespace onestroke

#pragma once

#include "app/difference_cache.h"
#include "app/model_loader.h"
#include "core/latest_exchange.h"
#include "marker/catalog.h"
#include "render/renderer.h"
#include "scene/model_difference.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace onestroke {

/// Works out how the models of two markers differ, and what shows it, on a thread of its own while frames are drawn.
/// All members are for the thread that renders; none of them waits, takes a lock or allocates while nothing new
/// arrives.
class DifferenceDesk {
 public:
  enum class State { none, working, ready, failed };
  struct Result {
    ModelHandle map{};                ///< See difference_map(); in the laid model's frame.
    std::optional<ModelHandle> veil;  ///< See difference_veil(); in the base's frame. None where nothing is to be seen.
    glm::dmat4 base_from_laid{1.0};   ///< Rigid; the models' own frames, graphics axes, metres.
    DifferenceStatistics statistics;
  };
  /// So many results are kept; the one that was not asked for the longest goes first.
  static constexpr std::size_t most_results = 4;

  /// Starts the thread. Model paths that are not absolute start at the catalogue's folder. The renderer outlives this;
  /// the catalogue need not.
  DifferenceDesk(const Catalog& catalog, const std::filesystem::path& catalog_file, Renderer& renderer);
  /// Leaves off in the middle of a comparison; waits for the step it is at. Does not unload what the renderer holds.
  ~DifferenceDesk();
  DifferenceDesk(const DifferenceDesk&) = delete;

  /// Once a frame: what is wanted. What the other members tell is of this. Another wish than the frame before ends the
  /// work on that one where it is not done; one that failed is tried anew.
  void request(int base_id, int laid_id, Alignment alignment);

  /// Waits until what is wanted is ready or has failed: for films.
  void wait();

  State state() const { return state_; }
  /// 0 to 100, while it is working.
  int percent() const;
  /// Null where it is not ready. Stays until the next request().
  const Result* result() const { return state_ == State::ready ? &shown_[at_].result : nullptr; }
  /// Why it failed, for a person; short enough for a label.
  const std::string& reason() const { return reason_; }

 private:
  using Order = std::uint64_t;  // what to work on, in one atomic number; see order_of()

  struct Wish {
    int base_id = 0, laid_id = 0;
    Alignment alignment{};
    bool operator==(const Wish&) const = default;
  };
  struct Carried {
    int marker_id = 0;
    std::string name;
    std::optional<ModelLoader::Wish> model;
  };
  /// From the thread to the one that renders.
  struct Answer {
    Order order = 0;
    Wish wish;
    std::shared_ptr<PreparedModel> map, veil;
    Result result;
    std::string reason;  // of a failure; empty otherwise
  };
  struct Shown {
    Wish wish;
    Result result;
    std::uint64_t used = 0;
  };
  /// A model that the thread has loaded.
  struct Loaded {
    ModelLoader::Wish wish;
    std::shared_ptr<const ComparedModel> model;
  };

  void begin(const Wish& wish);
  void take_in();
  void keep(Answer& answer);
  bool find_shown(const Wish& wish);

  void work();
  std::unique_ptr<Answer> answer(Order order);
  void compare_models(Answer& answer);
  std::shared_ptr<const ComparedModel> load(const Carried& carried, const LoadProgress& progress);
  /// Throws where the order is no longer wanted.
  void say(Order order, double share);

  Renderer& renderer_;
  std::vector<Carried> carried_;
  const DifferenceCache cache_;

  // The render thread's.
  std::optional<Wish> wish_;
  Order order_ = 0;
  State state_ = State::none;
  std::string reason_;
  std::vector<Shown> shown_;
  std::size_t at_ = 0;       // in shown_, where the state is `ready`
  std::uint64_t times_ = 0;  // that a result was asked for

  std::atomic<Order> ordered_{0};
  std::atomic<std::uint64_t> progress_{0};  // the order's lowest bits, then a byte of per cent
  LatestExchange<std::unique_ptr<Answer>> answers_;

  std::vector<Loaded> loaded_;  // the thread's; the last one used is last
  std::jthread thread_;         // last: it uses the rest
};

}  // namespace onestroke

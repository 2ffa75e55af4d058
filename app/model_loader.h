#pragma once

#include "core/model_import.h"
#include "render/renderer.h"
#include "scene/anchor.h"

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace onestroke {

/// What load_model says of a file, short enough for a label: without the file's folder.
std::string without_folder(std::string reason, const std::filesystem::path& file);

/// Loads models on a thread of its own, one after the other, while frames are drawn. What the members tell costs no
/// lock and no memory.
class ModelLoader {
 public:
  struct Wish {
    std::filesystem::path file;
    ModelImport import{};
    bool operator==(const Wish&) const = default;
  };
  struct Loaded {
    std::shared_ptr<PreparedModel> prepared;  ///< For Renderer::adopt.
    Placement placement;
    std::string name;
    std::string size;     ///< "60 × 40 × 25 mm, 1234 triangles".
    bool closed = false;  ///< See SurfaceMeasures.
  };
  enum class State { waiting, loaded, failed };

  /// Starts. The renderer outlives this.
  ModelLoader(std::vector<Wish> wishes, const Renderer& renderer);
  /// Leaves off in the middle of a model; waits for the step it is at.
  ~ModelLoader();

  std::size_t count() const { return jobs_.size(); }
  State state(std::size_t wish) const { return jobs_[wish]->state.load(std::memory_order_acquire); }
  /// 0 to 100, of a waiting one.
  int percent(std::size_t wish) const { return jobs_[wish]->percent.load(std::memory_order_relaxed); }
  /// Of a loaded one, once.
  Loaded take(std::size_t wish) { return std::move(jobs_[wish]->loaded); }
  /// Of a failed one: the Error's message.
  const std::string& reason(std::size_t wish) const { return jobs_[wish]->reason; }

 private:
  // What is not atomic belongs to the thread until the state is no longer `waiting`, and to the owner from then on.
  struct Job {
    Wish wish;
    std::atomic<State> state{State::waiting};
    std::atomic<int> percent{0};
    Loaded loaded;
    std::string reason;
  };

  void work(const std::stop_token& stop);
  static Loaded load(Job& job, const Renderer& renderer, const std::stop_token& stop);

  const Renderer& renderer_;
  std::vector<std::unique_ptr<Job>> jobs_;
  std::jthread thread_;  // last: it uses the rest
};

}  // namespace onestroke

#include "app/model_loader.h"

#include "scene/mesh_levels.h"
#include "scene/model.h"

#include <pthread.h>

namespace onestroke {
namespace {

/// Thrown through a load that nobody waits for any more.
struct Stopped {};

// What has been loaded when the file is read, and when its levels are made; the rest is filling memory.
constexpr double read = 0.4, levelled = 0.9;

}  // namespace

std::string without_folder(std::string reason, const std::filesystem::path& file) {
  if (reason.starts_with(file.string())) reason.replace(0, file.string().size(), file.filename().string());
  return reason;
}

ModelLoader::ModelLoader(std::vector<Wish> wishes, const Renderer& renderer) : renderer_(renderer) {
  for (Wish& wish : wishes) {
    jobs_.push_back(std::make_unique<Job>());
    jobs_.back()->wish = std::move(wish);
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

ModelLoader::~ModelLoader() = default;

void ModelLoader::work(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "models");
  for (const auto& job : jobs_) {
    State state = State::failed;
    try {
      job->loaded = load(*job, renderer_, stop);
      state = State::loaded;
    } catch (const Stopped&) {
      return;
    } catch (const std::exception& error) {
      job->reason = error.what();
    }
    job->state.store(state, std::memory_order_release);
  }
}

ModelLoader::Loaded ModelLoader::load(Job& job, const Renderer& renderer, const std::stop_token& stop) {
  const auto say = [&](double share) {
    if (stop.stop_requested()) throw Stopped{};
    job.percent.store(static_cast<int>(100 * share), std::memory_order_relaxed);
  };
  say(0);
  Model model = load_model(job.wish.file, job.wish.import, [&](double share) { say(share * read); });
  add_levels(model, [&](double share) { say(read + share * (levelled - read)); });
  const Placement placement = place_on_marker(model, job.wish.import.fit);
  say(levelled);
  return {renderer.prepare(model), placement, model.name};
}

}  // namespace onestroke

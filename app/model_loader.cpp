#include "app/model_loader.h"

#include "scene/mesh_levels.h"
#include "scene/model.h"
#include "scene/surface_difference.h"

#include <pthread.h>

#include <array>
#include <cstdio>

namespace onestroke {
namespace {

/// Thrown through a load that nobody waits for any more.
struct Stopped {};

// What has been loaded when the file is read, and when its levels are made; the rest is filling memory.
constexpr double read = 0.4, levelled = 0.9;

std::string size_words(const Model& model) {
  constexpr double millimetres = 1000;
  std::array<double, 3> side{};
  for (std::size_t i = 0; i < side.size(); ++i) side[i] = millimetres * (model.upper[i] - model.lower[i]);
  std::array<char, 128> words{};
  std::snprintf(words.data(), words.size(), "%.4g × %.4g × %.4g mm, %zu triangles", side[0], side[1], side[2],
                model.indices.size() / 3);
  return words.data();
}

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
  Loaded loaded{.prepared = {},
                .placement = place_on_marker(model, job.wish.import.fit),
                .name = model.name,
                .size = size_words(model)};
  loaded.closed = measure({model.vertices, model.indices}).closed;
  add_levels(model, [&](double share) { say(read + share * (levelled - read)); });
  say(levelled);
  loaded.prepared = renderer.prepare(model);
  return loaded;
}

}  // namespace onestroke

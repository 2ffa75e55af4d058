#include "app/model_shelf.h"

#include "app/model_card.h"
#include "app/rod_mesh.h"
#include "core/error.h"

#include <algorithm>
#include <thread>

namespace onestroke {
namespace {

std::vector<Vec3> ring_middles(const Shape& shape) {
  std::vector<Vec3> middles;
  for (int i = 0; i < shape.cells(); ++i) middles.push_back(shape.at((i + 0.5) * shape.pitch()).position);
  return middles;
}

/// A stroke's corner is its middle one, a straight one's its middle.
StickPoints touch_points(const Shape& shape) {
  const std::vector<Vec3>& corners = shape.vertices();
  const Vec3 middle = corners.size() > 2 ? corners[corners.size() / 2] : 0.5 * (corners.front() + corners.back());
  return {corners.front(), middle, corners.back()};
}

/// "bracket_v1" is "bracket v1" to a person.
bool same_words(std::string a, std::string b) {
  std::ranges::replace(a, '_', ' ');
  std::ranges::replace(b, '_', ' ');
  return a == b;
}

}  // namespace

ModelShelf::ModelShelf(const Catalog& catalog, const std::filesystem::path& folder, Renderer& renderer)
    : renderer_(renderer) {
  std::vector<ModelLoader::Wish> wishes;
  for (const MarkerSpec& marker : catalog.markers) {
    entries_.push_back({.marker_id = marker.id,
                        .model = {},
                        .card = model_card(marker),
                        .corners = marker.shape.vertices(),
                        .cells = ring_middles(marker.shape),
                        .radius = marker.shape.radius(),
                        .rod = renderer.load(rod_mesh(marker.shape))});
    carried_.push_back({.marker_id = marker.id, .points = touch_points(marker.shape)});
    names_.push_back(marker.name);
    if (marker.model.empty()) continue;
    const ModelLoader::Wish wish{folder / marker.model, marker.import};
    const auto at = static_cast<std::size_t>(std::ranges::find(wishes, wish) - wishes.begin());
    if (at == wishes.size()) {
      wishes.push_back(wish);
      files_.push_back(wish.file);
      wished_.emplace_back();
    }
    wished_[at].entries.push_back(entries_.size() - 1);
  }
  waiting_ = wishes.size();
  if (!wishes.empty()) loader_.emplace(std::move(wishes), renderer);
  update();
}

void ModelShelf::update() {
  for (std::size_t wish = 0; waiting_ > 0 && wish < wished_.size(); ++wish)
    if (!wished_[wish].settled) settle(wish);
}

void ModelShelf::settle(std::size_t wish) {
  const ModelLoader::State state = loader_->state(wish);
  if (state == ModelLoader::State::waiting) {
    for (const std::size_t entry : wished_[wish].entries)
      carried_[entry].words.print("loading %d %%", loader_->percent(wish));
    return;
  }
  wished_[wish].settled = true;
  --waiting_;
  if (state == ModelLoader::State::loaded)
    take_in(wish);
  else
    give_up(wish);
}

void ModelShelf::take_in(std::size_t wish) {
  ModelLoader::Loaded loaded = loader_->take(wish);
  const ModelHandle handle = renderer_.adopt(std::move(loaded.prepared));
  for (const std::size_t entry : wished_[wish].entries) {
    entries_[entry].model = handle;
    entries_[entry].placement = loaded.placement;
    entries_[entry].closed = loaded.closed;
    entries_[entry].card += "\n" + loaded.size;
    carried_[entry].pivot = loaded.placement.pivot;
    carried_[entry].reach = loaded.placement.reach;
    carried_[entry].marker_from_model = loaded.placement.marker_from_model;
    carried_[entry].words = Text(same_words(loaded.name, names_[entry]) ? "" : loaded.name);
  }
}

void ModelShelf::give_up(std::size_t wish) {
  const std::string& reason = loader_->reason(wish);
  for (const std::size_t entry : wished_[wish].entries) {
    carried_[entry].words = Text(without_folder(reason, files_[wish]));
    if (failure_.empty())
      failure_ = "marker " + std::to_string(entries_[entry].marker_id) + " (" + names_[entry] + "): " + reason;
  }
}

void ModelShelf::wait(const std::function<void(const std::string&)>& say) {
  for (update(); waiting_ > 0 && failure_.empty(); update()) {
    if (say) say("loading models, " + std::to_string(percent()) + " %");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  if (!failure_.empty()) throw Error(failure_);
}

int ModelShelf::percent() const {
  int sum = 0;
  for (std::size_t wish = 0; wish < wished_.size(); ++wish) sum += wished_[wish].settled ? 100 : loader_->percent(wish);
  return sum / static_cast<int>(wished_.size());
}

const ShelfEntry* ModelShelf::find(int marker_id) const {
  const auto at = std::ranges::find(entries_, marker_id, &ShelfEntry::marker_id);
  return at == entries_.end() ? nullptr : &*at;
}

}  // namespace onestroke

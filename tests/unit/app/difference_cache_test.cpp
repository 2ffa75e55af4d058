#include "app/difference_cache.h"

#include "../core/full_disk.h"
#include "../core/scratch_folder.h"
#include "core/error.h"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>
#include <random>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

using Key = DifferenceCache::Key;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

ModelDifference some_difference() {
  std::mt19937 random(1);
  std::normal_distribution<float> distance(0, 1e-3F);
  ModelDifference d;
  for (int i = 0; i < 1000; ++i) d.laid.push_back(distance(random));
  for (int i = 0; i < 500; ++i) d.base.push_back(distance(random));
  d.base_from_laid[3] = {0.1, 0.2, 0.3, 1};
  d.base_from_laid[0][1] = 0.25;
  d.statistics = {.mean = 0.1,
                  .rms = 0.2,
                  .p95 = 0.3,
                  .most = 0.4,
                  .reach = 0.5,
                  .laid = {.area = 1, .volume = 2, .closed = true},
                  .base = {.area = 3, .volume = 4, .closed = false},
                  .fit_rms = 0.6,
                  .moved = 0.7,
                  .turned_deg = 0.8};
  return d;
}

constexpr Key some_key{.laid_sum = 12, .base_sum = 34, .laid_count = 1000, .base_count = 500};

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), sizeof(float) * a.size()) == 0;
}

void expect_same(const std::optional<ModelDifference>& found, const ModelDifference& kept) {
  ASSERT_TRUE(found);
  EXPECT_TRUE(same_bytes(found->laid, kept.laid));
  EXPECT_TRUE(same_bytes(found->base, kept.base));
  EXPECT_EQ(found->base_from_laid, kept.base_from_laid);
  const DifferenceStatistics &a = found->statistics, &b = kept.statistics;
  EXPECT_THAT((std::array{a.mean, a.rms, a.p95, a.most, a.reach, a.fit_rms, a.moved, a.turned_deg}),
              testing::ElementsAre(b.mean, b.rms, b.p95, b.most, b.reach, b.fit_rms, b.moved, b.turned_deg));
  EXPECT_THAT((std::array{a.laid.area, a.laid.volume, a.base.area, a.base.volume}),
              testing::ElementsAre(b.laid.area, b.laid.volume, b.base.area, b.base.volume));
  EXPECT_EQ(a.laid.closed, b.laid.closed);
  EXPECT_EQ(a.base.closed, b.base.closed);
}

class Cache : public testing::Test {
 protected:
  fs::path kept() const { return folder_ / "catalog.json.differences"; }
  /// All that lies in the folder.
  std::vector<fs::path> files() const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(kept())) all.push_back(entry.path());
    return all;
  }

  const ScratchFolder scratch_;
  const fs::path folder_ = scratch_.path();
};

TEST_F(Cache, GivesBackWhatWasKeptByteByByte) {
  const DifferenceCache cache({kept()});
  EXPECT_FALSE(cache.find(some_key)) << "nor does it mind that there is no folder";
  ASSERT_TRUE(cache.keep(some_key, some_difference()));
  expect_same(cache.find(some_key), some_difference());
  expect_same(DifferenceCache({kept()}).find(some_key), some_difference());
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(Cache, TellsPairsApart) {
  const DifferenceCache cache({kept()});
  ASSERT_TRUE(cache.keep(some_key, some_difference()));
  Key other = some_key;
  other.alignment = Alignment::best_fit;
  EXPECT_FALSE(cache.find(other));
  other = some_key;
  std::swap(other.laid_sum, other.base_sum);
  EXPECT_FALSE(cache.find(other));
  other = some_key;
  ++other.laid_count;
  EXPECT_FALSE(cache.find(other)) << "the same models refined otherwise";
}

TEST_F(Cache, IgnoresWhatIsDamagedAndReplacesIt) {
  const DifferenceCache cache({kept()});
  ASSERT_TRUE(cache.keep(some_key, some_difference()));
  const fs::path file = files().front();
  const std::string whole = read(file);
  std::vector<std::string> bad{"",
                               "something else",
                               whole.substr(0, whole.size() - 1),
                               whole.substr(0, 40),
                               whole + "more",
                               std::string(whole.size(), 'x')};
  for (const std::size_t at : {std::size_t{7}, std::size_t{50}, std::size_t{100}, whole.size() - 1}) {
    bad.push_back(whole);
    bad.back()[at] = static_cast<char>(bad.back()[at] ^ 1);
  }
  for (std::size_t i = 0; i < bad.size(); ++i) {
    write(file, bad[i]);
    EXPECT_FALSE(cache.find(some_key)) << i;
    EXPECT_TRUE(cache.keep(some_key, some_difference()));
    EXPECT_EQ(read(file), whole) << i;
  }
  fs::remove(file);
  fs::create_directory(file);
  EXPECT_FALSE(cache.find(some_key)) << "a folder of its name";
}

TEST_F(Cache, WritesElsewhereWhereTheFolderCannotBeWrittenTo) {
  // Not even root can make a folder below a file.
  write(folder_ / "file", "");
  const fs::path barred = folder_ / "file" / "differences";
  const DifferenceCache cache({barred, kept()});
  ASSERT_TRUE(cache.keep(some_key, some_difference()));
  EXPECT_EQ(files().size(), 1U);
  expect_same(cache.find(some_key), some_difference());
  const DifferenceCache none({barred});
  EXPECT_FALSE(none.keep(some_key, some_difference()));
  EXPECT_FALSE(none.find(some_key));
  EXPECT_FALSE(DifferenceCache({}).keep(some_key, some_difference()));
}

TEST_F(Cache, LeavesNothingBehindWhereThereIsNoRoom) {
  const DifferenceCache cache({kept()});
  fs::create_directory(kept());
  {
    const FullDisk full(2000);
    EXPECT_FALSE(cache.keep(some_key, some_difference()));
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(Cache, KnowsAModelByWhatItIs) {
  const auto triangle = [](float size) {
    Model model;
    for (const auto& p : {std::array{0.0F, 0.0F, 0.0F}, std::array{size, 0.0F, 0.0F}, std::array{0.0F, size, 0.0F}})
      model.vertices.push_back({.position = p, .normal = {0, 0, 1}, .tangent = {}, .uv = {}, .color = {}});
    model.indices = {0, 1, 2};
    model.parts.push_back({.first_index = 0, .index_count = 3});
    model.materials.emplace_back();
    return ComparedModel(model);
  };
  const ComparedModel one = triangle(1), larger = triangle(1.001F);
  const Key key = DifferenceCache::key_of(one, larger, Alignment::own_frames);
  EXPECT_EQ(key.laid_sum, one.sum);
  EXPECT_EQ(key.base_sum, larger.sum);
  EXPECT_NE(one.sum, larger.sum);
  EXPECT_EQ(key.laid_count, one.refined.vertices.size());
}

TEST(DifferenceFolders, AreBesideTheCatalogueAndInTheUsersCache) {
  const char* variable = std::getenv("XDG_CACHE_HOME");
  const std::string before = variable ? variable : "";
  setenv("XDG_CACHE_HOME", "/caches", 1);
  EXPECT_THAT(difference_folders("/parts/catalog.db"),
              testing::ElementsAre("/parts/catalog.db.differences", "/caches/onestroke/differences"));
  variable ? setenv("XDG_CACHE_HOME", before.c_str(), 1) : unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace onestroke

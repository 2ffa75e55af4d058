// The pipelines kept on disk: what is read back, and that no state of the disk ever stops the program.
#include "../core/full_disk.h"
#include "render/device.h"
#include "render/pipeline_cache_file.h"
#include "render/renderer.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <fstream>

namespace onestroke {
namespace {

namespace fs = std::filesystem;

const PipelineCacheKey key{.vendor = 0x10005, .device = 7, .driver = 22, .uuid = {1, 2, 3, 0xAB}};

/// What a driver gives: Vulkan's header and some bytes of its own.
std::vector<std::byte> data_of(const PipelineCacheKey& owner, std::size_t bytes) {
  VkPipelineCacheHeaderVersionOne head{.headerSize = sizeof head,
                                       .headerVersion = VK_PIPELINE_CACHE_HEADER_VERSION_ONE,
                                       .vendorID = owner.vendor,
                                       .deviceID = owner.device,
                                       .pipelineCacheUUID = {}};
  std::copy(owner.uuid.begin(), owner.uuid.end(), std::begin(head.pipelineCacheUUID));
  std::vector<std::byte> data(sizeof head + bytes, std::byte{0x5A});
  std::memcpy(data.data(), &head, sizeof head);
  return data;
}

class PipelineCacheFile : public testing::Test {
 protected:
  const fs::path folder = fs::path(testing::TempDir()) / ("pipelines_" + std::to_string(::getpid()));
  const fs::path file = folder / pipeline_cache_name(key);
  const std::vector<std::byte> data = data_of(key, 200);

  ~PipelineCacheFile() override { fs::remove_all(folder); }

  std::string bytes() const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& text) const {
    fs::create_directories(folder);
    std::ofstream(file, std::ios::binary) << text;
  }
  std::ptrdiff_t files() const { return std::distance(fs::directory_iterator(folder), {}); }
  bool nothing_read() const { return read_pipeline_cache(file, key).empty(); }
};

TEST_F(PipelineCacheFile, GivesBackWhatWasWritten) {
  ASSERT_TRUE(write_pipeline_cache(file, key, data));
  EXPECT_EQ(read_pipeline_cache(file, key), data);
  const auto more = data_of(key, 5000);
  ASSERT_TRUE(write_pipeline_cache(file, key, more));
  EXPECT_EQ(read_pipeline_cache(file, key), more);
  EXPECT_EQ(files(), 1) << "nothing is left beside it";
}

TEST_F(PipelineCacheFile, IsNamedByItsDriver) {
  EXPECT_EQ(pipeline_cache_name(key), "pipelines-00010005-00000007-00000016-010203ab000000000000000000000000.bin");
}

TEST_F(PipelineCacheFile, IsNotReadWhereItIsMissing) {
  EXPECT_TRUE(nothing_read());
}

TEST_F(PipelineCacheFile, IsNotReadWhereItIsDamaged) {
  ASSERT_TRUE(write_pipeline_cache(file, key, data));
  const std::string whole = bytes();
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{5}, std::size_t{40}, whole.size() / 2, whole.size() - 1}) {
    put(whole.substr(0, length));
    EXPECT_TRUE(nothing_read()) << length;
  }
  put(whole + "more");
  EXPECT_TRUE(nothing_read());
  // Any byte that is not what it was.
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string other = whole;
    other[at] = static_cast<char>(other[at] ^ 0x10);
    put(other);
    EXPECT_TRUE(nothing_read()) << at;
  }
  put(whole);
  EXPECT_EQ(read_pipeline_cache(file, key), data);
}

TEST_F(PipelineCacheFile, IsNotReadForAnotherDriver) {
  ASSERT_TRUE(write_pipeline_cache(file, key, data));
  PipelineCacheKey other = key;
  other.driver = 23;
  EXPECT_TRUE(read_pipeline_cache(file, other).empty());
  for (auto change : {&PipelineCacheKey::vendor, &PipelineCacheKey::device}) {
    other = key;
    other.*change += 1;
    EXPECT_TRUE(read_pipeline_cache(file, other).empty());
  }
  other = key;
  other.uuid[15] = 1;
  EXPECT_TRUE(read_pipeline_cache(file, other).empty());
}

TEST_F(PipelineCacheFile, IsNotReadWhereItIsNoFile) {
  fs::create_directories(file);
  EXPECT_TRUE(nothing_read());
  EXPECT_FALSE(write_pipeline_cache(file, key, data)) << "a folder is in the way";
  EXPECT_EQ(files(), 1);
  fs::remove(file);
  // Whoever opens a pipe waits for its other end.
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_TRUE(nothing_read());
}

TEST_F(PipelineCacheFile, IsNotReadWhereItMayNotBe) {
  ASSERT_TRUE(write_pipeline_cache(file, key, data));
  fs::permissions(file, fs::perms::none);
  const bool root = geteuid() == 0;  // may read everything
  EXPECT_EQ(nothing_read(), !root);
}

TEST_F(PipelineCacheFile, IsNotWrittenWhereThereIsNoFolderToBeHad) {
  fs::create_directories(folder);
  std::ofstream(folder / "file") << "in the way";
  EXPECT_FALSE(write_pipeline_cache(folder / "file" / "below" / "x.bin", key, data));
  // Nobody, not even root, makes anything there.
  EXPECT_FALSE(write_pipeline_cache("/proc/onestroke/x.bin", key, data));
  EXPECT_FALSE(write_pipeline_cache("/proc/x.bin", key, data));
}

TEST_F(PipelineCacheFile, StaysAsItWasWhereTheDiskIsFull) {
  ASSERT_TRUE(write_pipeline_cache(file, key, data));
  {
    const FullDisk disk(400);
    EXPECT_FALSE(write_pipeline_cache(file, key, data_of(key, 2000)));
  }
  EXPECT_EQ(read_pipeline_cache(file, key), data);
  EXPECT_EQ(files(), 1) << "half a file is not left behind";
}

class GpuCache : public PipelineCacheFile {
 protected:
  /// What one run of the program does; true where it could draw.
  static bool run(const fs::path& where) {
    Gpu gpu({.cache_folder = where});
    const Renderer renderer(gpu);
    return renderer.failure().empty();
  }
  fs::path only_file() const { return *fs::directory_iterator(folder); }
};

TEST_F(GpuCache, IsWrittenAtTheEndAndTakenAtTheNextStart) {
  ASSERT_TRUE(run(folder));
  ASSERT_EQ(files(), 1);
  EXPECT_TRUE(only_file().filename().string().starts_with("pipelines-"));
  const auto written = fs::last_write_time(only_file());
  std::atomic<int> messages{0};
  {
    // Validation hears of a cache that is not one.
    Gpu gpu({.validation = true, .validation_messages = &messages, .cache_folder = folder});
    const Renderer renderer(gpu);
    EXPECT_FALSE(gpu.device()->pipeline_cache().getData().empty());
  }
  EXPECT_EQ(messages, 0);
  EXPECT_EQ(fs::last_write_time(only_file()), written) << "nothing new, so nothing is written";
}

TEST_F(GpuCache, IsMadeAnewWhereItIsDamaged) {
  ASSERT_TRUE(run(folder));
  const fs::path kept = only_file();
  std::ifstream in(kept, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  std::ofstream(kept, std::ios::binary) << "damaged";
  ASSERT_TRUE(run(folder));
  // Not every driver's cache is as long each time.
  EXPECT_GT(fs::file_size(kept), whole.size() / 2);
}

TEST_F(GpuCache, IsDoneWithoutWhereItCannotBe) {
  EXPECT_TRUE(run(""));
  EXPECT_TRUE(run("/proc/onestroke"));
  fs::create_directories(folder);
  std::ofstream(folder / "file") << "in the way";
  EXPECT_TRUE(run(folder / "file"));
  const FullDisk disk(1);
  EXPECT_TRUE(run(folder / "full"));
  EXPECT_TRUE(fs::is_empty(folder / "full"));
}

}  // namespace
}  // namespace onestroke

#pragma once

#include "app/session_log.h"
#include "app/session_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace onestroke::test {

/// Doubles of every kind: any bits but those of no number, which have no one form; and zeros of either sign.
class AnyDoubles {
 public:
  explicit AnyDoubles(unsigned seed) : bits_(seed) {}

  double operator()() {
    if (bits_() % 8 == 0) return bits_() % 2 == 0 ? 0.0 : -0.0;
    const double value = std::bit_cast<double>(bits_());
    return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
  }
  Vec3 vector() { return {(*this)(), (*this)(), (*this)()}; }
  Pose pose() { return {{(*this)(), (*this)(), (*this)(), (*this)()}, vector()}; }
  std::uint64_t bits() { return bits_(); }

 private:
  std::mt19937_64 bits_;
};

inline FrameRecord any_record(AnyDoubles& any, int markers) {
  FrameRecord record;
  record.sequence = any.bits();
  record.time.ns = static_cast<std::int64_t>(any.bits());
  record.cost.ns = static_cast<std::int64_t>(any.bits());
  record.T_world_camera = any.pose();
  record.marker_count = markers;
  for (int i = 0; i < markers; ++i) {
    MarkerObservation& m = record.markers[static_cast<std::size_t>(i)];
    m.id = static_cast<int>(any.bits() % 1000);
    const std::string name = "Größe \"" + std::to_string(m.id) + "\"";
    std::ranges::copy(name, m.name.begin());
    m.state = static_cast<MarkerState>(any.bits() % 3);
    m.T_camera_marker = any.pose();
    for (double& c : m.covariance) c = any();
    m.velocity = {any.vector(), any.vector()};
    m.second_cells = any.bits();
    m.cells_seen = static_cast<int>(any.bits() % (max_cells_per_marker + 1));
    for (int c = 0; c < m.cells_seen; ++c)
      m.cells[static_cast<std::size_t>(c)] = {static_cast<int>(any.bits() % 64), any(), any()};
  }
  return record;
}

/// The bits of what is used of a record, so that -0 differs from 0.
inline std::vector<std::uint64_t> bits_of(const FrameRecord& record) {
  std::vector<std::uint64_t> bits;
  const auto add = [&](double v) { bits.push_back(std::bit_cast<std::uint64_t>(v)); };
  const auto add_vector = [&](Vec3 v) { add(v.x), add(v.y), add(v.z); };
  const auto add_pose = [&](const Pose& p) {
    add(p.rotation.w), add_vector({p.rotation.x, p.rotation.y, p.rotation.z}), add_vector(p.translation);
  };
  bits = {record.sequence, static_cast<std::uint64_t>(record.time.ns), static_cast<std::uint64_t>(record.cost.ns),
          static_cast<std::uint64_t>(record.marker_count)};
  add_pose(record.T_world_camera);
  for (const MarkerObservation& m : record.seen()) {
    for (const int n : {m.id, static_cast<int>(m.state), m.cells_seen}) bits.push_back(static_cast<std::uint64_t>(n));
    for (const char c : m.name) bits.push_back(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
    bits.push_back(m.second_cells);
    add_pose(m.T_camera_marker);
    add_vector(m.velocity.angular), add_vector(m.velocity.linear);
    for (const double c : m.covariance) add(c);
    for (int i = 0; i < m.cells_seen; ++i) {
      const CellCentre& cell = m.cells[static_cast<std::size_t>(i)];
      bits.push_back(static_cast<std::uint64_t>(cell.index));
      add(cell.u), add(cell.v);
    }
  }
  return bits;
}

/// A folder of the test's own.
class FolderTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "onestroke-session-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
    file = folder / "session.jsonl";
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::string content() const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string& text) const { std::ofstream(file, std::ios::binary) << text; }

  std::filesystem::path folder, file;
};

}  // namespace onestroke::test

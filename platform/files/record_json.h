#pragma once

#include "core/error.h"
#include "core/frame_record.h"
#include "core/picture.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>

namespace onestroke {

/// Poses, lenses and what was tracked, as files have them. Numbers read back bit for bit, and what is no number is a
/// text ("nan", "inf", "-inf"). What reads throws Error, or the library's own exception, where a value is not as it
/// must be.
using Json = nlohmann::ordered_json;

Json real_value(double value);
double real_of(const Json& value);

template <typename Numbers>
Json reals_value(const Numbers& numbers) {
  Json list = Json::array();
  for (const double n : numbers) list.push_back(real_value(n));
  return list;
}
/// Fills `numbers`, of which the list must have as many.
void read_reals(const Json& list, std::span<double> numbers);
template <std::size_t N>
std::array<double, N> reals_of(const Json& list) {
  std::array<double, N> numbers{};
  read_reals(list, numbers);
  return numbers;
}

/// [x, y, z]
Json vector_value(Vec3 v);
/// [w, x, y, z, x, y, z]: quaternion, translation in mm.
Json pose_value(const Pose& pose);
/// As it was written, bit for bit.
Pose pose_of(const Json& list);
/// From another program or a person: its quaternion must be near a unit one, and is made one.
Pose unit_pose_of(const Json& list);
/// [x, y, z, x, y, z]: rad/s, mm/s.
Json velocity_value(const Velocity& velocity);
Velocity velocity_of(const Json& list);

const char* word_of(MarkerState state);

/// {"sequence", "time_ns", "T_world_camera", "cost_ns", "markers": [{"id", "name", "state", "T_camera_marker",
/// "velocity", "covariance", "cells": [[index, u, v], ...]}]}, and "second_cells" of a pair
Json record_value(const FrameRecord& record);
/// Leaves `tracked` as it was.
void read_record(const Json& value, FrameRecord& record);

/// {"width", "height", "matrix": [fx, fy, cx, cy], "distortion": [k1, k2, p1, p2, k3]}
Json lens_value(const PictureLens& lens);
void read_lens(const Json& value, PictureLens& lens);

/// One line, without its end, or with an indent many. Bytes that are no UTF-8 are replaced.
std::string text_of(const Json& value, int indent = -1);

/// What `read` returns; the library's messages become Errors without their own numbers.
template <typename Read>
auto reading(const Read& read) {
  try {
    return read();
  } catch (const Json::exception& error) {
    std::string what = error.what();
    what.erase(0, std::min(what.size(), what.find("] ") + 2));
    throw Error(what);
  }
}

}  // namespace onestroke

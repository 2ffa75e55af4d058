#include "app/snapshot_numbers.h"

#include "files/record_json.h"

#include <algorithm>

namespace onestroke {
namespace {

Json numbers(Vec3 v) {
  return {v.x, v.y, v.z};
}

Json pose_of(const Similarity& s) {
  Json pose{{"R", to_matrix(s.rotation)}, {"t", numbers(s.translation)}};
  if (s.scale != 1) pose["scale"] = s.scale;
  return pose;
}

Json model_of(const MarkerSpec& marker) {
  Json model{{"file", marker.model}};
  if (!marker.model_name.empty()) model["name"] = marker.model_name;
  if (!marker.version.empty()) model["version"] = marker.version;
  for (const ModelNote& note : marker.notes) model["notes"][note.first] = note.second;
  return model;
}

Json stick_of(const Catalog& catalog, const FrameRecord& record, const HandView& hand) {
  Json stick{{"id", hand.marker_id}};
  if (const MarkerSpec* marker = catalog.find(hand.marker_id)) {
    stick["name"] = marker->name;
    if (!marker->model.empty()) stick["model"] = model_of(*marker);
  }
  stick["state"] = word_of(hand.state);
  const auto seen = std::ranges::find(record.seen(), hand.marker_id, &MarkerObservation::id);
  if (hand.state != MarkerState::lost && seen != record.seen().end())
    stick["stick"] = pose_of(Similarity(record.T_world_camera * seen->T_camera_marker));
  stick["shown"] = pose_of(hand.world_from_marker);
  stick["frozen"] = hand.frozen;
  if (hand.cut) stick["cut"] = {{"normal", numbers(hand.cut->normal)}, {"offset_mm", hand.cut->offset}};
  return stick;
}

Json measured(const MeasureView& m) {
  Json points = Json::array();
  for (int i = 0; i < m.count; ++i) points.push_back(numbers(m.points_world[static_cast<std::size_t>(i)]));
  Json json{{"points_world", points}};
  if (m.count >= 2) json["distance_mm"] = m.distance;
  if (m.count == 3) json["second_distance_mm"] = m.distance_2, json["angle_deg"] = m.angle_deg;
  return json;
}

Json surface_of(const SurfaceMeasures& s) {
  Json json{{"area_mm2", s.area}, {"closed", s.closed}};
  if (s.closed) json["volume_mm3"] = s.volume;
  return json;
}

Json difference_of(const DifferenceStatistics& d) {
  Json json{{"mean_mm", d.mean},
            {"rms_mm", d.rms},
            {"p95_mm", d.p95},
            {"max_mm", d.most},
            {"area_change_mm2", d.area_change()}};
  if (d.laid.closed && d.base.closed) json["volume_change_mm3"] = d.volume_change();
  json["laid"] = surface_of(d.laid);
  json["base"] = surface_of(d.base);
  if (d.fit_rms > 0) json["best_fit"] = {{"rms_mm", d.fit_rms}, {"moved_mm", d.moved}, {"turned_deg", d.turned_deg}};
  return json;
}

}  // namespace

std::string snapshot_numbers(const Catalog& catalog, const FrameRecord& record, const ComparisonView& compared,
                             const DifferenceStatistics* difference) {
  Json json{{"time_ns", record.time.ns},
            {"sequence", record.sequence},
            {"mode", {{"link", name_of(compared.mode.link)}, {"tool", name_of(compared.mode.tool)}}},
            {"T_world_camera", pose_of(Similarity(record.T_world_camera))}};
  for (const Hand h : both_hands)
    if (compared[h].opacity > 0) json[name_of(h)] = stick_of(catalog, record, compared[h]);
  if (compared.both_visible) {
    const RelativePose& r = compared.relative;
    json["right_to_left"] = {{"angle_deg", r.angle_deg},
                             {"axis", numbers(r.axis)},
                             {"rotation_xyz_deg", numbers(r.euler_deg)},
                             {"distance_mm", r.distance}};
  }
  if (compared.mode.laid_over()) json["base"] = name_of(compared.base);
  if (compared.mode.tool == Tool::section) json["cutting_hand"] = name_of(compared.pointer);
  if (compared.measure.count > 0) json["measured"] = measured(compared.measure);
  if (difference) json["difference"] = difference_of(*difference);
  return text_of(json, 2) + "\n";
}

}  // namespace onestroke

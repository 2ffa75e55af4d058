#include "scene/model_difference.h"

#include "core/error.h"
#include "core/kept_file.h"
#include "scene/best_fit.h"
#include "scene/color_scale.h"
#include "scene/frames.h"
#include "scene/mesh_refinement.h"
#include "scene/mesh_weld.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace onestroke {
namespace {

// Of the model's size.
constexpr double longest_edge = 0.012;
// What is less than so much of the model's size is as good as nothing: files are no more exact.
constexpr double least_reach = 1e-4;

// Shares of the time.
constexpr double fitted = 0.1, laid_measured = 0.55;

Surface bare_surface(const Model& model) {
  Surface all{model.vertices, {}};
  for (ModelVertex& v : all.vertices) v.tangent = {}, v.uv = {}, v.color = {1, 1, 1, 1};
  for (const ModelPart& part : model.parts)
    all.indices.insert(all.indices.end(), model.indices.begin() + part.first_index,
                       model.indices.begin() + part.first_index + part.index_count);
  drop_empty_triangles(all);
  weld(all);
  return all;
}

SurfaceMeasures in_millimetres(const SurfaceMeasures& metres) {
  constexpr double mm = 1 / metres_per_millimetre;
  return {.area = metres.area * mm * mm, .volume = metres.volume * mm * mm * mm, .closed = metres.closed};
}

double angle_of(const glm::dmat4& m) {
  const glm::dvec3 twice_sine(m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]);
  return std::atan2(glm::length(twice_sine), m[0][0] + m[1][1] + m[2][2] - 1);
}

void lay(const ComparedModel& laid, const ComparedModel& base, ModelDifference& difference) {
  const BestFit fit = best_fit(laid.surface, base.surface);
  difference.base_from_laid = fit.other_from_own;
  const glm::dvec3 moved(fit.other_from_own * glm::dvec4(laid.middle, 1.0));
  DifferenceStatistics& s = difference.statistics;
  s.fit_rms = fit.rms / metres_per_millimetre;
  s.moved = glm::distance(moved, laid.middle) / metres_per_millimetre;
  s.turned_deg = angle_of(fit.other_from_own) * 180 / std::numbers::pi;
}

void fill_statistics(const SurfaceDifference& from_laid, double size, DifferenceStatistics& s) {
  s.mean = from_laid.mean / metres_per_millimetre;
  s.rms = from_laid.rms / metres_per_millimetre;
  s.p95 = from_laid.p95 / metres_per_millimetre;
  s.most = from_laid.most / metres_per_millimetre;
  s.laid = in_millimetres(from_laid.own);
  s.base = in_millimetres(from_laid.other);
  const double least = ColorScale::for_distances(size * least_reach / metres_per_millimetre, 0).reach();
  s.reach = ColorScale::for_distances(s.p95, least).reach();
}

}  // namespace

ComparedModel::ComparedModel(const Model& model)
    : name(model.name),
      surface(bare_surface(model)),
      double_sided(std::ranges::any_of(model.materials, &ModelMaterial::double_sided)) {
  if (surface.indices.empty()) throw Error(name + " has no surface");
  glm::dvec3 lower(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const ModelVertex& v : surface.vertices) {
    lower = glm::min(lower, glm::dvec3(glm::make_vec3(v.position.data())));
    upper = glm::max(upper, glm::dvec3(glm::make_vec3(v.position.data())));
  }
  middle = (lower + upper) / 2.0;
  size = glm::distance(lower, upper);
  refined = refine(surface, {.longest_edge = longest_edge * size});
  sum = sum_of(std::as_bytes(std::span(surface.indices)), sum_of(std::as_bytes(std::span(surface.vertices))));
}

ModelDifference compare(const ComparedModel& laid, const ComparedModel& base, Alignment alignment,
                        const DifferenceOptions& options) {
  const auto within = [&options](double from, double to) {
    DifferenceOptions part = options;
    if (options.progress)
      part.progress = [&options, from, to](double share) { options.progress(from + share * (to - from)); };
    return part;
  };
  ModelDifference difference;
  if (options.progress) options.progress(0);
  if (alignment == Alignment::best_fit) lay(laid, base, difference);
  const glm::dmat4& base_from_laid = difference.base_from_laid;
  SurfaceDifference from_laid =
      measure_difference(laid.refined, base.surface, base_from_laid, within(fitted, laid_measured));
  fill_statistics(from_laid, std::max(laid.size, base.size), difference.statistics);
  difference.laid = std::move(from_laid.distances);
  difference.base =
      measure_difference(base.refined, laid.surface, glm::inverse(base_from_laid), within(laid_measured, 1)).distances;
  return difference;
}

}  // namespace onestroke

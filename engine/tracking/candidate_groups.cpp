#include "tracking/candidate_groups.h"

#include <algorithm>

namespace onestroke {
namespace {

// Of the nearer one's distance. A rod held by one arm swings its middle by about half as much.
constexpr double same_place = 0.3;

bool stand_together(const RodModel& rod, const PoseCandidate& a, const PoseCandidate& b) {
  const Vec3d p = a.pose * rod.centre(), q = b.pose * rod.centre();
  return (p - q).norm() < same_place * std::min(p.norm(), q.norm());
}

}  // namespace

std::vector<std::vector<PoseCandidate>> group_by_place(const RodModel& rod,
                                                       const std::vector<PoseCandidate>& candidates) {
  std::vector<std::vector<PoseCandidate>> groups;
  for (const PoseCandidate& c : candidates) {
    const auto group =
        std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return stand_together(rod, g.front(), c); });
    if (group == groups.end())
      groups.push_back({c});
    else
      group->push_back(c);
  }
  return groups;
}

}  // namespace onestroke

#pragma once

#include "tracking/pose_filter.h"

namespace onestroke {

/// By how much two independent measurements of one pose disagree: the squared Mahalanobis distance of one from the
/// other. Of measurements that are what their covariances say it is distributed as chi squared with 6 degrees of
/// freedom.
double disagreement(const PoseMeasurement& a, const PoseMeasurement& b);

/// Two independent measurements of one pose, in the same axes, as one: the pose that is the least far from both by
/// their covariances, by Gauss-Newton, and the inverse of the information that both have together (Barfoot and Furgale,
/// "Associating Uncertainty With Three-Dimensional Poses for Use in Estimation Problems", IEEE Transactions on Robotics
/// 30, 2014, fusing poses). Here translation and rotation are perturbed apart, as by perturbed(), so that of the
/// Jacobian of SE(3) that of the rotation is left. The order of the two does not matter. Covariances are regular.
PoseMeasurement fused(const PoseMeasurement& a, const PoseMeasurement& b);

}  // namespace onestroke

#pragma once

#include "camera/light.h"

/// A finger as a ray meets it, in its own frame: a capsule from the origin along +y, nail towards -z, millimetres.
namespace onestroke::finger {

/// The t of the first point of eye + t * direction on the surface; 0 where the ray misses or starts inside.
double cast(double length, double radius, Vec3 eye, Vec3 direction);
/// Outward unit normal at a surface point. jointed: a finger with its folds and nail; otherwise a palm, its wrist and
/// sleeve.
Vec3 normal(double length, double radius, bool jointed, Vec3 point);
/// What a surface point is made of.
Material material(double radius, bool jointed, Vec3 point);
/// How far a point lies outside the surface; negative inside.
double gap(double length, double radius, Vec3 point);

}  // namespace onestroke::finger

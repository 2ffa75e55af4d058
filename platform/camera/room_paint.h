#pragma once

#include "camera/light.h"

#include <cstdint>

/// Paint for the room: patterns of a plane's own coordinates, in mm, as linear light.
namespace onestroke::room_paint {

/// Smooth noise in [0, 1] with features of size 1, and three octaves of it.
float noise(float x, float y);
float rough(float x, float y);

/// The desk's boards, x across and z away from the wearer.
Linear wood(float x, float z);
/// The view out of the window; u, v in [0, 1] from its upper left.
Linear outdoors(float u, float v);
/// A print of bold shapes; u, v in [0, 1].
Linear poster(float u, float v);
/// A monitor's picture: a window with text, a chart, an icon bar; u, v in [0, 1].
Linear screen(float u, float v);
/// A curtain's folds.
Linear curtain(float x, float y);
/// A keyboard's keys; u, v in [0, 1].
Linear keyboard(float u, float v);
/// Plaster of the walls.
Linear plaster(float x, float y);

}  // namespace onestroke::room_paint

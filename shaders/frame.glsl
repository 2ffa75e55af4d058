// What every stage that draws a frame sees.
#ifndef ONESTROKE_SHADERS_FRAME_GLSL
#define ONESTROKE_SHADERS_FRAME_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_multiview : require
#include "shared.h"

// The views of this pass: all that it draws at once, or from the one that it draws.
layout(set = 0, binding = BINDING_VIEWS, std140) uniform Views { ViewData views[PASS_VIEWS]; };
layout(set = 0, binding = BINDING_SCENE, std140) uniform Scene { SceneData scene; };

#define view views[gl_ViewIndex]
// What the view sees of the camera.
#define its_picture scene.pictures[int(view.picture.x)]

#endif

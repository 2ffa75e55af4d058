#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = BINDING_FOREGROUND) uniform sampler2DArray foreground;

layout(location = 0) out vec4 color;

// The foreground lies on the target pixel for pixel.
void main() { color = texelFetch(foreground, ivec3(gl_FragCoord.xy, gl_ViewIndex), 0); }

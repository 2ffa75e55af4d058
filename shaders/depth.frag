#version 460
#extension GL_EXT_multiview : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = BINDING_DEPTH) uniform texture2DMSArray depths;

// The foreground's depth lies on the target's pixel for pixel. One sample of several is as good as another.
void main() { gl_FragDepth = texelFetch(depths, ivec3(gl_FragCoord.xy, gl_ViewIndex), 0).r; }

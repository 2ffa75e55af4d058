// What a model's vertex and fragment stages agree on.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(push_constant) uniform Push { DrawData draw; };

// What the stages of a cut's face agree on.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(push_constant) uniform Push { CutData cut; };

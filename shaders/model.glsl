// What a model's vertex and fragment stages agree on.
#extension GL_GOOGLE_include_directive : require
#include "shared.h"

layout(set = 0, binding = BINDING_VIEW, std140) uniform View { ViewData view; };
layout(push_constant) uniform Push { DrawData draw; };

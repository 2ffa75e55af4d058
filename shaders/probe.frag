#version 460
#extension GL_EXT_multiview : require

layout(location = 0) out vec4 color;

// Says in the picture which view this is.
void main() { color = vec4(float(gl_ViewIndex + 1) / 255.0); }

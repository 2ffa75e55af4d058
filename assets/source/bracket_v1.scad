// Mounting bracket, version 1: thick plates, sharp inner corner, one middle rib, four round holes in the base.
// Millimetres; x to the right, y to the back, z up. `part` picks what is exported: body, bush or mark.
include <bracket_parts.scad>

part = "body";

width = 60;
depth = 40;
height = 50;
thickness = 6;
corner = 2;
bore_height = 34;
bore = 16;

module solid() {
  base_plate(width, depth, thickness, corner);
  upright_plate(width, depth, height, thickness, corner);
  rib(0, 6, depth, thickness, 24, 15);
}

module body() {
  difference() {
    solid();
    for (x = [-22, 22], y = [-12, 4]) screw_hole_down(x, y, 5.5, thickness);
    for (x = [-22, 22]) screw_hole_back(x, 42, 5.5, depth, thickness);
    bore_back(0, bore_height, bore, depth, thickness);
  }
}

if (part == "body") body();
if (part == "bush") bush(0, bore_height, bore, 11, depth, thickness);
if (part == "mark") {
  mark_front("V1", 17.5, 16, 10, depth, thickness);
  mark_back("V1", 0, 14, 13, depth);
}

// Mounting bracket, version 2: thinner plates, filleted inner corner, round outer corners, two ribs with lightening
// holes, slots further out in the base, a lightening pocket between them, and the bore moved down by 4 mm.
// Millimetres; x to the right, y to the back, z up. `part` picks what is exported: body, bush or mark.
include <bracket_parts.scad>

part = "body";

width = 60;
depth = 40;
height = 50;
thickness = 4;
corner = 9;
bore_height = 30;
bore = 20;

module solid() {
  base_plate(width, depth, thickness, corner);
  upright_plate(width, depth, height, thickness, corner);
  corner_fillet(width, depth, thickness, 5);
  for (x = [-16.5, 16.5]) rib(x, 4, depth, thickness, 30, 34, 4.5);
}

module body() {
  difference() {
    solid();
    for (x = [-23, 23]) slot_down(x, -4, 5.5, 8, thickness);
    for (x = [-23, 23]) screw_hole_back(x, 41, 5.5, depth, thickness);
    bore_back(0, bore_height, bore, depth, thickness);
    pocket_down(0, -6, 20, 14, 4, thickness);
  }
}

if (part == "body") body();
if (part == "bush") bush(0, bore_height, bore, 14, depth, thickness);
if (part == "mark") {
  mark_front("V2", 0, 12.8, 7.5, depth, thickness);
  mark_back("V2", 0, 11, 13, depth);
}

// What both versions of the bracket are made of. The base lies on z = 0 with its front edge at y = -depth / 2; the
// upright stands at the back, its back face at y = depth / 2.
$fn = 72;
chamfer = 0.6;
overlap = 0.01;

module rounded(w, d, r) {
  offset(r) square([w - 2 * r, d - 2 * r], center = true);
}

// A plate of outline w x d between z = 0 and t with chamfered edges.
module plate(w, d, t, r) {
  hull() {
    translate([0, 0, chamfer]) linear_extrude(t - 2 * chamfer) rounded(w, d, r);
    linear_extrude(t) offset(delta = -chamfer) rounded(w, d, r);
  }
}

// Round corners at the front only: the back edge is where the upright stands.
module base_plate(w, d, t, r) {
  intersection() {
    translate([0, r, 0]) plate(w, d + 2 * r, t, r);
    translate([-w, -d, 0]) cube([2 * w, 1.5 * d - chamfer, t]);
  }
}

module upright_plate(w, d, h, t, r) {
  intersection() {
    translate([0, d / 2, (h - 2 * r) / 2]) rotate([90, 0, 0]) plate(w, h + 2 * r, t, r);
    translate([-w, 0, 0]) cube([2 * w, d, h]);
  }
}

// Across the inner corner of the two plates, less the chamfers' width.
module corner_fillet(w, d, t, r) {
  translate([-w / 2 + chamfer, d / 2 - t, t]) rotate([90, 0, 90]) linear_extrude(w - 2 * chamfer) difference() {
    translate([-r, -overlap]) square([r + overlap, r + overlap]);
    translate([-r, r]) circle(r);
  }
}

// A triangular rib at x, reaching `reach` to the front and `rise` up, with a hole where one is asked for.
module rib(x, w, d, t, reach, rise, hole = 0) {
  translate([x - w / 2, d / 2 - t, t]) rotate([90, 0, 90]) linear_extrude(w) difference() {
    polygon([[overlap, -overlap], [-reach, -overlap], [-reach, 1.5], [-2, rise], [overlap, rise]]);
    if (hole > 0) translate([-reach * 0.3, rise * 0.3]) circle(hole);
  }
}

module screw_hole_down(x, y, d, t) {
  translate([x, y, -1]) cylinder(d = d, h = t + 2);
  translate([x, y, t - 1.2]) cylinder(d1 = d, d2 = d + 2.8, h = 1.4);
}

module slot_down(x, y, d, travel, t) {
  hull() for (s = [-1, 1]) translate([x, y + s * travel / 2, -1]) cylinder(d = d, h = t + 2);
  hull() for (s = [-1, 1]) translate([x, y + s * travel / 2, t - 0.6]) cylinder(d1 = d, d2 = d + 1.4, h = 0.7);
}

module pocket_down(x, y, w, d, r, t) {
  translate([x, y, -1]) linear_extrude(t + 2) rounded(w, d, r);
}

module screw_hole_back(x, z, d, depth, t) {
  translate([x, depth / 2 - t, z]) rotate([-90, 0, 0]) {
    translate([0, 0, -1]) cylinder(d = d, h = t + 2);
    translate([0, 0, -0.2]) cylinder(d1 = d + 2.8, d2 = d, h = 1.4);
  }
}

module bore_back(x, z, d, depth, t) {
  translate([x, depth / 2 - t - 1, z]) rotate([-90, 0, 0]) cylinder(d = d, h = t + 2);
}

// A flanged bush pressed into the bore from the front.
module bush(x, z, outer, inner, depth, t) {
  translate([x, depth / 2 - t, z]) rotate([-90, 0, 0]) difference() {
    union() {
      translate([0, 0, -1.5]) cylinder(d = outer + 4, h = 1.5);
      cylinder(d = outer, h = t + 0.5);
    }
    translate([0, 0, -2]) cylinder(d = inner, h = t + 4);
  }
}

module mark(text_, size) {
  linear_extrude(0.9) text(text_, size, font = "DejaVu Sans:style=Bold", halign = "center", valign = "center", $fn = 24);
}

// Raised letters on the upright, to be read from the front and from the back.
module mark_front(text_, x, z, size, depth, t) {
  translate([x, depth / 2 - t + 0.1, z]) rotate([90, 0, 0]) mark(text_, size);
}

module mark_back(text_, x, z, size, depth) {
  translate([x, depth / 2 - 0.1, z]) rotate([90, 0, 180]) mark(text_, size);
}

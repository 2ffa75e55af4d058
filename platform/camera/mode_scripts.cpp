#include "camera/mode_scripts.h"

#include <array>

namespace onestroke {
namespace {

using enum RodPlace;

constexpr bool on_left = true;

// Times are seconds, places mm before the head's camera at rest: x to the right, y down, z forwards.
// A model stands above its stick's stop arm. At a turn of 0 that lies to the right of the corner and the model shows
// its front; at 180 it lies to the left and the model shows its back. So the places that are to meet lie between the
// two models and the hands outside.

// Each is turned round, then both at once.
constexpr std::array side_left{
    Key{0.0, 0.5, middle, {-75, 4, 400}, {10, 16, 0}},
    Key{3.4, 6.8, middle, {-75, 4, 400}, {370, 16, 0}},  // all the way round
    Key{8.0, 8.3, middle, {-75, 4, 390}, {420, 22, -12}},
    Key{9.6, 10.0, middle, {-75, 4, 400}, {370, 16, 0}},
};
constexpr std::array side_right{
    Key{0.0, 3.6, middle, {75, 4, 400}, {-10, 16, 0}},
    Key{6.5, 6.8, middle, {75, 4, 400}, {350, 16, 0}},  // all the way round
    Key{8.0, 8.3, middle, {75, 4, 390}, {300, 22, 12}},
    Key{9.6, 10.0, middle, {75, 4, 400}, {350, 16, 0}},
};

constexpr Turn left_inwards{165, 16, 22}, right_inwards{15, 16, -22};
constexpr Vec3 left_of_middle{-3.5, -38, 400}, right_of_middle{3.5, -38, 400};

constexpr std::array link_left{
    Key{0.0, 2.5, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{3.5, 4.8, start, left_of_middle, left_inwards},  // start tips together
    Key{5.8, 6.0, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{9.2, 13.0, corner, {-62, 40, 400}, {525, 16, 0}},  // all the way round
};
constexpr std::array link_right{
    Key{0.0, 0.4, corner, {62, 40, 400}, {15, 16, 0}},
    Key{1.3, 1.5, corner, {62, 40, 400}, {65, 16, 0}},  // turns alone
    Key{2.4, 2.6, corner, {62, 40, 400}, {15, 16, 0}},
    Key{3.5, 4.8, start, right_of_middle, right_inwards},  // start tips together
    Key{5.8, 9.4, corner, {62, 40, 400}, {15, 16, 0}},
    Key{12.6, 13.0, corner, {62, 40, 400}, {-345, 16, 0}},  // all the way round
};

constexpr std::array mirror_left{
    Key{0.0, 0.4, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{1.4, 2.7, start, left_of_middle, left_inwards},  // start tips together
    Key{3.4, 3.6, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{4.3, 5.6, start, left_of_middle, left_inwards},  // and again
    Key{6.5, 9.8, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{11.2, 11.4, corner, {-66, 40, 400}, {210, 16, -30}},  // leads
    Key{12.8, 13.2, corner, {-62, 40, 400}, {165, 16, 0}},
};
constexpr std::array mirror_right{
    Key{0.0, 0.4, corner, {62, 40, 400}, {15, 16, 0}},
    Key{1.4, 2.7, start, right_of_middle, right_inwards},  // start tips together
    Key{3.4, 3.6, corner, {62, 40, 400}, {15, 16, 0}},
    Key{4.3, 5.6, start, right_of_middle, right_inwards},  // and again
    Key{6.5, 6.7, corner, {62, 40, 400}, {15, 16, 0}},
    Key{9.6, 13.2, corner, {62, 40, 400}, {375, 16, 0}},  // leads, all the way round
};

constexpr std::array overlay_left{
    Key{0.0, 0.6, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{1.7, 12.4, corner, {-9, 36, 400}, {180, 16, -12}},  // corners together
    Key{13.5, 14.0, corner, {-62, 40, 400}, {165, 16, 0}},  // parted
};
constexpr std::array overlay_right{
    Key{0.0, 0.6, corner, {62, 40, 400}, {15, 16, 0}},
    Key{1.7, 8.6, corner, {9, 36, 400}, {0, 16, 12}},    // corners together
    Key{9.5, 11.0, corner, {9, 36, 400}, {0, 16, 75}},   // twisted: best fit
    Key{11.9, 12.4, corner, {9, 36, 400}, {0, 16, 12}},  // own frames
    Key{13.5, 14.0, corner, {62, 40, 400}, {15, 16, 0}},
};
constexpr std::array overlay_both{
    OrbitKey{0.0, 3.2, {}},
    OrbitKey{4.7, 4.9, {65, 0, 0}},
    OrbitKey{7.0, 7.2, {-65, 0, 0}},
    OrbitKey{8.5, 14.0, {}},
};

// The plane of the pointer's arms goes through the model from its front to its back, then, leaning, from top to bottom.
constexpr Turn across{180, -15, -75};
constexpr std::array section_left{
    Key{0.0, 3.1, corner, {-42, 14, 400}, {165, 16, 0}},
    Key{4.7, 9.4, middle, {-80, -14, 400}, {15, 16, 0}},  // shows its front
    Key{11.0, 14.0, corner, {-42, 14, 400}, {165, 16, 0}},
};
constexpr std::array section_right{
    Key{0.0, 0.5, start, {24, -12, 385}, {180, -15, -50}},
    Key{1.7, 3.0, start, {-7, 0, 3}, across, on_left},  // start tip on the corner
    Key{4.8, 5.0, corner, {35, 22, 362}, {0, 10, 0}},
    Key{6.9, 7.1, corner, {35, 22, 414}, {0, 10, 0}},
    Key{8.0, 8.1, corner, {35, -44, 400}, {0, 50, 0}},
    Key{9.7, 9.8, corner, {35, 22, 400}, {0, 50, 0}},
    Key{11.2, 12.5, start, {-7, 0, 3}, across, on_left},  // ends
    Key{13.6, 14.0, start, {24, -12, 385}, {180, -15, -50}},
};

// The pointer's model keeps out of the way: below the points, or beside them.
constexpr std::array measure_left{
    Key{0.0, 13.8, middle, {-45, -32, 410}, {15, 16, 0}},
};
constexpr std::array measure_right{
    Key{0.0, 0.4, start, {45, -20, 390}, {180, -30, -50}},
    Key{1.6, 2.9, start, {78, 0, -3}, {180, -42, -75}, on_left},     // start tip on the end tip
    Key{3.8, 5.0, start, {66, -11, -22}, {180, -42, -65}, on_left},  // lower right corner in front
    Key{5.9, 7.1, start, {12, -11, -22}, {180, -42, -55}, on_left},  // lower left corner in front
    Key{8.3, 9.5, start, {66, -54, 12}, {180, -42, -135}, on_left},  // upper right corner at the back
    Key{10.6, 11.9, start, {78, 0, -3}, {180, -42, -75}, on_left},   // ends
    Key{13.2, 13.8, start, {45, -20, 390}, {180, -30, -50}},
};

// The stick goes away and its model stays; the head looks round that.
constexpr std::array freeze_left{
    Key{0.0, 3.4, corner, {0, 34, 400}, {170, 16, 0}},
    Key{4.8, 5.2, corner, {-95, 40, 400}, {200, 16, -15}},
    Key{7.2, 7.4, corner, {-95, 40, 400}, {130, 16, 15}},
    Key{8.8, 13.4, corner, {0, 34, 400}, {170, 16, 0}},
};
constexpr std::array freeze_right{
    Key{0.0, 0.4, corner, {130, 40, 400}, {170, 16, 0}},
    Key{1.6, 2.9, end, {-7, 0, 0}, {175, 16, 0}, on_left},  // end tip on the corner
    Key{4.0, 8.8, corner, {135, 40, 400}, {170, 16, 0}},
    Key{10.0, 11.3, end, {-7, 0, 0}, {175, 16, 0}, on_left},  // ends
    Key{12.6, 13.4, corner, {130, 40, 400}, {170, 16, 0}},
};
constexpr std::array freeze_head{
    OrbitKey{0.0, 4.6, {}},
    OrbitKey{5.9, 6.0, {12, 0, 0}},
    OrbitKey{8.0, 8.1, {-12, 0, 0}},
    OrbitKey{9.4, 13.4, {}},
};

constexpr std::array snapshot_left{
    Key{0.0, 0.5, middle, {-75, 4, 400}, {10, 16, 0}},
    Key{1.6, 2.4, middle, {-75, 4, 400}, {-30, 22, 0}},  // what is to be kept
    Key{3.5, 4.8, end, {-3.5, 36, 400}, {-12, 16, 0}},   // end tips together
    Key{5.8, 6.6, middle, {-75, 4, 400}, {-30, 22, 0}},
    Key{8.0, 9.0, middle, {-75, 4, 400}, {10, 16, 0}},
};
constexpr std::array snapshot_right{
    Key{0.0, 0.5, middle, {75, 4, 400}, {170, 16, 0}},
    Key{1.6, 2.4, middle, {75, 4, 400}, {210, 22, 0}},  // what is to be kept
    Key{3.5, 4.8, end, {3.5, 36, 400}, {192, 16, 0}},   // end tips together
    Key{5.8, 6.6, middle, {75, 4, 400}, {210, 22, 0}},
    Key{8.0, 9.0, middle, {75, 4, 400}, {170, 16, 0}},
};

constexpr std::array card_left{
    Key{0.0, 0.3, middle, {-130, 4, 400}, {10, 16, 0}},
    Key{1.5, 7.0, middle, {-130, 4, 400}, {35, 16, 0}},
    Key{8.2, 8.6, middle, {-130, 4, 400}, {10, 16, 0}},
};
constexpr std::array card_right{
    Key{0.0, 0.6, middle, {75, 4, 400}, {-10, 16, 0}},  // far
    Key{2.1, 2.5, middle, {-8, 4, 248}, {-10, 16, 0}},  // near
    Key{3.4, 3.6, middle, {-8, 4, 248}, {25, 16, 0}},   // turned
    Key{4.6, 5.0, middle, {-8, 4, 248}, {-20, 16, 0}},  // the other way
    Key{6.5, 8.6, middle, {75, 4, 400}, {-10, 16, 0}},
};

// Crossed start arms, then the tip held before "Cards", which shows them; and once more, which hides them. The right
// arm comes and goes in front of the left one. The menu hangs 100 mm above where the arms cross.
constexpr Vec3 left_crossed{-25, 78, 405}, right_crossed{25, 78, 395}, right_in_front{25, 78, 372};
constexpr Vec3 cards_entry{0, -34, 390};
constexpr std::array menu_left{
    Key{0.0, 0.3, corner, {-80, 62, 405}, {180, 16, 10}},
    Key{1.2, 3.3, corner, left_crossed, {180, 16, 45}},  // start arms crossed
    Key{4.2, 6.6, corner, {-85, 62, 405}, {180, 16, 0}},
    Key{7.5, 9.6, corner, left_crossed, {180, 16, 45}},  // and again
    Key{10.6, 13.4, corner, {-80, 62, 405}, {180, 16, 10}},
};
constexpr std::array menu_right{
    Key{0.0, 0.3, corner, {80, 62, 370}, {0, 16, -10}},   Key{1.2, 1.3, corner, right_in_front, {0, 16, -45}},
    Key{1.6, 2.9, corner, right_crossed, {0, 16, -45}},  // start arms crossed
    Key{3.2, 3.3, corner, right_in_front, {0, 16, -45}},  Key{4.4, 5.7, start, cards_entry, {0, 16, -20}},  // picks
    Key{6.5, 6.6, corner, {80, 62, 370}, {0, 16, -10}},   Key{7.5, 7.6, corner, right_in_front, {0, 16, -45}},
    Key{7.9, 9.2, corner, right_crossed, {0, 16, -45}},  // and again
    Key{9.5, 9.6, corner, right_in_front, {0, 16, -45}},  Key{10.7, 12.0, start, cards_entry, {0, 16, -20}},  // picks
    Key{13.0, 13.4, corner, {80, 62, 370}, {0, 16, -10}},
};

struct Entry {
  ScriptKind kind;
  ModeScript script;
};
constexpr std::array scripts{
    Entry{ScriptKind::side, {10, side_left, side_right, {}, {}}},
    Entry{ScriptKind::link, {13, link_left, link_right, {}, {}}},
    Entry{ScriptKind::mirror, {13.2, mirror_left, mirror_right, {}, {}}},
    Entry{ScriptKind::overlay, {14, overlay_left, overlay_right, {{0, 36, 400}, overlay_both}, {}}},
    Entry{ScriptKind::section, {14, section_left, section_right, {}, {}}},
    Entry{ScriptKind::measure, {13.8, measure_left, measure_right, {}, {}}},
    Entry{ScriptKind::freeze, {13.4, freeze_left, freeze_right, {}, {{-38, 10, 400}, freeze_head}}},
    Entry{ScriptKind::snapshot, {9, snapshot_left, snapshot_right, {}, {}}},
    Entry{ScriptKind::card, {8.6, card_left, card_right, {}, {}}},
    Entry{ScriptKind::menu, {13.4, menu_left, menu_right, {}, {}}},
};

}  // namespace

const ModeScript* find_mode_script(ScriptKind kind) {
  for (const Entry& entry : scripts) {
    if (entry.kind == kind) return &entry.script;
  }
  return nullptr;
}

}  // namespace onestroke

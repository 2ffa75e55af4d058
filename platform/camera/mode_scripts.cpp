#include "camera/mode_scripts.h"

#include <array>

namespace onestroke {
namespace {

using enum RodPlace;

constexpr bool on_left = true;

// A model stands above its stick's stop arm. At a turn of 0 that lies to the right of the corner and the model shows
// its front; at 180 it lies to the left and the model shows its back. So the places that are to meet lie between the
// two models and the hands outside.

// Each in turn, then both at once against each other.
constexpr std::array side_left{
    Key{0.0, 0.5, middle, {-75, 4, 400}, {10, 16, 0}},
    Key{3.4, 6.8, middle, {-75, 4, 400}, {370, 16, 0}},
    Key{8.0, 8.3, middle, {-75, 4, 390}, {420, 22, -12}},
    Key{9.6, 10.0, middle, {-75, 4, 400}, {370, 16, 0}},
};
constexpr std::array side_right{
    Key{0.0, 3.6, middle, {75, 4, 400}, {-10, 16, 0}},
    Key{6.5, 6.8, middle, {75, 4, 400}, {350, 16, 0}},
    Key{8.0, 8.3, middle, {75, 4, 390}, {300, 22, 12}},
    Key{9.6, 10.0, middle, {75, 4, 400}, {350, 16, 0}},
};

// One turns and the other does not; start tips together; now each takes the other along.
constexpr std::array link_left{
    Key{0.0, 2.5, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{3.5, 4.8, start, {-3.5, -38, 400}, {165, 16, 22}},
    Key{5.8, 6.0, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{9.2, 13.0, corner, {-62, 40, 400}, {525, 16, 0}},
};
constexpr std::array link_right{
    Key{0.0, 0.4, corner, {62, 40, 400}, {15, 16, 0}},
    Key{1.3, 1.5, corner, {62, 40, 400}, {65, 16, 0}},
    Key{2.4, 2.6, corner, {62, 40, 400}, {15, 16, 0}},
    Key{3.5, 4.8, start, {3.5, -38, 400}, {15, 16, -22}},
    Key{5.8, 9.4, corner, {62, 40, 400}, {15, 16, 0}},
    Key{12.6, 13.0, corner, {62, 40, 400}, {-345, 16, 0}},
};

// Start tips together twice.
constexpr std::array mirror_left{
    Key{0.0, 0.4, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{1.4, 2.7, start, {-3.5, -38, 400}, {165, 16, 22}},
    Key{3.4, 3.6, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{4.3, 5.6, start, {-3.5, -38, 400}, {165, 16, 22}},
    Key{6.5, 9.8, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{11.2, 11.4, corner, {-66, 40, 400}, {210, 16, -30}},
    Key{12.8, 13.2, corner, {-62, 40, 400}, {165, 16, 0}},
};
constexpr std::array mirror_right{
    Key{0.0, 0.4, corner, {62, 40, 400}, {15, 16, 0}},
    Key{1.4, 2.7, start, {3.5, -38, 400}, {15, 16, -22}},
    Key{3.4, 3.6, corner, {62, 40, 400}, {15, 16, 0}},
    Key{4.3, 5.6, start, {3.5, -38, 400}, {15, 16, -22}},
    Key{6.5, 6.7, corner, {62, 40, 400}, {15, 16, 0}},
    Key{9.6, 13.2, corner, {62, 40, 400}, {375, 16, 0}},
};

// Corners together; both are turned as one; the pointer is twisted and comes back; they part.
constexpr std::array overlay_left{
    Key{0.0, 0.6, corner, {-62, 40, 400}, {165, 16, 0}},
    Key{1.7, 12.4, corner, {-9, 36, 400}, {180, 16, -12}},
    Key{13.5, 14.0, corner, {-62, 40, 400}, {165, 16, 0}},
};
constexpr std::array overlay_right{
    Key{0.0, 0.6, corner, {62, 40, 400}, {15, 16, 0}},
    Key{1.7, 8.6, corner, {9, 36, 400}, {0, 16, 12}},
    Key{9.5, 11.0, corner, {9, 36, 400}, {0, 16, 75}},
    Key{11.9, 12.4, corner, {9, 36, 400}, {0, 16, 12}},
    Key{13.5, 14.0, corner, {62, 40, 400}, {15, 16, 0}},
};
constexpr std::array overlay_both{
    OrbitKey{0.0, 3.2, {}},
    OrbitKey{4.7, 4.9, {50, 0, 0}},
    OrbitKey{7.0, 7.2, {-50, 0, 0}},
    OrbitKey{8.5, 14.0, {}},
};

// Start tip on the corner; the plane of the pointer's arms goes through the model, upright and then leaning; once more.
constexpr Turn across{180, -15, -75};
constexpr std::array section_left{
    Key{0.0, 3.1, corner, {-42, 14, 400}, {165, 16, 0}},
    Key{4.7, 9.4, middle, {-80, -14, 400}, {15, 16, 0}},
    Key{11.0, 14.0, corner, {-42, 14, 400}, {165, 16, 0}},
};
constexpr std::array section_right{
    Key{0.0, 0.5, start, {24, -12, 385}, {180, -15, -50}},
    Key{1.7, 3.0, start, {-7, 0, 3}, across, on_left},
    Key{4.8, 5.0, corner, {35, 22, 362}, {0, 10, 0}},
    Key{6.9, 7.1, corner, {35, 22, 414}, {0, 10, 0}},
    Key{7.9, 8.0, corner, {35, 2, 400}, {0, 50, 0}},
    Key{9.5, 9.6, corner, {35, 42, 400}, {0, 50, 0}},
    Key{11.2, 12.5, start, {-7, 0, 3}, across, on_left},  Key{13.6, 14.0, start, {24, -12, 385}, {180, -15, -50}},
};

// Start tip on the end tip; then at the base's two front corners and at the top of the upright; once more.
constexpr Turn pointing{180, -42, -78};
constexpr std::array measure_left{
    Key{0.0, 13.0, middle, {-45, -20, 410}, {15, 16, 0}},
};
constexpr std::array measure_right{
    Key{0.0, 0.4, start, {45, -8, 390}, {180, -30, -50}},
    Key{1.6, 2.9, start, {78, 0, -3}, pointing, on_left},
    Key{3.8, 5.0, start, {66, -11, -22}, pointing, on_left},
    Key{5.8, 7.0, start, {12, -11, -22}, pointing, on_left},
    Key{7.8, 9.0, start, {66, -54, 12}, pointing, on_left},
    Key{9.9, 11.2, start, {78, 0, -3}, pointing, on_left},
    Key{12.4, 13.0, start, {45, -8, 390}, {180, -30, -50}},
};

// The pointer's end tip on the corner; the stick goes away, its model stays and the head looks round it; once more.
constexpr std::array freeze_left{
    Key{0.0, 3.4, corner, {0, 34, 400}, {170, 16, 0}},
    Key{4.8, 5.2, corner, {-95, 40, 400}, {200, 16, -15}},
    Key{7.2, 7.4, corner, {-95, 40, 400}, {130, 16, 15}},
    Key{8.8, 13.4, corner, {0, 34, 400}, {170, 16, 0}},
};
constexpr std::array freeze_right{
    Key{0.0, 0.4, corner, {130, 40, 400}, {170, 16, 0}},
    Key{1.6, 2.9, end, {-7, 0, 0}, {175, 16, 0}, on_left},
    Key{4.0, 8.8, corner, {135, 40, 400}, {170, 16, 0}},
    Key{10.0, 11.3, end, {-7, 0, 0}, {175, 16, 0}, on_left},
    Key{12.6, 13.4, corner, {130, 40, 400}, {170, 16, 0}},
};
constexpr std::array freeze_head{
    OrbitKey{0.0, 4.6, {}},
    OrbitKey{5.9, 6.0, {12, 0, 0}},
    OrbitKey{8.0, 8.1, {-12, 0, 0}},
    OrbitKey{9.4, 13.4, {}},
};

// What is to be kept is turned into view; end tips together.
constexpr std::array snapshot_left{
    Key{0.0, 0.5, middle, {-75, 4, 400}, {10, 16, 0}},
    Key{1.6, 2.4, middle, {-75, 4, 400}, {-30, 22, 0}},
    Key{3.5, 4.8, end, {-3.5, 36, 400}, {-12, 16, 0}},
    Key{5.8, 6.6, middle, {-75, 4, 400}, {-30, 22, 0}},
    Key{8.0, 9.0, middle, {-75, 4, 400}, {10, 16, 0}},
};
constexpr std::array snapshot_right{
    Key{0.0, 0.5, middle, {75, 4, 400}, {170, 16, 0}},
    Key{1.6, 2.4, middle, {75, 4, 400}, {210, 22, 0}},
    Key{3.5, 4.8, end, {3.5, 36, 400}, {192, 16, 0}},
    Key{5.8, 6.6, middle, {75, 4, 400}, {210, 22, 0}},
    Key{8.0, 9.0, middle, {75, 4, 400}, {170, 16, 0}},
};

// One stick near to the eyes.
constexpr std::array card_left{
    Key{0.0, 0.3, middle, {-100, 4, 400}, {10, 16, 0}},
    Key{1.5, 7.0, middle, {-100, 4, 400}, {35, 16, 0}},
    Key{8.2, 8.6, middle, {-100, 4, 400}, {10, 16, 0}},
};
constexpr std::array card_right{
    Key{0.0, 0.6, middle, {75, 4, 400}, {-10, 16, 0}},
    Key{2.1, 2.5, middle, {60, 4, 248}, {-10, 16, 0}},
    Key{3.4, 3.6, middle, {60, 4, 248}, {25, 16, 0}},
    Key{4.6, 5.0, middle, {60, 4, 248}, {-20, 16, 0}},
    Key{6.5, 8.6, middle, {75, 4, 400}, {-10, 16, 0}},
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
    Entry{ScriptKind::measure, {13, measure_left, measure_right, {}, {}}},
    Entry{ScriptKind::freeze, {13.4, freeze_left, freeze_right, {}, {{-38, 10, 400}, freeze_head}}},
    Entry{ScriptKind::snapshot, {9, snapshot_left, snapshot_right, {}, {}}},
    Entry{ScriptKind::card, {8.6, card_left, card_right, {}, {}}},
};

}  // namespace

const ModeScript* find_mode_script(ScriptKind kind) {
  for (const Entry& entry : scripts) {
    if (entry.kind == kind) return &entry.script;
  }
  return nullptr;
}

}  // namespace onestroke

#include "camera/room_scene.h"

#include "camera/room_paint.h"
#include "camera/sensor.h"

#include <algorithm>
#include <cmath>

namespace onestroke {
namespace {

using room_paint::rough;

constexpr double look_down = 0.17;  // rad
constexpr float desk_y = 330, desk_far = 1380, desk_left = -1150, desk_right = 1250;
constexpr float wall_z = 2350, shelf_z = 2120, left_wall = -1900, right_wall = 2100, floor_y = 1080, ceiling_y = -1400;
constexpr float shelf_left = 330, shelf_right = 1420;
constexpr std::array<float, 3> board_y{420, -20, -460};

struct Rect {
  float left, top, right, bottom;
  bool holds(float x, float y) const { return x >= left && x < right && y >= top && y < bottom; }
  float u(float x) const { return (x - left) / (right - left); }
  float v(float y) const { return (y - top) / (bottom - top); }
};

constexpr Rect window{-1750, -900, -760, 210}, curtain{-800, -1000, -610, 420}, poster{-430, -430, 90, 200};
constexpr Rect monitor{180, -70, 760, 285}, stand{430, 285, 510, 330}, pot{-500, 215, -380, 332},
    mug{-190, 240, -108, 330};
constexpr float monitor_z = 1160, plant_z = 1240, mug_z = 930;

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}
  float roll(float low, float high) {
    return low + (high - low) * static_cast<float>(scramble(state_++) >> 40) * 0x1p-24f;
  }

 private:
  std::uint64_t state_;
};

Linear cover_paint(Dice& dice) {
  constexpr std::array<Linear, 9> covers{{{0.45f, 0.04f, 0.04f},
                                          {0.03f, 0.10f, 0.36f},
                                          {0.04f, 0.24f, 0.09f},
                                          {0.62f, 0.42f, 0.06f},
                                          {0.05f, 0.05f, 0.06f},
                                          {0.60f, 0.56f, 0.46f},
                                          {0.30f, 0.06f, 0.22f},
                                          {0.06f, 0.30f, 0.34f},
                                          {0.55f, 0.20f, 0.05f}}};
  const std::size_t i = std::min(static_cast<std::size_t>(dice.roll(0, 9)), covers.size() - 1);
  return dice.roll(0.7f, 1.2f) * covers[i];
}

/// How bright the daylight is at a place of the room: most by the window.
float daylight(float x, float y, float z) {
  const float dx = (x + 1250) / 1500, dy = (y + 350) / 1500, dz = (z - 1900) / 2600;
  return 0.34f + 0.72f / (1 + dx * dx + dy * dy + dz * dz);
}

float shadow(float distance, float reach) {
  const float u = std::clamp(distance / reach, 0.0f, 1.0f);
  return 0.45f + 0.55f * u * (2 - u);
}

float outside(const Rect& r, float x, float y) {
  const float dx = std::max({r.left - x, x - r.right, 0.0f}), dy = std::max({r.top - y, y - r.bottom, 0.0f});
  return std::hypot(dx, dy);
}

Linear desk_top(float x, float z) {
  constexpr Rect keys{210, 830, 660, 985}, paper{-640, 700, -330, 1010}, notebook{-60, 560, 150, 800};
  const float light = daylight(x, desk_y, z) * shadow(outside({200, 1090, 740, 1200}, x, z), 160) *
                      shadow(outside({-200, mug_z - 20, -60, mug_z + 40}, x, z), 60);
  const float px = x + 0.25f * (z - 850);  // the sheet and the notebook lie askew
  if (keys.holds(x, z)) return light * room_paint::keyboard(keys.u(x), 1 - keys.v(z));
  if (paper.holds(px, z)) {
    const bool text = std::fmod(z, 13.0f) < 5 && px > -610 && px < -360 && room_paint::noise(px / 7, z / 13) > 0.4f;
    return light * (text ? Linear{0.16f, 0.16f, 0.18f} : Linear{0.80f, 0.79f, 0.76f});
  }
  if (notebook.holds(px, z)) return light * (px < -40 ? Linear{0.02f, 0.02f, 0.03f} : Linear{0.05f, 0.16f, 0.42f});
  const float lying = std::min(outside(keys, x, z), std::min(outside(paper, px, z), outside(notebook, px, z)));
  const float sheen = 0.10f * std::max(0.0f, 1 - std::hypot((x + 700) / 600, (z - 1250) / 500));
  return light * shadow(lying, 16) * room_paint::wood(x, z) + sheen * Linear{1, 1, 1.05f};
}

Linear side_wall(Vec3 p) {
  const float x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
  return 0.8f * daylight(x, y, z) * room_paint::plaster(z, y);
}

}  // namespace

RoomScene::RoomScene(std::uint64_t seed) {
  Dice dice(scramble(seed ^ 0x5eed));
  for (std::vector<Book>& row : books_) {
    for (float x = shelf_left + 25; x < shelf_right - 70;) {
      const float width = dice.roll(18, 52);
      if (dice.roll(0, 1) < 0.9f)
        row.push_back({x, x + width, dice.roll(210, 345), cover_paint(dice), cover_paint(dice)});
      x += width + 1.5f;
    }
  }
  constexpr int leaf_count = 46;
  for (int i = 0; i < leaf_count; ++i) {
    const float angle = dice.roll(-1.35f, 1.35f), reach = dice.roll(60, 330), turn = angle + dice.roll(-0.5f, 0.5f);
    leaves_.push_back({-440 + reach * std::sin(angle) * 0.75f, 225 - reach * std::cos(angle), dice.roll(38, 75),
                       dice.roll(10, 19), std::cos(turn), std::sin(turn), dice.roll(0.45f, 1.25f)});
  }
}

bool RoomScene::plant(float x, float y, Linear& out) const {
  if (pot.holds(x, y)) {
    const float u = pot.u(x), taper = 0.13f * pot.v(y);
    if (u > taper && u < 1 - taper) {
      const float round = 0.35f + 0.65f * std::max(0.0f, 1 - std::abs(u - 0.33f) / 0.75f);
      out = (pot.v(y) < 0.2f ? 1.15f : 1.0f) * round * Linear{0.46f, 0.17f, 0.08f};
      return true;
    }
  }
  if (std::hypot(x + 440, y - 100) > 480) return false;
  for (auto leaf = leaves_.rbegin(); leaf != leaves_.rend(); ++leaf) {
    const float dx = x - leaf->x, dy = y - leaf->y;
    const float along = (dx * leaf->sine - dy * leaf->cosine) / leaf->length;
    const float across = (dx * leaf->cosine + dy * leaf->sine) / leaf->width;
    if (along * along + across * across > 1) continue;
    const float rib = std::abs(across) < 0.07f ? 1.4f : 1.0f;
    out = leaf->shade * rib * (0.75f + 0.35f * across) * Linear{0.085f, 0.27f, 0.06f};
    return true;
  }
  const float stem = -440 + 8 * std::sin(y / 50);
  if (std::abs(x - stem) < 4 && y > -40 && y < 220) {
    out = {0.10f, 0.12f, 0.04f};
    return true;
  }
  return false;
}

bool RoomScene::shelf(float x, float y, Linear& out) const {
  if (x < shelf_left || x > shelf_right || y < -830) return false;
  const float light = daylight(x, y, shelf_z);
  const Linear timber = 1.3f * room_paint::wood(x, 40);
  if (x < shelf_left + 20 || x > shelf_right - 20) {
    out = 0.8f * light * timber;
    return y < 900;
  }
  for (std::size_t b = 0; b < boards; ++b) {
    if (y >= board_y[b] && y < board_y[b] + 22) {
      out = light * timber;
      return true;
    }
    const float up = board_y[b] - y;
    if (up < 0 || up > 400) continue;
    for (const Book& book : books_[b]) {
      if (x < book.left || x >= book.right || up > book.height) continue;
      const float u = (x - book.left) / (book.right - book.left), v = up / book.height;
      const float round = 0.6f + 0.4f * std::sin(3.1416f * u);
      const bool band = (v > 0.76f && v < 0.80f) || (v > 0.18f && v < 0.21f);
      const bool title =
          v > 0.34f && v < 0.66f && u > 0.35f && u < 0.62f && room_paint::noise(up / 9, book.left) > 0.4f;
      out = light * round * (band || title ? book.band : book.cover);
      return true;
    }
    out = 0.25f * shadow(400 - up, 200) * light * timber;
    return true;
  }
  return false;
}

Linear RoomScene::back_wall(float x, float y) const {
  if (curtain.holds(x, y)) return (0.5f + 0.8f * daylight(x, y, wall_z)) * room_paint::curtain(x, y);
  if (window.holds(x, y)) {
    const float u = window.u(x), v = window.v(y);
    const bool bar =
        std::abs(u - 0.5f) < 0.022f || std::abs(v - 0.55f) < 0.018f || u < 0.04f || u > 0.96f || v > 0.955f;
    return bar ? Linear{0.62f, 0.62f, 0.60f} : room_paint::outdoors(u, v);
  }
  const float light = daylight(x, y, wall_z);
  if (poster.holds(x, y)) {
    const bool frame = x < poster.left + 14 || x > poster.right - 14 || y < poster.top + 14 || y > poster.bottom - 14;
    return light * (frame ? Linear{0.04f, 0.035f, 0.03f} : room_paint::poster(poster.u(x), poster.v(y)));
  }
  const float hung = outside(poster, x - 18, y - 22);
  return light * shadow(hung, 40) * shadow(floor_y - y, 300) * room_paint::plaster(x, y);
}

bool RoomScene::near_things(Vec3 ray, Sight& out) const {
  const auto at = [&](float z, float& x, float& y) {
    x = static_cast<float>(ray.x / ray.z) * z;
    y = static_cast<float>(ray.y / ray.z) * z;
    out.distance = z;
  };
  float x = 0, y = 0;
  at(mug_z, x, y);
  const bool handle = std::abs(std::hypot((x + 104) / 24, (y - 284) / 30) - 1) < 0.2f && x > -110;
  if (mug.holds(x, y) || handle) {
    const float u = std::clamp(mug.u(x), 0.0f, 1.0f);
    const float round = 0.30f + 0.70f * std::max(0.0f, 1 - std::abs(u - 0.28f) / 0.8f);
    const float shine = 0.25f * std::exp(-(u - 0.2f) * (u - 0.2f) * 260);
    out.light = daylight(x, y, mug_z) * (round * Linear{0.60f, 0.07f, 0.05f} + shine * Linear{1, 1, 1});
    return true;
  }
  at(monitor_z, x, y);
  if (monitor.holds(x, y)) {
    const bool bezel =
        x < monitor.left + 10 || x > monitor.right - 10 || y < monitor.top + 10 || y > monitor.bottom - 18;
    const Rect lit{monitor.left + 10, monitor.top + 10, monitor.right - 10, monitor.bottom - 18};
    out.light = bezel ? Linear{0.025f, 0.025f, 0.028f} : 0.8f * room_paint::screen(lit.u(x), lit.v(y));
    return true;
  }
  if (stand.holds(x, y)) {
    out.light = {0.06f, 0.06f, 0.065f};
    return true;
  }
  at(plant_z, x, y);
  if (!plant(x, y, out.light)) return false;
  out.light = 1.25f * daylight(x, y, plant_z) * out.light;
  return true;
}

RoomScene::Sight RoomScene::look(Vec3 d) const {
  const double c = std::cos(look_down), s = std::sin(look_down);
  const Vec3 ray = normalized(Vec3{d.x, c * d.y + s * d.z, c * d.z - s * d.y});
  Sight out;
  if (ray.z > 0.05 && near_things(ray, out)) return out;
  if (ray.y > 0) {
    const Vec3 p = static_cast<double>(desk_y) / ray.y * ray;
    const float x = static_cast<float>(p.x), z = static_cast<float>(p.z);
    if (z < desk_far && x > desk_left && x < desk_right) {
      const float potted = shadow(std::hypot((x + 400) / 1.6f, z - plant_z) - 50, 70);
      return {potted * desk_top(x, z), static_cast<float>(norm(p))};
    }
  }
  if (ray.z > 0) {
    const float x = static_cast<float>(ray.x / ray.z), y = static_cast<float>(ray.y / ray.z);
    if (shelf(x * shelf_z, y * shelf_z, out.light)) return {out.light, shelf_z};
  }
  const double to_side = ray.x < 0 ? static_cast<double>(left_wall) / ray.x : static_cast<double>(right_wall) / ray.x;
  const double to_level = ray.y < 0 ? static_cast<double>(ceiling_y) / ray.y : static_cast<double>(floor_y) / ray.y;
  const double to_wall = ray.z > 0 ? static_cast<double>(wall_z) / ray.z : 1e9;
  const double t = std::min({to_side, to_level, to_wall});
  const Vec3 p = t * ray;
  out.distance = static_cast<float>(t);
  const float x = static_cast<float>(p.x), z = static_cast<float>(p.z);
  if (t == to_wall) {
    out.light = back_wall(x, static_cast<float>(p.y));
  } else if (t == to_side) {
    out.light = side_wall(p);
  } else {
    const Linear paint =
        ray.y < 0 ? Linear{0.62f, 0.62f, 0.60f} : (0.7f + 0.6f * rough(x / 30, z / 30)) * Linear{0.10f, 0.11f, 0.14f};
    out.light = daylight(x, static_cast<float>(p.y), z) * paint;
  }
  return out;
}

}  // namespace onestroke

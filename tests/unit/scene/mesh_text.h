#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace onestroke {

/// A box from the origin to (60, 40, 20), as twelve triangles that face outwards, and as each format writes it.
struct BoxMesh {
  using Point = std::array<float, 3>;
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;

  BoxMesh() {
    for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 60.0F : 0.0F, i & 2 ? 40.0F : 0.0F, i & 4 ? 20.0F : 0.0F});
    const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& q : quads) {
      triangles.push_back({q[0], q[1], q[2]});
      triangles.push_back({q[0], q[2], q[3]});
    }
  }

  std::string ascii_stl() const {
    std::ostringstream out;
    out << "solid box\n";
    for (const auto& t : triangles) {
      out << " facet normal 0 0 0\n  outer loop\n";
      for (const int i : t) out << "   vertex " << text(i) << '\n';
      out << "  endloop\n endfacet\n";
    }
    out << "endsolid box\n";
    return out.str();
  }

  std::string binary_stl(const std::string& header = "a box") const {
    std::string out = header;
    out.resize(80, ' ');
    put(out, static_cast<std::uint32_t>(triangles.size()));
    for (const auto& t : triangles) {
      put(out, Point{});
      for (const int i : t) put(out, points[static_cast<std::size_t>(i)]);
      put(out, std::uint16_t{0});
    }
    return out;
  }

  std::string obj(const std::string& before_faces = "") const {
    std::ostringstream out;
    for (std::size_t i = 0; i < points.size(); ++i) out << "v " << text(static_cast<int>(i)) << '\n';
    out << before_faces;
    for (const auto& t : triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
    return out.str();
  }

  static std::string ply_header(const std::string& format, int vertices, int faces, const std::string& more = "") {
    return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\n" + more + "element face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  }

  std::string ascii_ply() const {
    std::ostringstream out;
    out << ply_header("ascii", 8, 12);
    for (std::size_t i = 0; i < points.size(); ++i) out << text(static_cast<int>(i)) << '\n';
    for (const auto& t : triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
    return out.str();
  }

  std::string binary_ply(bool big = false) const {
    std::string out = ply_header(big ? "binary_big_endian" : "binary_little_endian", 8, 12);
    for (const Point& p : points)
      for (const float x : p) put(out, x, big);
    for (const auto& t : triangles) {
      out += '\3';
      for (const int i : t) put(out, i, big);
    }
    return out;
  }

 private:
  std::string text(int point) const {
    std::ostringstream out;
    const Point& p = points[static_cast<std::size_t>(point)];
    out << p[0] << ' ' << p[1] << ' ' << p[2];
    return out.str();
  }

  template <class T>
  static void put(std::string& out, const T& value, bool big = false) {
    std::string bytes(sizeof value, '\0');
    std::memcpy(bytes.data(), &value, sizeof value);
    out += big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
  }
};

}  // namespace onestroke

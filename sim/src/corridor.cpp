#include "random.hpp"
#include "scenes.hpp"

namespace thermedge::sim {
namespace {

constexpr double kWallCounts = 2480;
constexpr double kHalfWidth = 1.2;  // metres
constexpr double kFloor = 1.1;
constexpr double kCeiling = -1.4;
constexpr double kNear = 1.0;
constexpr double kFar = 12.0;

// A camera that looks along the corridor (z forward, x right, y down, metres).
class View {
 public:
  explicit View(std::uint64_t seed)
      : random_(seed, 2),
        centre_{random_.uniform(0, 170, 214), random_.uniform(1, 118, 142)},
        next_(2) {}

  [[nodiscard]] Point operator()(double x, double y, double z) const {
    return {centre_.x + kFocalPx * x / z, centre_.y + kFocalPx * y / z};
  }
  // A rectangle on a side wall between two depths and two heights.
  [[nodiscard]] Outline on_wall(double x, double z0, double z1, double y0, double y1) const {
    return polygon(
        {(*this)(x, y0, z0), (*this)(x, y0, z1), (*this)(x, y1, z1), (*this)(x, y1, z0)});
  }
  // A rectangle on the floor or the ceiling.
  [[nodiscard]] Outline level(double y, double x0, double x1, double z0, double z1) const {
    return polygon(
        {(*this)(x0, y, z0), (*this)(x1, y, z0), (*this)(x1, y, z1), (*this)(x0, y, z1)});
  }
  double vary(double value) { return value * random_.uniform(next_++, 0.9, 1.1); }

 private:
  static constexpr double kFocalPx = 200;
  Random random_;
  Point centre_;
  std::uint64_t next_;
};

// What stands below another surface reaches under it, so that every boundary is the outline of one
// object only: doors and walls under the floor and the ceiling, which are painted later.
constexpr double kUnderFloor = 2 * kFloor;
constexpr double kAboveCeiling = 2 * kCeiling;

void add_doors(Scene& scene, View& view) {
  constexpr double kLintel = -0.95;
  for (const double z : {1.75, 3.9}) {
    scene.add(view.on_wall(-kHalfWidth, z, z * 1.42, kLintel, kUnderFloor),
              kWallCounts + view.vary(150));
    scene.add(view.on_wall(-kHalfWidth, z * 1.05, z * 1.35, kLintel + 0.08, kUnderFloor),
              kWallCounts + view.vary(260), 0.3, 0.2);
  }
  scene.add(view.on_wall(kHalfWidth, 5.0, 6.6, kLintel, kUnderFloor), kWallCounts + view.vary(190));
}

void add_end(Scene& scene, View& view) {
  const auto wall = [&](double x, double y0) {
    return polygon({view(-x, y0, kFar), view(x, y0, kFar), view(x, kUnderFloor, kFar),
                    view(-x, kUnderFloor, kFar)});
  };
  scene.add(wall(kHalfWidth, kAboveCeiling), kWallCounts - view.vary(60));
  scene.add(wall(0.5, -0.7), kWallCounts + view.vary(130));
}

void add_walls(Scene& scene, View& view) {
  scene.add(view.on_wall(kHalfWidth, kNear / 2, 1.1 * kFar, kAboveCeiling, kUnderFloor),
            kWallCounts + view.vary(40), 0.05);
  add_doors(scene, view);
  add_end(scene, view);
  scene.add(view.level(kFloor, -kHalfWidth, kHalfWidth, kNear / 2, kFar),
            kWallCounts - view.vary(90), 0, 0.15);
  scene.add(view.level(kCeiling, -kHalfWidth, kHalfWidth, kNear / 2, kFar),
            kWallCounts + view.vary(130), 0, -0.1);
}

void add_radiator(Scene& scene, View& view) {
  constexpr int kRibs = 5;
  constexpr double kFirst = 2.1;
  constexpr double kPitch = 0.28;
  for (int i = kRibs; i-- > 0;) {
    const double z = kFirst + i * kPitch;
    scene.add(view.on_wall(kHalfWidth - 0.06, z, z + 0.75 * kPitch, 0.35, 0.95),
              kWallCounts + view.vary(620), 0, -0.8);
  }
}

void add_pipes_and_lamps(Scene& scene, View& view) {
  const auto pipe = [&](double x, double y, double width, double counts) {
    scene.add(polygon({view(x, y, kNear), view(x + width, y, kNear), view(x + width, y, kFar * 0.9),
                       view(x, y, kFar * 0.9)}),
              kWallCounts + view.vary(counts));
  };
  pipe(-1.05, kCeiling + 0.1, 0.12, 430);
  pipe(-0.8, kCeiling + 0.1, 0.08, -170);
  scene.add(view.on_wall(kHalfWidth - 0.02, kNear / 2, kFar, -0.62, -0.52),
            kWallCounts - view.vary(80));
  for (const double z : {8.0, 4.6, 2.6}) {
    scene.add(view.level(kCeiling + 0.02, 0.1, 0.5, z, z * 1.3), kWallCounts + view.vary(700));
  }
  const Point button = view(-kHalfWidth + 0.02, 0.05, 3.0);
  scene.add(ellipse(button, 4, 6), kWallCounts + view.vary(380));
}

}  // namespace

Scene corridor_scene(std::uint64_t seed) {
  View view(seed);
  Scene scene(kWallCounts, 0.05, 0.05);  // the left wall
  add_walls(scene, view);
  add_radiator(scene, view);
  add_pipes_and_lamps(scene, view);
  return scene;
}

}  // namespace thermedge::sim

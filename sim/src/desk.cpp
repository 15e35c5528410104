#include "random.hpp"
#include "scenes.hpp"

namespace thermedge::sim {
namespace {

// Places objects a few pixels off and a little warmer or colder from seed to seed.
class Variation {
 public:
  explicit Variation(std::uint64_t seed) : random_(seed, 1) {}
  Point shift(double reach_px) {
    const double dx = random_.uniform(index_++, -reach_px, reach_px);
    return {dx, random_.uniform(index_++, -reach_px, reach_px)};
  }
  double counts(double value) { return value * random_.uniform(index_++, 0.9, 1.1); }
  double number(double low, double high) { return random_.uniform(index_++, low, high); }

 private:
  Random random_;
  std::uint64_t index_ = 0;
};

constexpr double kRoomCounts = 2620;

void add_monitor(Scene& scene, Variation& vary) {
  const auto [x, y] = vary.shift(6);
  scene.add(
      polygon({{x + 128, y + 128}, {x + 150, y + 128}, {x + 154, y + 172}, {x + 124, y + 172}}),
      kRoomCounts + vary.counts(90));
  scene.add(ellipse({x + 139, y + 176}, 38, 9), kRoomCounts + vary.counts(110));
  scene.add(
      rounded({{x + 48, y + 34}, {x + 232, y + 26}, {x + 234, y + 142}, {x + 46, y + 138}}, 5),
      kRoomCounts + vary.counts(232), 0.05, -0.05);
  scene.add(polygon({{x + 57, y + 43}, {x + 224, y + 36}, {x + 226, y + 131}, {x + 55, y + 128}}),
            kRoomCounts + vary.counts(130), -0.05, -0.1);
}

void add_laptop(Scene& scene, Variation& vary) {
  const auto [x, y] = vary.shift(5);
  scene.add(
      polygon({{x + 262, y + 100}, {x + 356, y + 108}, {x + 350, y + 174}, {x + 268, y + 168}}),
      kRoomCounts + vary.counts(120), 0, 0.3);
  scene.add(
      polygon({{x + 268, y + 106}, {x + 350, y + 113}, {x + 345, y + 167}, {x + 273, y + 162}}),
      kRoomCounts + vary.counts(200), 0.4, 0.5);
  scene.add(
      rounded({{x + 268, y + 169}, {x + 350, y + 175}, {x + 364, y + 212}, {x + 250, y + 204}}, 3),
      kRoomCounts + vary.counts(190), 0.8, 0.4);
  scene.add(
      polygon({{x + 284, y + 194}, {x + 320, y + 197}, {x + 322, y + 205}, {x + 282, y + 202}}),
      kRoomCounts + vary.counts(110));
}

void add_mug(Scene& scene, Variation& vary) {
  const auto [x, y] = vary.shift(5);
  scene.add(band({x + 62, y + 196}, {x + 92, y + 206}, {x + 62, y + 226}, 6),
            kRoomCounts + vary.counts(100));
  scene.add(vessel({x + 26, y + 186}, {x + 66, y + 186}, {x + 46, y + 236}, 16, 5),
            kRoomCounts + vary.counts(170), 0, 1.2);
  scene.add(ellipse({x + 46, y + 186}, 20, 7), kRoomCounts + vary.counts(330));
}

void add_bottle(Scene& scene, Variation& vary) {
  const auto [x, y] = vary.shift(5);
  scene.add(rounded({{x + 39, y + 62}, {x + 49, y + 62}, {x + 49, y + 80}, {x + 39, y + 80}}, 2),
            kRoomCounts - vary.counts(110));
  scene.add(rounded({{x + 30, y + 78}, {x + 58, y + 78}, {x + 58, y + 172}, {x + 30, y + 172}}, 9),
            kRoomCounts - vary.counts(190), 0, -0.6);
}

void add_small_things(Scene& scene, Variation& vary) {
  const auto [x, y] = vary.shift(6);
  const Point keyboard{x + 158, y + 222};
  scene.add(turned(rectangle(keyboard.x - 68, keyboard.y - 15, keyboard.x + 68, keyboard.y + 15, 4),
                   keyboard, vary.number(-0.04, 0.0)),
            kRoomCounts + vary.counts(110), 0.2, 0);
  const Point phone{x + 218, y + 254};
  scene.add(turned(rectangle(phone.x - 14, phone.y - 26, phone.x + 14, phone.y + 26, 5), phone,
                   vary.number(0.15, 0.3)),
            kRoomCounts + vary.counts(170), 0, 0.6);
  const Point charger{x + 330, y + 252};
  scene.add(band({charger.x - 12, charger.y}, {x + 270, y + 284}, {x + 228, y + 262}, 3.5),
            kRoomCounts + vary.counts(150));
  scene.add(turned(rectangle(charger.x - 20, charger.y - 12, charger.x + 20, charger.y + 12, 4),
                   charger, vary.number(0.05, 0.15)),
            kRoomCounts + vary.counts(280), 0.8, 0.5);
}

}  // namespace

Scene desk_scene(std::uint64_t seed) {
  Variation vary(seed);
  Scene scene(kRoomCounts, 0.12, -0.2);
  scene.add(polygon({{-60, 166}, {442, 158}, {482, 360}, {-100, 360}}),
            kRoomCounts + vary.counts(45), 0.05, 0.1);
  add_monitor(scene, vary);
  add_bottle(scene, vary);
  add_laptop(scene, vary);
  add_small_things(scene, vary);
  add_mug(scene, vary);
  return scene;
}

}  // namespace thermedge::sim

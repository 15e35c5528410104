// Thermal worlds: what a scene is built from. Metres and degrees Celsius; x right, y ahead, z up.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "thermedge/result.hpp"

namespace thermedge::sim {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  friend bool operator==(const Vec3&, const Vec3&) = default;
};

// How a surface radiates. Its temperature is `temperature_degc` at the middle of its object.
struct Surface {
  double temperature_degc = 20;  // -272..1100
  double emissivity = 0.95;      // 0..1; the rest mirrors the surroundings (World::reflected_degc)
  Vec3 gradient_degc_per_m;      // temperature grows along this direction
  double value_noise_degc = 0;   // smooth spots without edges, largest deviation, 0..50; flat faces
  double value_noise_m = 0.4;    // size of the spots, 0.01..1000
};

// A region of a flat face with a surface of its own: a picture, a seam, a stain, a label.
struct Patch {
  enum class Shape { kRectangle, kEllipse };
  Shape shape = Shape::kRectangle;
  double right_m = 0, up_m = 0;      // its middle from the face's middle, as the face is looked at
  double width_m = 0, height_m = 0;  // whole extent, above 0
  double turn_rad = 0;               // counter-clockwise
  Surface surface;
};

// A parallelogram, seen from both sides; `u` points right and `v` up on it.
struct Quad {
  Vec3 corner, u, v;
  Surface surface;
  std::vector<Patch> patches;
};

enum class Side { kFront, kBack, kLeft, kRight, kTop, kBottom };
inline constexpr int kSides = 6;

// A cuboid. Its front looks towards -y before it is turned. `inside`: a room, seen from within.
struct Box {
  Vec3 centre, size;
  double yaw_rad = 0;    // about z, counter-clockwise from above
  double pitch_rad = 0;  // about its own x axis, before the yaw; positive leans the top back
  bool inside = false;
  std::array<Surface, kSides> surfaces;
  std::array<std::vector<Patch>, kSides> patches;
};

// A cylinder with flat ends, or with half spheres (`round`).
struct Cylinder {
  Vec3 from, to;
  double radius = 0;
  bool round = false;
  Surface surface;
  std::array<Surface, 2> ends;  // at `from` and at `to`
};

struct Sphere {
  Vec3 centre;
  double radius = 0;
  Surface surface;
};

// A straight way at constant speed.
struct Motion {
  Vec3 by_m;          // from the object's place to the end of its way; 0: it stands still
  double from_s = 0;  // when it sets out, -1e6..1e6
  double in_s = 1;    // how long it takes, 0.001..1e6
  bool back = false;  // and back again, for ever; else it stays there
};

// Objects may touch and pierce each other. Cuts of two cylinders, of a sphere with a cylinder
// beside its axis, and of a face along a cylinder's axis have no true edge; nor have cuts with
// objects that move.
struct Object {
  std::string name;
  std::variant<Quad, Box, Cylinder, Sphere> shape;
  Motion motion{};

  [[nodiscard]] bool moves() const { return motion.by_m != Vec3{}; }
};

// Where the camera begins, and where it drives.
struct Viewpoint {
  Vec3 position;
  Vec3 look_at{0, 1, 0};
  double roll_rad = 0;          // of the camera about its axis, clockwise as it looks
  std::vector<Vec3> waypoints;  // of path drive, from `position` on; none: ahead
  double speed_m_per_s = 0.5;   // 0.001..50
};

struct World {
  std::string name;
  double sky_degc = 20;        // what is seen past all objects
  double reflected_degc = 20;  // what surfaces of less than full emissivity mirror
  Viewpoint view;
  std::vector<Object> objects;
};

// Reads a world from TOML (docs/scenes.md); `name` is for messages. `seed` varies what the file
// lets vary (`jitter_m`, `vary_degc`). Errors name the file and the object or line and say what
// would be right: not TOML, unknown or missing key, wrong type, out of range, below 0 K, no
// objects. Thread-safe.
[[nodiscard]] Result<World> parse_world(std::string_view toml, const std::string& name,
                                        std::uint64_t seed);

// The same for a file.
[[nodiscard]] Result<World> load_world(const std::string& path, std::uint64_t seed);

// The TOML text of a built-in scene; nothing where there is none of that name.
[[nodiscard]] std::optional<std::string_view> built_in_scene(std::string_view name);

}  // namespace thermedge::sim

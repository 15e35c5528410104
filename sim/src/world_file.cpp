// Worlds from TOML; docs/scenes.md describes the format.
#include <array>
#include <fstream>
#include <sstream>

#include "portable.hpp"
#include "random.hpp"
#include "vec3.hpp"
#include "world_fields.hpp"

namespace thermedge::sim {
namespace {

constexpr std::size_t kMostObjects = 2000;
constexpr Range kAngleDeg{-360, 360};
constexpr std::array<std::string_view, kSides> kSideNames = {"front", "back", "left",
                                                             "right", "top",  "bottom"};

// FNV-1a; names a stream of random numbers.
std::uint64_t hash(std::string_view text) {
  std::uint64_t value = 0xcbf29ce484222325ULL;
  for (const char c : text) {
    value = (value ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  return value;
}

// The properties of an object that seeds change: its place, together with its group, and its
// temperature.
struct Variation {
  Vec3 shift;
  double degc = 0;
};

Variation variation(Fields& fields, const std::string& name, std::uint64_t seed) {
  std::string group = name;
  Vec3 jitter;
  double degc = 0;
  fields.text("group", group);
  fields.vector("jitter_m", jitter);
  fields.number("vary_degc", degc, {0, 100});
  const Random place(seed, hash(group));
  const Random warmth(seed, hash(name) + 1);
  return {{jitter.x * place.uniform(0, -1, 1), jitter.y * place.uniform(1, -1, 1),
           jitter.z * place.uniform(2, -1, 1)},
          degc * warmth.uniform(0, -1, 1)};
}

Patch read_patch(Fields& fields, const Surface& base) {
  Patch patch;
  patch.surface = base;
  std::string shape = "rectangle";
  fields.text("shape", shape);
  if (shape != "rectangle" && shape != "ellipse") {
    fields.fault("shape = '" + shape + "' should be rectangle or ellipse");
  }
  patch.shape = shape == "ellipse" ? Patch::Shape::kEllipse : Patch::Shape::kRectangle;
  fields.pair("centre_m", patch.right_m, patch.up_m);
  fields.size("size_m", patch.width_m, patch.height_m);
  double turn_deg = 0;
  fields.number("turn_deg", turn_deg, kAngleDeg);
  patch.turn_rad = radians(turn_deg);
  fields.surface(patch.surface);
  return patch;
}

// Calls `add(patch fields, ...)` for each [[object.patch]].
void read_patches(Fields& fields, Status& status, const auto& add) {
  int number = 0;
  for (const toml::table* table : fields.tables("patch")) {
    Fields patch(*table, fields.where() + ": patch " + std::to_string(++number), status);
    add(patch);
    patch.finish();
  }
}

Quad read_quad(Fields& fields, const Surface& surface, const Variation& vary, Status& status) {
  Quad quad;
  quad.surface = surface;
  fields.vector("corner_m", quad.corner, true);
  fields.vector("right_m", quad.u, true);
  fields.vector("up_m", quad.v, true);
  quad.corner = quad.corner + vary.shift;
  if (!(norm(cross(quad.u, quad.v)) > 1e-9)) {
    fields.fault("right_m and up_m should point in different directions");
  }
  read_patches(fields, status,
               [&](Fields& patch) { quad.patches.push_back(read_patch(patch, surface)); });
  return quad;
}

// A plane without a border in sight.
Quad read_plane(Fields& fields, const Surface& surface, const Variation& vary) {
  constexpr double kHalfM = 2000;
  Vec3 point;
  Vec3 normal;
  fields.vector("point_m", point, true);
  fields.vector("normal_m", normal, true);
  if (!(norm(normal) > 1e-9)) {
    fields.fault("normal_m should have a direction");
    return {};
  }
  const Vec3 u = perpendicular(unit(normal)) * kHalfM;
  const Vec3 v = cross(unit(normal), u);
  return {point + vary.shift - u - v, u * 2, v * 2, surface, {}};
}

int side_of(Fields& fields) {
  std::string name;
  fields.text("side", name, true);
  for (std::size_t i = 0; i < kSideNames.size(); ++i) {
    if (kSideNames[i] == name) {
      return static_cast<int>(i);
    }
  }
  fields.fault("side = '" + name + "' should be front, back, left, right, top or bottom");
  return 0;
}

Box read_box(Fields& fields, const Surface& surface, const Variation& vary, Status& status) {
  Box box;
  fields.vector("centre_m", box.centre, true);
  fields.size("size_m", box.size);
  double yaw_deg = 0;
  double pitch_deg = 0;
  fields.number("yaw_deg", yaw_deg, kAngleDeg);
  fields.number("pitch_deg", pitch_deg, kAngleDeg);
  fields.flag("inside", box.inside);
  box.centre = box.centre + vary.shift;
  box.yaw_rad = radians(yaw_deg);
  box.pitch_rad = radians(pitch_deg);
  box.surfaces.fill(surface);
  for (std::size_t i = 0; i < kSideNames.size(); ++i) {
    if (const toml::table* table = fields.table(kSideNames[i])) {
      Fields side(*table, fields.where() + ": " + std::string(kSideNames[i]), status);
      side.surface(box.surfaces[i]);
      side.finish();
    }
  }
  read_patches(fields, status, [&](Fields& patch) {
    const auto side = static_cast<std::size_t>(side_of(patch));
    box.patches[side].push_back(read_patch(patch, box.surfaces[side]));
  });
  return box;
}

Cylinder read_cylinder(Fields& fields, const Surface& surface, const Variation& vary,
                       Status& status) {
  Cylinder cylinder;
  cylinder.surface = surface;
  cylinder.ends.fill(surface);
  fields.vector("from_m", cylinder.from, true);
  fields.vector("to_m", cylinder.to, true);
  fields.number("radius_m", cylinder.radius, {1e-4, 1e4}, true);
  fields.flag("round", cylinder.round);
  constexpr std::array<std::string_view, 2> kEnds = {"from_end", "to_end"};
  for (std::size_t i = 0; i < kEnds.size(); ++i) {
    if (const toml::table* table = fields.table(kEnds[i])) {
      Fields end(*table, fields.where() + ": " + std::string(kEnds[i]), status);
      end.surface(cylinder.ends[i]);
      end.finish();
    }
  }
  if (!(norm(cylinder.to - cylinder.from) > 1e-6)) {
    fields.fault("from_m and to_m should be different points");
  }
  cylinder.from = cylinder.from + vary.shift;
  cylinder.to = cylinder.to + vary.shift;
  return cylinder;
}

Sphere read_sphere(Fields& fields, const Surface& surface, const Variation& vary) {
  Sphere sphere;
  sphere.surface = surface;
  fields.vector("centre_m", sphere.centre, true);
  fields.number("radius_m", sphere.radius, {1e-4, 1e4}, true);
  sphere.centre = sphere.centre + vary.shift;
  return sphere;
}

Motion read_motion(Fields& fields) {
  Motion motion;
  fields.vector("moves_m", motion.by_m);
  fields.number("moves_from_s", motion.from_s, {-1e6, 1e6});
  fields.number("moves_in_s", motion.in_s, {0.001, 1e6});
  fields.flag("moves_back", motion.back);
  return motion;
}

Object read_object(const toml::table& table, std::size_t number, std::uint64_t seed,
                   Status& status) {
  Object object;
  object.name = table["name"].value_or(std::to_string(number));
  Fields fields(table, "object '" + object.name + "'", status);
  std::string type;
  fields.text("name", object.name);
  fields.text("type", type, true);
  const Variation vary = variation(fields, object.name, seed);
  Surface surface;
  fields.surface(surface);
  surface.temperature_degc += vary.degc;
  object.motion = read_motion(fields);
  if (type == "quad") {
    object.shape = read_quad(fields, surface, vary, status);
  } else if (type == "plane") {
    object.shape = read_plane(fields, surface, vary);
  } else if (type == "box") {
    object.shape = read_box(fields, surface, vary, status);
  } else if (type == "cylinder") {
    object.shape = read_cylinder(fields, surface, vary, status);
  } else if (type == "sphere") {
    object.shape = read_sphere(fields, surface, vary);
  } else {
    fields.fault("type = '" + type + "' should be plane, quad, box, cylinder or sphere");
  }
  fields.finish();
  return object;
}

void read_view(const toml::table& table, Viewpoint& view, Status& status) {
  Fields fields(table, "view", status);
  fields.vector("position_m", view.position, true);
  fields.vector("look_at_m", view.look_at, true);
  double roll_deg = 0;
  fields.number("roll_deg", roll_deg, kAngleDeg);
  view.roll_rad = radians(roll_deg);
  fields.vectors("waypoints_m", view.waypoints);
  fields.number("speed_m_per_s", view.speed_m_per_s, {0.001, 50});
  const Vec3 ahead = view.look_at - view.position;
  if (!(norm({ahead.x, ahead.y, 0}) > 1e-3 * norm(ahead)) || !(norm(ahead) > 1e-6)) {
    fields.fault("look_at_m should be ahead of position_m, not straight above or below it");
  }
  const bool moves = view.waypoints.empty() || norm(view.waypoints[0] - view.position) > 1e-3;
  if (!moves) {
    fields.fault("waypoints_m should begin away from position_m, at the first point to drive to");
  }
  fields.finish();
}

Status read_world(const toml::table& table, std::uint64_t seed, World& world) {
  Status status;
  Fields fields(table, "", status);
  fields.text("name", world.name);
  fields.number("sky_degc", world.sky_degc, {-272, 1100});
  fields.number("reflected_degc", world.reflected_degc, {-272, 1100});
  if (const toml::table* view = fields.table("view")) {
    read_view(*view, world.view, status);
  } else {
    fields.fault("needs [view] with position_m and look_at_m");
  }
  const auto objects = fields.tables("object");
  if (objects.empty() || objects.size() > kMostObjects) {
    fields.fault("needs 1 to " + std::to_string(kMostObjects) + " objects, written as [[object]]");
  }
  for (std::size_t i = 0; i < objects.size() && status; ++i) {
    world.objects.push_back(read_object(*objects[i], i + 1, seed, status));
  }
  fields.finish();
  return status;
}

}  // namespace

Result<World> parse_world(std::string_view toml, const std::string& name, std::uint64_t seed) {
  try {
    const toml::table table = toml::parse(toml, name);
    World world;
    world.name = name;
    if (Status status = read_world(table, seed, world); !status) {
      return failure(status.error().code, name + ": " + status.error().message);
    }
    return world;
  } catch (const toml::parse_error& error) {
    return failure(ErrorCode::kBadData, name + ": line " +
                                            std::to_string(error.source().begin.line) +
                                            ": not TOML: " + std::string(error.description()));
  }
}

Result<World> load_world(const std::string& path, std::uint64_t seed) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    return failure(ErrorCode::kIo, path + ": cannot be read as a scene file");
  }
  return parse_world(text.str(), path, seed);
}

}  // namespace thermedge::sim

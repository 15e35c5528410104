// Thermal scenes as a camera sees them, with their true edges: what demo, tests and benchmarks run
// on. The worlds themselves are in world.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/parallel_runner.hpp"
#include "thermedge/result.hpp"
#include "thermedge/sim/world.hpp"

namespace thermedge::sim {

// Lens and sensor. All noise is seeded. The defaults are a plain camera of the PI450's size and
// noise, without the per-pixel pattern and the events of real ones; camera_preset() has those.
struct CameraOptions {
  int width = 382;        // px, 16..4096
  int height = 288;       // px, 16..4096
  double rate_hz = 80;    // frames a second, 0.1..1000
  double fov_deg = 53;    // from the left to the right border, without distortion, 5..120
  double k1 = 0;          // Brown's radial distortion, -0.3..0.3: r -> r (1 + k1 r^2 + k2 r^4) with
  double k2 = 0;          // r = tangent of the angle to the axis; -0.3..0.3
  double blur_px = 1.0;   // Gaussian optics: standard deviation, px, 0..20
  double airy_px = 0;     // diffraction: radius of the first dark ring, px, 0..8; 0: none
  double vignetting = 0;  // share of the light that the corner loses to the housing, 0..0.9

  double sigma_counts = 5.8;         // temporal noise of a pixel (NETD), counts, 0..5000
  double pixel_sigma_counts = 0;     // fixed offsets of the pixels, counts, 0..5000
  double gain_sigma = 0;             // fixed gains of the pixels, share, 0..0.5
  double column_sigma_counts = 1.2;  // fixed column pattern, counts, 0..5000
  double row_sigma_counts = 0.9;     // fixed row pattern, counts, 0..5000
  double drift_s = 0;                // time in which a fixed pattern turns into another, s, 0..1e6;
                                     // 0: it stays
  int bad_pixels = 5;                // stuck at 0 or at the largest count, 0..10000
  int flickering_pixels = 0;         // at random off by 10 to 40 sigma, 0..10000

  int shutter_every = 0;           // frames from one shutter event to the next, 0..1e6; 0: none
  int shutter_frames = 24;         // length of the freeze, frames, 1..1e6
  double shutter_jump_counts = 8;  // standard deviation of the jump after it, counts, 0..5000

  // What else goes wrong in recordings. Each comes back after a number of frames of the camera's
  // clock, the first time after as many; 0: never.
  int freeze_every = 0;    // the picture is repeated for a while, 0..1e6
  int freeze_frames = 12;  // that long, 1..1e6, less than freeze_every
  double freeze_noise =
      0;               // new noise on the repeated picture, share of sigma_counts, 0..1; 0: none
  int jump_every = 0;  // the level jumps away, and the next time back, 0..1e6
  double jump_counts = 40;  // by 0.5 to 1.5 times that, counts, 0..5000
  int pattern_every = 0;    // the fixed pattern becomes another one at once, 0..1e6
  int drop_every = 0;       // frames get lost, 0..1e6
  int drop_frames = 2;      // as many, 1..1e6, less than drop_every
};

// Things that move, besides the scene's own; docs/scenes.md tells where. Speeds are px a frame at
// their distance, straight ahead.
struct MovingThings {
  int box = 0;                 // 1: a box that moves from side to side
  double box_speed_px = 1;     // 0..100
  double box_warmer_degc = 2;  // than what the scene's surfaces mirror, -100..100
  int hot = 0;                 // 1: a hot thing that comes in from the left and stays
  double hot_at_s = 1;         // when its way begins, just outside the picture, 0..1e6
  double hot_speed_px = 4;     // 0.01..100
  double hot_degc = 60;        // 0..1000
};

enum class PathKind { kHand, kDrive, kPan, kShake, kStill };

struct SceneOptions {
  std::string name = "desk";  // a name of scene_names(), or a file that ends in .toml
  std::uint64_t seed = 1;     // noise, pattern, path, and what the scene lets vary, 0..9e15
  int frames = 1;             // 1..1e6
  PathKind path = PathKind::kHand;
  double path_speed = 1;              // how much faster the camera goes its path, 0..100
  double least_contrast_counts = 10;  // smaller steps are no edges, counts, 0..5000
  bool depth = false;                 // render TrueFrame::depth_mm
  CameraOptions camera;
  MovingThings moving;
};

struct Point {
  double x = 0, y = 0;  // px, pixel centres at integers
};

enum class EdgeKind {
  kOccluding,  // the outline of something nearer
  kMaterial,   // two temperatures or emissivities on one face
  kCrease,     // two faces that touch
};

// A visible piece of an edge, exact to the sub-pixel, with the step across it.
struct TrueEdge {
  std::vector<Point> points;  // at most 0.5 px apart
  bool closed = false;
  double contrast_counts = 0;  // mean absolute step across the edge, counts
  int object = 0;              // whose edge it is; the same over a sequence
  int id = 0;  // which edge of the world it is; the same over a sequence, and for all its pieces
  EdgeKind kind = EdgeKind::kOccluding;
};

// The camera in the world, with axes as OpenCV has them: x right, y down, z forward.
struct Pose {
  Vec3 position_m;
  std::array<double, 4> orientation_xyzw{0, 0, 0, 1};  // turns camera axes into those of the world
};

// u = cx + fx x (1 + k1 r^2 + k2 r^4) with x = X / Z, r^2 = x^2 + y^2; v likewise.
struct Intrinsics {
  int width = 0, height = 0;
  double fx_px = 0, fy_px = 0, cx_px = 0, cy_px = 0, k1 = 0, k2 = 0;
};

// The effect of the shutter on a frame. Truth is of the frame's own time; a frozen picture is not.
struct ShutterState {
  bool frozen = false;     // the picture is that of frame `shows_frame`
  int shows_frame = 0;     // the frame itself where not frozen
  double jump_counts = 0;  // offset since the event before this frame, relative to before it
};

// The picture is that of an earlier frame, though the shutter is open.
struct FreezeState {
  int shows_frame = 0;
  double noise_counts = 0;  // standard deviation of new noise on it
};

// What a tracker should tell of a frame.
enum class StreamEvent {
  kDropped,         // frames before it are missing
  kFrozen,          // the picture of the last frame again, exactly
  kNearFrozen,      // but for new noise
  kOffsetJump,      // the level of all pixels is off by 2 counts or more from the last frame's
  kPatternChanged,  // the fixed pattern is another one than in the last frame
};

// An object that is not where it was at the beginning.
struct MovedObject {
  int object = 0;  // as TrueEdge::object
  Vec3 by_m;
};

struct TrueFrame {
  int index = 0;  // of the camera's clock: frames that are dropped have one, too
  std::int64_t stamp_ns = 0;
  Image<std::uint16_t> counts;  // as the camera gives them
  Image<float> clean;           // without noise, pattern and bad pixels, counts
  std::vector<TrueEdge> edges;
  Image<std::uint16_t> depth_mm;  // along the optical axis, mm; 0: sky; 65535: that far or farther
  Pose pose;
  Intrinsics intrinsics;
  std::optional<ShutterState> shutter;  // in frozen frames and in the first frame after
  std::optional<FreezeState> freeze;    // in frozen frames that the shutter doesn't explain
  double offset_counts = 0;             // of all pixels of the picture, by shutter and jumps
  int dropped_frames = 0;               // that are missing before this one
  std::vector<StreamEvent> events;      // in the order of StreamEvent
  std::vector<MovedObject> moved;       // objects that can move, in their order
};

// Renders the frames of one scene. Keeps what frames have in common, and scratch memory.
// One caller at a time.
class Renderer {
 public:
  // Errors: unknown scene, a scene file that is wrong, an option out of range.
  [[nodiscard]] static Result<Renderer> create(const SceneOptions& options);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  // Frame `index` (0 .. frames - 1) of those that are not dropped, in any order. The same options
  // and index give the same bits on every machine and for every runner. Error: no such frame.
  [[nodiscard]] Result<TrueFrame> render(int index, ParallelRunner& runner);
  [[nodiscard]] const SceneOptions& options() const;

 private:
  class Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

// One frame on one thread, in the easy case. Thread-safe.
[[nodiscard]] Result<TrueFrame> render(const SceneOptions& options, int index);

// Parses "sim:NAME[?key=value&...]": NAME as SceneOptions::name; keys camera (a name of
// camera_names(), applied first), path (hand, drive, pan, shake, still), path_speed, seed, frames,
// netd_mk, and the fields of CameraOptions and MovingThings without their units. Errors name the
// key and list what is known.
[[nodiscard]] Result<SceneOptions> parse_scene(std::string_view spec);

// Sets one of these keys from text, e.g. ("netd_mk", "60"). Errors name the key.
[[nodiscard]] Status set_scene_key(std::string_view key, std::string_view value,
                                   SceneOptions& options);

// Names of the built-in scenes, and of the cameras.
[[nodiscard]] std::vector<std::string> scene_names();
[[nodiscard]] std::vector<std::string> camera_names();

// pi450 (Optris PI450: 382x288, 80 Hz; noise as measured on recordings, 46 mK over time, where the
// data sheet says 40), boson (FLIR Boson: 640x512, 60 Hz, 50 mK), lepton35 (FLIR Lepton 3.5:
// 160x120, 8.7 Hz, 50 mK). Error: none of these.
[[nodiscard]] Result<CameraOptions> camera_preset(std::string_view name);

}  // namespace thermedge::sim

#include "thermedge/sim/scene.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "random.hpp"
#include "render.hpp"
#include "scenes.hpp"
#include "sensor.hpp"

namespace thermedge::sim {
namespace {

constexpr double kNativeWidth = 382;
constexpr double kNativeHeight = 288;

struct NamedScene {
  std::string_view name;
  Scene (*make)(std::uint64_t seed);
};
constexpr std::array kScenes = {NamedScene{"desk", desk_scene},
                                NamedScene{"corridor", corridor_scene}};

std::string list_of_scenes() {
  std::string list;
  for (const NamedScene& scene : kScenes) {
    list += (list.empty() ? "" : ", ") + std::string(scene.name);
  }
  return list;
}

const NamedScene* find_scene(std::string_view name) {
  const auto* found = std::find_if(kScenes.begin(), kScenes.end(),
                                   [&](const NamedScene& scene) { return scene.name == name; });
  return found == kScenes.end() ? nullptr : found;
}

// A key of "sim:NAME?key=value", its range, and where its value goes.
struct Key {
  std::string_view name;
  double min;
  double max;
  bool whole;
  void (*set)(SceneOptions& options, double value);
};
constexpr std::array kKeys = {
    Key{"seed", 0, 9e15, true,
        [](SceneOptions& o, double v) { o.seed = static_cast<std::uint64_t>(v); }},
    Key{"frames", 1, 1e6, true, [](SceneOptions& o, double v) { o.frames = static_cast<int>(v); }},
    Key{"width", 16, 4096, true,
        [](SceneOptions& o, double v) { o.camera.width = static_cast<int>(v); }},
    Key{"height", 16, 4096, true,
        [](SceneOptions& o, double v) { o.camera.height = static_cast<int>(v); }},
    Key{"blur", 0, 20, false, [](SceneOptions& o, double v) { o.camera.blur_px = v; }},
    Key{"sigma", 0, 5000, false, [](SceneOptions& o, double v) { o.camera.sigma_counts = v; }},
    Key{"column_sigma", 0, 5000, false,
        [](SceneOptions& o, double v) { o.camera.column_sigma_counts = v; }},
    Key{"row_sigma", 0, 5000, false,
        [](SceneOptions& o, double v) { o.camera.row_sigma_counts = v; }},
    Key{"dead_pixels", 0, 10000, true,
        [](SceneOptions& o, double v) { o.camera.dead_pixels = static_cast<int>(v); }},
};

Status apply(std::string_view setting, const std::string& spec, SceneOptions& options) {
  const auto equals = std::min(setting.find('='), setting.size());
  const std::string_view name = setting.substr(0, equals);
  const std::string_view text = setting.substr(std::min(equals + 1, setting.size()));
  std::string known;
  for (const Key& key : kKeys) {
    known += (known.empty() ? "" : ", ") + std::string(key.name);
    if (key.name != name) {
      continue;
    }
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool number = error == std::errc{} && stop == end;
    if (!number || !(value >= key.min && value <= key.max) ||
        (key.whole && value != std::floor(value))) {
      return failure(ErrorCode::kInvalidArgument,
                     spec + ": " + std::string(setting) + " should be a " +
                         (key.whole ? "whole " : "") + "number from " +
                         std::to_string(static_cast<long long>(key.min)) + " to " +
                         std::to_string(static_cast<long long>(key.max)));
    }
    key.set(options, value);
    return {};
  }
  return failure(ErrorCode::kInvalidArgument,
                 spec + ": unknown key '" + std::string(name) + "'; known are " + known);
}

Status check(const SceneOptions& options, int index) {
  const CameraOptions& camera = options.camera;
  const auto within = [](double value, double low, double high) {
    return value >= low && value <= high;
  };
  if (find_scene(options.name) == nullptr) {
    return failure(ErrorCode::kInvalidArgument,
                   "sim:" + options.name + ": no such scene; there are " + list_of_scenes());
  }
  if (index < 0 || index >= options.frames) {
    return failure(ErrorCode::kInvalidArgument, "sim:" + options.name + ": frame " +
                                                    std::to_string(index) + " of " +
                                                    std::to_string(options.frames));
  }
  if (!within(camera.width, 16, 4096) || !within(camera.height, 16, 4096) ||
      !within(camera.blur_px, 0, 20) || !within(camera.sigma_counts, 0, 5000) ||
      !within(camera.column_sigma_counts, 0, 5000) || !within(camera.row_sigma_counts, 0, 5000) ||
      !within(camera.dead_pixels, 0, 10000)) {
    return failure(ErrorCode::kInvalidArgument,
                   "sim:" + options.name +
                       ": camera out of range (width and height 16 to 4096 px, blur 0 to 20 px, "
                       "noise 0 to 5000 counts, dead pixels 0 to 10000)");
  }
  return {};
}

// Where the hand holds the camera: smooth between random knots, zero at the first frame.
Point hand(std::uint64_t seed, int index) {
  constexpr int kFramesPerKnot = 8;
  constexpr double kReachPx = 6;
  const auto axis = [&](std::uint64_t stream) {
    const Random random(seed, stream);
    const auto knot = static_cast<std::uint64_t>(index / kFramesPerKnot);
    const double t = static_cast<double>(index % kFramesPerKnot) / kFramesPerKnot;
    const double blend = t * t * (3 - 2 * t);
    const auto at = [&](std::uint64_t k) {
      return k == 0 ? 0.0 : random.uniform(k, -kReachPx, kReachPx);
    };
    return at(knot) + (at(knot + 1) - at(knot)) * blend;
  };
  return {axis(20), axis(21)};
}

// Steps under this share of the scene's range are no edges for anyone.
constexpr double kLeastStepShare = 0.02;

double least_step_counts(ImageView<const float> clean) {
  float low = clean(0, 0);
  float high = low;
  for (int y = 0; y < clean.height(); ++y) {
    const auto [min, max] = std::minmax_element(clean.row(y), clean.row(y) + clean.width());
    low = std::min(low, *min);
    high = std::max(high, *max);
  }
  return kLeastStepShare * (double{high} - double{low});
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const NamedScene& scene : kScenes) {
    names.emplace_back(scene.name);
  }
  return names;
}

Result<SceneOptions> parse_scene(std::string_view spec) {
  const std::string whole(spec);
  constexpr std::string_view kPrefix = "sim:";
  std::string_view rest = spec.substr(spec.starts_with(kPrefix) ? kPrefix.size() : 0);
  const auto question = std::min(rest.find('?'), rest.size());
  SceneOptions options;
  options.name = rest.substr(0, question);
  if (find_scene(options.name) == nullptr) {
    return failure(ErrorCode::kInvalidArgument,
                   whole + ": no such scene; there are " + list_of_scenes());
  }
  rest = rest.substr(std::min(question + 1, rest.size()));
  while (!rest.empty()) {
    const auto end = std::min(rest.find('&'), rest.size());
    if (Status status = apply(rest.substr(0, end), whole, options); !status) {
      return tl::unexpected(status.error());
    }
    rest = rest.substr(std::min(end + 1, rest.size()));
  }
  return options;
}

Result<TrueFrame> render(const SceneOptions& options, int index) {
  if (Status status = check(options, index); !status) {
    return tl::unexpected(status.error());
  }
  const CameraOptions& camera = options.camera;
  Scene scene = find_scene(options.name)->make(options.seed);
  scene.transform(camera.width / kNativeWidth, camera.height / kNativeHeight,
                  hand(options.seed, index));
  TrueFrame frame;
  frame.clean = render_clean(scene, camera.width, camera.height, camera.blur_px);
  frame.counts = expose(frame.clean, camera, options.seed, index);
  frame.edges = true_edges(scene, camera.width, camera.height, least_step_counts(frame.clean));
  return frame;
}

}  // namespace thermedge::sim

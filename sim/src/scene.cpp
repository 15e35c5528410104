#include "thermedge/sim/scene.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <type_traits>

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

// An option, its range, and how it is read and written: by its key in "sim:NAME?key=value" and when
// a scene is rendered.
struct Key {
  std::string_view name;
  double min;
  double max;
  bool whole;
  double (*get)(const SceneOptions& options);
  void (*set)(SceneOptions& options, double value);
};

template <auto kMember>
constexpr Key scene_key(std::string_view name, double min, double max) {
  using Value = std::remove_cvref_t<decltype(SceneOptions{}.*kMember)>;
  return {name,
          min,
          max,
          std::is_integral_v<Value>,
          [](const SceneOptions& o) { return static_cast<double>(o.*kMember); },
          [](SceneOptions& o, double value) { o.*kMember = static_cast<Value>(value); }};
}

template <auto kMember>
constexpr Key camera_key(std::string_view name, double min, double max) {
  using Value = std::remove_cvref_t<decltype(CameraOptions{}.*kMember)>;
  return {name,
          min,
          max,
          std::is_integral_v<Value>,
          [](const SceneOptions& o) { return static_cast<double>(o.camera.*kMember); },
          [](SceneOptions& o, double value) { o.camera.*kMember = static_cast<Value>(value); }};
}

constexpr std::array kKeys = {
    scene_key<&SceneOptions::seed>("seed", 0, 9e15),
    scene_key<&SceneOptions::frames>("frames", 1, 1e6),
    camera_key<&CameraOptions::width>("width", 16, 4096),
    camera_key<&CameraOptions::height>("height", 16, 4096),
    camera_key<&CameraOptions::blur_px>("blur", 0, 20),
    camera_key<&CameraOptions::sigma_counts>("sigma", 0, 5000),
    camera_key<&CameraOptions::column_sigma_counts>("column_sigma", 0, 5000),
    camera_key<&CameraOptions::row_sigma_counts>("row_sigma", 0, 5000),
    camera_key<&CameraOptions::dead_pixels>("dead_pixels", 0, 10000),
};

bool allows(const Key& key, double value) {
  return value >= key.min && value <= key.max && (!key.whole || value == std::floor(value));
}

std::string requirement(const Key& key) {
  return std::string(" should be a ") + (key.whole ? "whole " : "") + "number from " +
         std::to_string(static_cast<long long>(key.min)) + " to " +
         std::to_string(static_cast<long long>(key.max));
}

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
    if (error != std::errc{} || stop != end || !allows(key, value)) {
      return failure(ErrorCode::kInvalidArgument,
                     spec + ": " + std::string(setting) + requirement(key));
    }
    key.set(options, value);
    return {};
  }
  return failure(ErrorCode::kInvalidArgument,
                 spec + ": unknown key '" + std::string(name) + "'; known are " + known);
}

Status check(const SceneOptions& options, int index) {
  const std::string scene = "sim:" + options.name;
  if (find_scene(options.name) == nullptr) {
    return failure(ErrorCode::kInvalidArgument,
                   scene + ": no such scene; there are " + list_of_scenes());
  }
  for (const Key& key : kKeys) {
    if (!allows(key, key.get(options))) {
      return failure(ErrorCode::kInvalidArgument,
                     scene + ": " + std::string(key.name) + requirement(key));
    }
  }
  if (index < 0 || index >= options.frames) {
    return failure(ErrorCode::kInvalidArgument, scene + ": there is no frame " +
                                                    std::to_string(index) + "; frames are 0 to " +
                                                    std::to_string(options.frames - 1));
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
  names.reserve(kScenes.size());
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

#include "scene_keys.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <type_traits>

#include "number_text.hpp"
#include "radiometer.hpp"
#include "sensor.hpp"

namespace thermedge::sim {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) {
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

// A number among the options: its range, and how it is read and written.
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

template <auto kMember>
constexpr Key moving_key(std::string_view name, double min, double max) {
  using Value = std::remove_cvref_t<decltype(MovingThings{}.*kMember)>;
  return {name,
          min,
          max,
          std::is_integral_v<Value>,
          [](const SceneOptions& o) { return static_cast<double>(o.moving.*kMember); },
          [](SceneOptions& o, double value) { o.moving.*kMember = static_cast<Value>(value); }};
}

constexpr double kMkPerCount = kDegcPerCount * 1000;

constexpr std::array kKeys = {
    scene_key<&SceneOptions::seed>("seed", 0, 9e15),
    scene_key<&SceneOptions::frames>("frames", 1, 1e6),
    scene_key<&SceneOptions::least_contrast_counts>("least_contrast", 0, 5000),
    scene_key<&SceneOptions::path_speed>("path_speed", 0, 100),
    camera_key<&CameraOptions::width>("width", 16, 4096),
    camera_key<&CameraOptions::height>("height", 16, 4096),
    camera_key<&CameraOptions::rate_hz>("rate", 0.1, 1000),
    camera_key<&CameraOptions::fov_deg>("fov", 5, 120),
    camera_key<&CameraOptions::k1>("k1", -0.3, 0.3),
    camera_key<&CameraOptions::k2>("k2", -0.3, 0.3),
    camera_key<&CameraOptions::blur_px>("blur", 0, 20),
    camera_key<&CameraOptions::airy_px>("airy", 0, 8),
    camera_key<&CameraOptions::vignetting>("vignetting", 0, 0.9),
    camera_key<&CameraOptions::sigma_counts>("sigma", 0, 5000),
    Key{"netd_mk", 0, 5000 * kMkPerCount, false,
        [](const SceneOptions& o) { return o.camera.sigma_counts * kMkPerCount; },
        [](SceneOptions& o, double value) { o.camera.sigma_counts = value / kMkPerCount; }},
    camera_key<&CameraOptions::pixel_sigma_counts>("pixel_sigma", 0, 5000),
    camera_key<&CameraOptions::gain_sigma>("gain_sigma", 0, 0.5),
    camera_key<&CameraOptions::column_sigma_counts>("column_sigma", 0, 5000),
    camera_key<&CameraOptions::row_sigma_counts>("row_sigma", 0, 5000),
    camera_key<&CameraOptions::drift_s>("drift", 0, 1e6),
    camera_key<&CameraOptions::bad_pixels>("bad_pixels", 0, 10000),
    camera_key<&CameraOptions::flickering_pixels>("flickering_pixels", 0, 10000),
    camera_key<&CameraOptions::shutter_every>("shutter_every", 0, 1e6),
    camera_key<&CameraOptions::shutter_frames>("shutter_frames", 1, 1e6),
    camera_key<&CameraOptions::shutter_jump_counts>("shutter_jump", 0, 5000),
    camera_key<&CameraOptions::freeze_every>("freeze_every", 0, 1e6),
    camera_key<&CameraOptions::freeze_frames>("freeze_frames", 1, 1e6),
    camera_key<&CameraOptions::freeze_noise>("freeze_noise", 0, 1),
    camera_key<&CameraOptions::jump_every>("jump_every", 0, 1e6),
    camera_key<&CameraOptions::jump_counts>("jump", 0, 5000),
    camera_key<&CameraOptions::pattern_every>("pattern_every", 0, 1e6),
    camera_key<&CameraOptions::drop_every>("drop_every", 0, 1e6),
    camera_key<&CameraOptions::drop_frames>("drop_frames", 1, 1e6),
    moving_key<&MovingThings::box>("box", 0, 1),
    moving_key<&MovingThings::box_speed_px>("box_speed", 0, 100),
    moving_key<&MovingThings::box_warmer_degc>("box_warmer", -100, 100),
    moving_key<&MovingThings::hot>("hot", 0, 1),
    moving_key<&MovingThings::hot_at_s>("hot_at", 0, 1e6),
    moving_key<&MovingThings::hot_speed_px>("hot_speed", 0.01, 100),
    moving_key<&MovingThings::hot_degc>("hot_degc", 0, 1000),
};

struct NamedPath {
  std::string_view name;
  PathKind kind;
};
constexpr std::array kPaths = {
    NamedPath{"hand", PathKind::kHand}, NamedPath{"drive", PathKind::kDrive},
    NamedPath{"pan", PathKind::kPan}, NamedPath{"shake", PathKind::kShake},
    NamedPath{"still", PathKind::kStill}};

bool allows(const Key& key, double value) {
  return value >= key.min && value <= key.max && (!key.whole || value == std::floor(value));
}

std::string requirement(const Key& key) {
  return std::string(" should be a ") + (key.whole ? "whole " : "") + "number from " +
         number_text(key.min) + " to " + number_text(key.max);
}

tl::unexpected<Error> bad(const std::string& message) {
  return failure(ErrorCode::kInvalidArgument, message);
}

Status set_path(std::string_view value, SceneOptions& options) {
  std::string list;
  for (const NamedPath& path : kPaths) {
    if (path.name == value) {
      options.path = path.kind;
      return {};
    }
    list += (list.empty() ? "" : ", ") + std::string(path.name);
  }
  return bad("path=" + std::string(value) + ": no such path; there are " + list);
}

Status set_number(const Key& key, std::string_view text, SceneOptions& options) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || !allows(key, value)) {
    return bad(std::string(key.name) + "=" + std::string(text) + requirement(key));
  }
  key.set(options, value);
  return {};
}

Status check_name(const std::string& name) {
  if (is_scene_file(name) || built_in_scene(name)) {
    return {};
  }
  return bad("no such scene; there are " + joined(scene_names()) + ", and files that end in .toml");
}

// Cuts `text` at the first `mark`; the rest is empty where there is none.
std::pair<std::string_view, std::string_view> cut(std::string_view text, char mark) {
  const auto at = std::min(text.find(mark), text.size());
  return {text.substr(0, at), text.substr(std::min(at + 1, text.size()))};
}

// The camera comes first, wherever it is written: the other keys change it.
Status apply_all(std::string_view settings, SceneOptions& options) {
  for (const bool camera : {true, false}) {
    std::string_view rest = settings;
    while (!rest.empty()) {
      const auto [setting, behind] = cut(rest, '&');
      const auto [name, value] = cut(setting, '=');
      if ((name == "camera") == camera) {
        if (Status status = set_scene_key(name, value, options); !status) {
          return status;
        }
      }
      rest = behind;
    }
  }
  return {};
}

}  // namespace

bool is_scene_file(std::string_view name) { return name.ends_with(".toml"); }

Status set_scene_key(std::string_view key, std::string_view value, SceneOptions& options) {
  if (key == "camera") {
    return camera_preset(value).map([&](const CameraOptions& camera) { options.camera = camera; });
  }
  if (key == "path") {
    return set_path(value, options);
  }
  std::string known = "camera, path";
  for (const Key& number : kKeys) {
    if (number.name == key) {
      return set_number(number, value, options);
    }
    known += ", " + std::string(number.name);
  }
  return bad("unknown key '" + std::string(key) + "'; known are " + known);
}

Result<SceneOptions> parse_scene(std::string_view spec) {
  const auto named = [&](Error error) {
    error.message = std::string(spec) + ": " + error.message;
    return error;
  };
  constexpr std::string_view kPrefix = "sim:";
  const auto [name, settings] =
      cut(spec.substr(spec.starts_with(kPrefix) ? kPrefix.size() : 0), '?');
  SceneOptions options;
  options.name = name;
  return check_name(options.name)
      .and_then([&, settings = settings] { return apply_all(settings, options); })
      .map([&] { return options; })
      .map_error(named);
}

Status check(const SceneOptions& options) {
  if (Status status = check_name(options.name); !status) {
    return bad("sim:" + options.name + ": " + status.error().message);
  }
  for (const Key& key : kKeys) {
    if (!allows(key, key.get(options))) {
      return bad("sim:" + options.name + ": " + std::string(key.name) + requirement(key));
    }
  }
  const CameraOptions& camera = options.camera;
  const auto fits = [&](const char* what, int every, int frames) -> Status {
    if (every > 0 && frames >= every) {
      return bad("sim:" + options.name + ": " + what + "_frames should be less than " + what +
                 "_every");
    }
    return {};
  };
  return fits("shutter", camera.shutter_every, camera.shutter_frames)
      .and_then([&] { return fits("freeze", camera.freeze_every, camera.freeze_frames); })
      .and_then([&] { return fits("drop", camera.drop_every, camera.drop_frames); })
      .and_then([&]() -> Status {
        if (camera_number(camera, options.frames - 1) > kLargestNumber) {
          return bad("sim:" + options.name + ": " + std::to_string(options.frames) +
                     " frames beside those that drop_every and drop_frames take are more than " +
                     std::to_string(kLargestNumber));
        }
        return {};
      });
}

}  // namespace thermedge::sim

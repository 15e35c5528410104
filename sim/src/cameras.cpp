// Cameras that the simulator knows.
#include <array>

#include "thermedge/sim/scene.hpp"

namespace thermedge::sim {
namespace {

struct NamedCamera {
  std::string_view name;
  CameraOptions camera;
};

// Noise and pattern of the PI450 are such that `probe` finds in a simulated recording what it finds
// in a real one, stripes of the scene itself included; of the others, what their data sheets say.
const std::array<NamedCamera, 3>& cameras() {
  static const std::array<NamedCamera, 3> kCameras = {{
      {"pi450",
       {.fov_deg = 53,
        .k1 = -0.12,
        .k2 = 0.02,
        .vignetting = 0.02,
        .sigma_counts = 4.6,
        .pixel_sigma_counts = 3.15,
        .gain_sigma = 0.001,
        .column_sigma_counts = 0.95,
        .row_sigma_counts = 0.65,
        .drift_s = 120,
        .bad_pixels = 0,
        .flickering_pixels = 1}},
      {"boson",
       {.width = 640,
        .height = 512,
        .rate_hz = 60,
        .fov_deg = 50,
        .k1 = -0.15,
        .k2 = 0.03,
        .vignetting = 0.03,
        .sigma_counts = 5,
        .pixel_sigma_counts = 2.5,
        .gain_sigma = 0.002,
        .column_sigma_counts = 1.8,
        .row_sigma_counts = 1,
        .drift_s = 90,
        .bad_pixels = 10,
        .flickering_pixels = 5}},
      {"lepton35",
       {.width = 160,
        .height = 120,
        .rate_hz = 8.7,
        .fov_deg = 57,
        .k1 = -0.18,
        .k2 = 0.04,
        .blur_px = 0.8,
        .vignetting = 0.04,
        .sigma_counts = 5,
        .pixel_sigma_counts = 3,
        .gain_sigma = 0.003,
        .column_sigma_counts = 2.5,
        .row_sigma_counts = 1.5,
        .drift_s = 60,
        .bad_pixels = 2,
        .flickering_pixels = 1,
        .shutter_frames = 6}},
  }};
  return kCameras;
}

}  // namespace

std::vector<std::string> camera_names() {
  std::vector<std::string> names;
  for (const NamedCamera& camera : cameras()) {
    names.emplace_back(camera.name);
  }
  return names;
}

Result<CameraOptions> camera_preset(std::string_view name) {
  std::string list;
  for (const NamedCamera& camera : cameras()) {
    if (camera.name == name) {
      return camera.camera;
    }
    list += (list.empty() ? "" : ", ") + std::string(camera.name);
  }
  return failure(ErrorCode::kInvalidArgument,
                 "camera=" + std::string(name) + ": no such camera; there are " + list);
}

}  // namespace thermedge::sim

#include "probe_degrees.hpp"

#include <cmath>

namespace thermedge::detail {
namespace {

// Scenes lie within -60 to 100 degC at least in part, where nobody says otherwise.
constexpr double kColdestScene = -60;
constexpr double kHottestScene = 100;
// Uncooled cameras have 0.02 to 0.15 degC of noise.
constexpr double kMostNoise = 0.3;

bool is_plausible(CameraSource source, double low_degc, double high_degc, double sigma_degc) {
  if (!std::isfinite(low_degc) || !std::isfinite(high_degc) || low_degc < -kKelvinAtZeroCelsius) {
    return false;
  }
  return source != CameraSource::kName ||
         (high_degc > kColdestScene && low_degc < kHottestScene && sigma_degc < kMostNoise);
}

}  // namespace

void fill_degrees(const ProbeOptions& options, int low_counts, int high_counts,
                  RecordingReport& report) {
  report.degc_per_count = options.degc_per_count.value_or(kDegcPerCount);
  report.is_degc_assumed = !options.degc_per_count && !options.camera;
  report.camera_source = options.camera_source;
  if (!options.camera) {
    return;
  }
  const CountsModel& camera = *options.camera;
  const double worth = camera.degc_per_count((low_counts + high_counts) / 2.0);
  const double low = camera.to_degc(low_counts);
  const double high = camera.to_degc(high_counts);
  if (is_plausible(options.camera_source, low, high, worth * report.sigma_counts)) {
    report.degc_per_count = worth;
    const double coldest = camera.to_degc(report.min_counts);
    const double hottest = camera.to_degc(report.max_counts);
    report.min_degc = std::isfinite(coldest) ? std::optional(coldest) : std::nullopt;
    report.max_degc = std::isfinite(hottest) ? std::optional(hottest) : std::nullopt;
  } else {
    report.is_degc_implausible = true;
    report.implausible_degc = {low, high};
    report.implausible_sigma_degc = worth * report.sigma_counts;
  }
}

}  // namespace thermedge::detail

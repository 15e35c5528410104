#include "thermedge/radiometry/planck.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <type_traits>

namespace thermedge {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kPi = std::numbers::pi;

// 2 h c^2, W um^4 m^-2 sr^-1, and h c / k, um K.
constexpr double kFirst = 2 * kPlanckConstant * kSpeedOfLight * kSpeedOfLight * 1e24;
constexpr double kSecond = kPlanckConstant * kSpeedOfLight / kBoltzmannConstant * 1e6;

constexpr double kLeastKelvin = 1;
constexpr double kMostKelvin = 1e5;

// Integral of t^3 / (exp(t) - 1) from 0 to x, for x <= 1: by its power series (coefficients of the
// Bernoulli numbers).
double integral_below(double x) {
  const double s = x * x;
  return x * s *
         (1.0 / 3 - x / 8 +
          s * (1.0 / 60 -
               s * (1.0 / 5040 - s * (1.0 / 272160 - s * (1.0 / 13305600 - s / 622702080.0)))));
}

// The same from x to infinity: termwise integral of the geometric series of 1 / (exp(t) - 1).
double integral_above(double x) {
  if (x <= 1) {
    return std::pow(kPi, 4) / 15 - integral_below(x);
  }
  double sum = 0;
  for (int n = 1; n <= 60; ++n) {
    const double y = n * x;
    const double term = std::exp(-y) * (((y + 3) * y + 6) * y + 6) / std::pow(n, 4);
    sum += term;
    if (term <= 1e-17 * sum) {
      break;
    }
  }
  return sum;
}

bool is_band(const Band& band) {
  return band.low_um > 0 && band.high_um > band.low_um && std::isfinite(band.high_um);
}

std::optional<std::array<double, 5>> parse_numbers(std::string_view text, std::size_t count) {
  std::array<double, 5> numbers{};
  const char* at = text.data();
  const char* end = at + text.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [stop, error] = std::from_chars(at, end, numbers[i]);
    const bool last = i + 1 == count;
    if (error != std::errc{} || (last ? stop != end : stop == end || *stop != ',')) {
      return std::nullopt;
    }
    at = last ? stop : stop + 1;
  }
  return numbers;
}

constexpr std::array kCameras = {
    CameraModel{"linear",
                "0.01 degC a count, as the Optris PI450 of the paper; differences only",
                {0.01, 0}},
    CameraModel{
        "optris", "Optris cameras and their recordings: (counts - 1000) / 10 degC", {0.1, -100}},
    CameraModel{"lepton", "FLIR Lepton, TLinear at 0.01 K", {0.01, -kKelvinAtZeroCelsius}},
    CameraModel{"lepton-0.1", "FLIR Lepton, TLinear at 0.1 K", {0.1, -kKelvinAtZeroCelsius}}};

}  // namespace

double planck_radiance(double wavelength_um, double temperature_k) {
  if (!(wavelength_um > 0) || !(temperature_k > 0)) {
    return kNan;
  }
  return kFirst / std::pow(wavelength_um, 5) /
         std::expm1(kSecond / (wavelength_um * temperature_k));
}

double wien_radiance(double wavelength_um, double temperature_k) {
  if (!(wavelength_um > 0) || !(temperature_k > 0)) {
    return kNan;
  }
  return kFirst / std::pow(wavelength_um, 5) * std::exp(-kSecond / (wavelength_um * temperature_k));
}

double wien_peak_um(double temperature_k) {
  return temperature_k > 0 ? kWienDisplacementUmK / temperature_k : kNan;
}

// With x = c2 / (lambda T): c1 (T / c2)^4 times the integral of x^3 / (exp(x) - 1) over the band.
double band_radiance(double temperature_k, const Band& band) {
  if (!(temperature_k > 0) || !is_band(band)) {
    return kNan;
  }
  const double x_high = kSecond / (band.high_um * temperature_k);
  const double x_low = kSecond / (band.low_um * temperature_k);
  // Between small arguments the difference of the small parts is exact, else that of the tails.
  const double integral = x_low <= 1 ? integral_below(x_low) - integral_below(x_high)
                                     : integral_above(x_high) - integral_above(x_low);
  return kFirst * std::pow(temperature_k / kSecond, 4) * integral;
}

// Regula falsi with halving (Illinois) on the logarithm of radiance over 1 / T, which is almost a
// straight line.
Result<double> band_temperature(double radiance, const Band& band) {
  if (!is_band(band)) {
    return failure(ErrorCode::kInvalidArgument,
                   "band: should run from a wavelength above 0 um to a longer one");
  }
  const auto miss = [&](double inverse) {
    return std::log(band_radiance(1 / inverse, band)) - std::log(radiance);
  };
  double hot = 1 / kMostKelvin;
  double cold = 1 / kLeastKelvin;
  double hot_miss = miss(hot);
  double cold_miss = std::max(miss(cold), -1e6);
  if (!(radiance > 0) || !(hot_miss >= 0) || !(cold_miss <= 0)) {
    return failure(ErrorCode::kInvalidArgument,
                   "radiance " + std::to_string(radiance) +
                       " W m^-2 sr^-1: no temperature from 1 to 100000 K has it in this band");
  }
  double inverse = cold;
  for (int i = 0; i < 200 && cold - hot > 1e-14 * cold; ++i) {
    inverse = hot + (cold - hot) * hot_miss / (hot_miss - cold_miss);
    const double here = miss(inverse);
    if (here == 0) {
      break;
    }
    if (here > 0) {
      hot = inverse;
      hot_miss = here;
      cold_miss /= 2;
    } else {
      cold = inverse;
      cold_miss = here;
      hot_miss /= 2;
    }
  }
  return 1 / inverse;
}

Result<CountsModel> CountsModel::create(const LinearResponse& response) {
  if (!(response.degc_per_count > 0) || !std::isfinite(response.degc_per_count) ||
      !std::isfinite(response.degc_at_zero)) {
    return failure(ErrorCode::kInvalidArgument,
                   "linear response: degC per count should be above 0, and both finite");
  }
  return CountsModel(response);
}

Result<CountsModel> CountsModel::create(const PlanckResponse& response) {
  const bool finite =
      std::isfinite(response.r1 + response.b + response.f + response.o + response.r2);
  if (!finite || !(response.r1 > 0) || !(response.b > 0) || !(response.r2 > 0)) {
    return failure(ErrorCode::kInvalidArgument,
                   "Planck response: R1, B and R2 should be above 0, and all five finite");
  }
  return CountsModel(response);
}

// S' = e S + (1 - e) S_r gives R2' = R2 / e and O' = e O - (1 - e) S_r.
Result<PlanckResponse> grey_body_response(const PlanckResponse& response, double emissivity,
                                          double reflected_degc) {
  if (!(emissivity > 0) || emissivity > 1) {
    return failure(ErrorCode::kInvalidArgument,
                   "emissivity " + std::to_string(emissivity) + ": should be above 0, at most 1");
  }
  if (emissivity == 1) {
    return response;
  }
  return CountsModel::create(response).and_then(
      [&](const CountsModel& model) -> Result<PlanckResponse> {
        const double reflected = model.to_counts(reflected_degc);
        if (!std::isfinite(reflected)) {
          return failure(ErrorCode::kInvalidArgument, "reflected temperature " +
                                                          std::to_string(reflected_degc) +
                                                          " degC: the camera has no counts for it");
        }
        PlanckResponse grey = response;
        grey.r2 = response.r2 / emissivity;
        grey.o = emissivity * response.o - (1 - emissivity) * reflected;
        return grey;
      });
}

double CountsModel::to_degc(double counts) const {
  if (const auto* linear = std::get_if<LinearResponse>(&response_)) {
    return counts * linear->degc_per_count + linear->degc_at_zero;
  }
  const PlanckResponse& p = std::get<PlanckResponse>(response_);
  const double signal = counts + p.o;
  const double kelvin = p.b / std::log(p.r1 / (p.r2 * signal) + p.f);
  return signal > 0 && kelvin > 0 ? kelvin - kKelvinAtZeroCelsius : kNan;
}

double CountsModel::to_counts(double degc) const {
  if (const auto* linear = std::get_if<LinearResponse>(&response_)) {
    return (degc - linear->degc_at_zero) / linear->degc_per_count;
  }
  const PlanckResponse& p = std::get<PlanckResponse>(response_);
  const double kelvin = degc + kKelvinAtZeroCelsius;
  const double exponential = std::exp(p.b / kelvin) - p.f;
  return kelvin > 0 && exponential > 0 ? p.r1 / (p.r2 * exponential) - p.o : kNan;
}

double CountsModel::degc_per_count(double counts) const {
  if (const auto* linear = std::get_if<LinearResponse>(&response_)) {
    return linear->degc_per_count;
  }
  // dT / dS = T^2 / B * r / ((r + F) (S + O)) with r = R1 / (R2 (S + O)).
  const PlanckResponse& p = std::get<PlanckResponse>(response_);
  const double kelvin = to_degc(counts) + kKelvinAtZeroCelsius;
  const double signal = counts + p.o;
  const double ratio = p.r1 / (p.r2 * signal);
  return kelvin * kelvin / p.b * ratio / ((ratio + p.f) * signal);
}

std::span<const CameraModel> camera_models() { return kCameras; }

Result<CountsModel> parse_counts_model(std::string_view text) {
  for (const CameraModel& camera : kCameras) {
    if (camera.name == text) {
      return CountsModel::create(camera.response);
    }
  }
  if (text.starts_with("linear:")) {
    if (const auto n = parse_numbers(text.substr(7), 2)) {
      return CountsModel::create(LinearResponse{(*n)[0], (*n)[1]});
    }
  } else if (text.starts_with("planck:")) {
    if (const auto n = parse_numbers(text.substr(7), 5)) {
      return CountsModel::create(PlanckResponse{(*n)[0], (*n)[1], (*n)[2], (*n)[3], (*n)[4]});
    }
  }
  std::string names;
  for (const CameraModel& camera : kCameras) {
    names += std::string(camera.name) + ", ";
  }
  return failure(ErrorCode::kInvalidArgument, "camera " + std::string(text) + ": should be " +
                                                  names +
                                                  "linear:DEGC_PER_COUNT,DEGC_AT_ZERO or "
                                                  "planck:R1,B,F,O,R2");
}

}  // namespace thermedge

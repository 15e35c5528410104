// Thermal radiation and what a camera makes of it: Planck, Wien, radiance within a band, counts and
// degrees (paper section 2.1).
#pragma once

#include <span>
#include <string_view>
#include <variant>

#include "thermedge/result.hpp"

namespace thermedge {

inline constexpr double kKelvinAtZeroCelsius = 273.15;

// Constants of radiation, from the exact SI values of h, c and k (2019).
inline constexpr double kPlanckConstant = 6.62607015e-34;    // J s
inline constexpr double kSpeedOfLight = 299792458.0;         // m / s
inline constexpr double kBoltzmannConstant = 1.380649e-23;   // J / K
inline constexpr double kWienDisplacementUmK = 2897.771955;  // um K
inline constexpr double kStefanBoltzmann = 5.670374419e-8;   // W m^-2 K^-4

// All radiances are those of a black body into a unit of solid angle; times pi they are the
// exitance into the half space, the other usual form of eq. 1. Wavelengths in um (vacuum),
// temperatures in K. Arguments that are not positive give NaN. Thread-safe, nothing is allocated.

// Spectral radiance, W m^-2 sr^-1 um^-1 (Planck's law, paper eq. 1):
// 2 h c^2 / lambda^5 / (exp(h c / (lambda k T)) - 1).
[[nodiscard]] double planck_radiance(double wavelength_um, double temperature_k);

// Wien's approximation of it, 2 h c^2 / lambda^5 exp(-h c / (lambda k T)): 1 % low where
// lambda T = 3100 um K, less below.
[[nodiscard]] double wien_radiance(double wavelength_um, double temperature_k);

// Wavelength of the largest spectral radiance, um (Wien's displacement law, paper eq. 2).
[[nodiscard]] double wien_peak_um(double temperature_k);

struct Band {
  double low_um = 7.5;  // the usual uncooled LWIR camera
  double high_um = 13;
};

// Radiance within the band, W m^-2 sr^-1; relative error below 1e-9. Cost: about 0.5 us at room
// temperature. A band that is empty or negative gives NaN.
[[nodiscard]] double band_radiance(double temperature_k, const Band& band = {});

// The temperature of a black body with this radiance within the band, K, to better than 1e-6 K from
// 150 to 3000 K. Errors: no such temperature between 1 and 100000 K, a band as above.
[[nodiscard]] Result<double> band_temperature(double radiance, const Band& band = {});

// degC = counts * degc_per_count + degc_at_zero.
struct LinearResponse {
  double degc_per_count = 0.01;
  double degc_at_zero = 0;
};

// T = B / ln(R1 / (R2 (counts + O)) + F) kelvin: the calibration that FLIR cameras store with a
// picture, for an object of emissivity 1 without atmosphere.
struct PlanckResponse {
  double r1 = 0, b = 0, f = 1, o = 0, r2 = 1;
};

// The same camera before an object of this emissivity that reflects surroundings of this
// temperature: counts = e * counts(T) + (1 - e) * counts(reflected), without the atmosphere in
// between. Again of Planck's form. Fails where the emissivity is not above 0 and at most 1, or
// where the camera has no counts for the reflected temperature.
[[nodiscard]] Result<PlanckResponse> grey_body_response(const PlanckResponse& response,
                                                        double emissivity, double reflected_degc);

// How counts and degrees belong together. A value; thread-safe.
class CountsModel {
 public:
  CountsModel() = default;
  // Fails where the response does not grow with temperature or is not finite.
  [[nodiscard]] static Result<CountsModel> create(const LinearResponse& response);
  [[nodiscard]] static Result<CountsModel> create(const PlanckResponse& response);

  // NaN where the model has no such temperature or count.
  [[nodiscard]] double to_degc(double counts) const;
  [[nodiscard]] double to_counts(double degc) const;
  // Whether a count is worth the same everywhere.
  [[nodiscard]] bool is_linear() const { return std::holds_alternative<LinearResponse>(response_); }
  // Worth of a count at `counts`, degC.
  [[nodiscard]] double degc_per_count(double counts) const;

 private:
  explicit CountsModel(std::variant<LinearResponse, PlanckResponse> response)
      : response_(response) {}
  std::variant<LinearResponse, PlanckResponse> response_;
};

struct CameraModel {
  std::string_view name;
  std::string_view description;
  LinearResponse response;
};

// Cameras whose counts mean the same for every one of them.
[[nodiscard]] std::span<const CameraModel> camera_models();

// A name of camera_models(), "linear:DEGC_PER_COUNT,DEGC_AT_ZERO" or "planck:R1,B,F,O,R2".
// Fails with a line that says so.
[[nodiscard]] Result<CountsModel> parse_counts_model(std::string_view text);

}  // namespace thermedge

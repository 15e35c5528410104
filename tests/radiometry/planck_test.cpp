// Radiation against published constants, closed forms and tables.
#include "thermedge/radiometry/planck.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace thermedge {
namespace {

constexpr double kEverythingLow = 0.05;  // um
constexpr double kEverythingHigh = 1e6;

TEST(Planck, HasThePublishedRadianceAtRoomTemperature) {
  // First radiation constant for radiance 1.191042972e8 W um^4 m^-2 sr^-1, second 14387.76877 um K
  // (CODATA 2018).
  const double wanted = 1.191042972e8 / std::pow(10.0, 5) / (std::exp(14387.76877 / 3000) - 1);
  EXPECT_NEAR(planck_radiance(10, 300), wanted, 1e-8 * wanted);
  EXPECT_NEAR(planck_radiance(10, 300), 9.924, 0.001);
}

TEST(Planck, PeaksWhereWienSays) {
  for (const double kelvin : {150.0, 300.0, 1000.0, 5772.0}) {
    double low = 0.2 * wien_peak_um(kelvin), high = 5 * wien_peak_um(kelvin);
    while (high - low > 1e-9 * high) {  // golden section
      const double a = high - (high - low) / std::numbers::phi;
      const double b = low + (high - low) / std::numbers::phi;
      (planck_radiance(a, kelvin) > planck_radiance(b, kelvin) ? high : low) =
          planck_radiance(a, kelvin) > planck_radiance(b, kelvin) ? b : a;
    }
    EXPECT_NEAR(low * kelvin, 2897.771955, 0.01) << kelvin;
  }
}

TEST(Planck, IsTheSlopeOfTheBandRadiance) {
  for (const double kelvin : {150.0, 300.0, 3000.0}) {
    for (const double um : {0.8, 4.0, 10.0, 60.0}) {
      const Band narrow = {um * 0.99995, um * 1.00005};
      const double slope = band_radiance(kelvin, narrow) / (narrow.high_um - narrow.low_um);
      EXPECT_NEAR(slope / planck_radiance(um, kelvin), 1, 1e-5) << um << " um " << kelvin << " K";
    }
  }
}

TEST(Wien, IsOnePercentLowAt3100UmKAndTheLimitBelow) {
  EXPECT_NEAR(wien_radiance(10, 310) / planck_radiance(10, 310), 0.99, 0.0005);
  double before = 0.5;
  for (const double product : {6000.0, 4000.0, 3000.0, 2000.0, 1000.0}) {
    const double ratio = wien_radiance(product / 300, 300) / planck_radiance(product / 300, 300);
    EXPECT_GT(ratio, before);
    EXPECT_LT(ratio, 1);
    before = ratio;
  }
  EXPECT_NEAR(before, 1, 1e-6);
}

TEST(Band, OfAllWavelengthsIsStefanBoltzmann) {
  for (const double kelvin : {150.0, 300.0, 1200.0, 3000.0}) {
    const double exitance =
        std::numbers::pi * band_radiance(kelvin, {kEverythingLow, kEverythingHigh});
    EXPECT_NEAR(exitance / (5.670374419e-8 * std::pow(kelvin, 4)), 1, 1e-8) << kelvin;
  }
}

TEST(Band, FractionsAreThoseOfTheTable) {
  // Fraction of the emission below lambda T, um K (Incropera & DeWitt, table 12.1).
  const struct {
    double product, fraction;
  } kTable[] = {{1000, 0.000321}, {2000, 0.066728},  {2898, 0.250108},  {4000, 0.480877},
                {6000, 0.737818}, {10000, 0.914199}, {20000, 0.985602}, {50000, 0.998953}};
  for (const auto& [product, fraction] : kTable) {
    for (const double kelvin : {300.0, 2000.0}) {
      const double below = band_radiance(kelvin, {100 / kelvin, product / kelvin});
      const double all = kStefanBoltzmann * std::pow(kelvin, 4) / std::numbers::pi;
      EXPECT_NEAR(below / all, fraction, 5e-5) << product;
    }
  }
}

TEST(Band, AgreesWithQuadrature) {
  for (const double kelvin : {150.0, 250.0, 300.0, 400.0, 1000.0, 3000.0}) {
    constexpr int kSteps = 2000;  // Simpson
    const Band band;
    const double step = (band.high_um - band.low_um) / kSteps;
    double sum = 0;
    for (int i = 0; i <= kSteps; ++i) {
      const double weight = i == 0 || i == kSteps ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight * planck_radiance(band.low_um + i * step, kelvin);
    }
    EXPECT_NEAR(band_radiance(kelvin) / (sum * step / 3), 1, 1e-9) << kelvin;
  }
}

TEST(Band, AddsUp) {
  for (const double kelvin : {150.0, 300.0, 2000.0, 20000.0}) {
    const double whole = band_radiance(kelvin, {2, 40});
    EXPECT_NEAR(band_radiance(kelvin, {2, 9}) + band_radiance(kelvin, {9, 40}), whole,
                1e-12 * whole);
  }
}

TEST(BandTemperature, InvertsTheBandRadiance) {
  for (const Band& band : {Band{}, Band{3, 5}, Band{8, 14}, Band{0.9, 1.7}, Band{1, 100}}) {
    for (double kelvin = 150; kelvin <= 3000; kelvin *= 1.01) {
      const auto found = band_temperature(band_radiance(kelvin, band), band);
      ASSERT_TRUE(found) << kelvin;
      EXPECT_NEAR(*found, kelvin, 1e-6) << band.low_um << " um";
    }
  }
}

TEST(BandTemperature, RefusesWhatNoTemperatureHas) {
  for (const double radiance :
       {0.0, -1.0, std::nan(""), 1e30, std::numeric_limits<double>::infinity()}) {
    const auto found = band_temperature(radiance);
    ASSERT_FALSE(found) << radiance;
    EXPECT_NE(found.error().message.find("radiance"), std::string::npos);
  }
  for (const Band& band :
       {Band{0, 5}, Band{5, 5}, Band{9, 8}, Band{-1, 3}, Band{1, std::nan("")}}) {
    EXPECT_FALSE(band_temperature(10, band));
    EXPECT_TRUE(std::isnan(band_radiance(300, band)));
  }
  for (const double bad : {0.0, -300.0, std::nan("")}) {
    EXPECT_TRUE(std::isnan(planck_radiance(10, bad)));
    EXPECT_TRUE(std::isnan(planck_radiance(bad, 300)));
    EXPECT_TRUE(std::isnan(wien_radiance(bad, 300)));
    EXPECT_TRUE(std::isnan(wien_peak_um(bad)));
    EXPECT_TRUE(std::isnan(band_radiance(bad)));
  }
}

TEST(CountsModel, KnowsTheCameras) {
  const struct {
    const char* camera;
    double counts, degc;
  } kTable[] = {{"linear", 2500, 25},
                {"optris", 1250, 25},
                {"optris", 1000, 0},
                {"lepton", 29815, 25},
                {"lepton", 27315, 0},
                {"lepton-0.1", 2981.5, 25},
                {"linear:0.04,-273.15", 7453.75, 25}};
  for (const auto& [camera, counts, degc] : kTable) {
    const auto model = parse_counts_model(camera);
    ASSERT_TRUE(model) << camera;
    EXPECT_NEAR(model->to_degc(counts), degc, 1e-9) << camera;
    EXPECT_NEAR(model->to_counts(degc), counts, 1e-7) << camera;
    EXPECT_TRUE(model->is_linear()) << camera;
  }
  EXPECT_GE(camera_models().size(), 4U);
}

TEST(CountsModel, PlanckOfAFlirCamera) {
  // Constants in the range that FLIR E-series pictures carry.
  const auto model = parse_counts_model("planck:14906.216,1396.5,1,-7261,0.010956882");
  ASSERT_TRUE(model);
  EXPECT_FALSE(model->is_linear());
  // By hand: S + O = 8739, R1 / (R2 8739) = 155.676, ln(156.676) = 5.05418, 1396.5 / that =
  // 276.306.
  EXPECT_NEAR(model->to_degc(16000), 276.306 - 273.15, 0.01);
  for (const double counts : {9000.0, 12000.0, 16000.0, 30000.0, 60000.0}) {
    EXPECT_NEAR(model->to_counts(model->to_degc(counts)), counts, 1e-6 * counts);
    const double slope = (model->to_degc(counts + 1) - model->to_degc(counts - 1)) / 2;
    EXPECT_NEAR(model->degc_per_count(counts) / slope, 1, 1e-6);
  }
  EXPECT_TRUE(std::isnan(model->to_degc(7000)));  // below the offset: no temperature
  EXPECT_TRUE(std::isnan(model->to_counts(-300)));
}

// What the camera sees of an object of emissivity e is e of it and the rest of its surroundings.
TEST(GreyBody, IsACameraOfItsOwn) {
  const PlanckResponse response{14906.216, 1396.5, 1, -7261, 0.010956882};
  const auto black = CountsModel::create(response);
  const auto grey = grey_body_response(response, 0.8, 25).and_then([](const PlanckResponse& r) {
    return CountsModel::create(r);
  });
  ASSERT_TRUE(black && grey);
  for (const double degc : {-20.0, 25.0, 80.0, 400.0}) {
    const double seen = 0.8 * black->to_counts(degc) + 0.2 * black->to_counts(25);
    EXPECT_NEAR(grey->to_degc(seen), degc, 1e-6);
  }
  EXPECT_EQ(grey_body_response(response, 1, -1000)->o, response.o) << "it reflects nothing";
  for (const double emissivity : {0.0, -0.5, 1.01, std::nan("")}) {
    EXPECT_FALSE(grey_body_response(response, emissivity, 20)) << emissivity;
  }
  EXPECT_FALSE(grey_body_response(response, 0.5, -300)) << "below absolute zero";
}

TEST(CountsModel, RefusesWhatIsNoModel) {
  for (const std::string text :
       {"", "magic", "linear:", "linear:0.01", "linear:0,1", "linear:-1,0", "linear:0.01,0,3",
        "linear:nan,0", "planck:1,2,3,4", "planck:0,1,1,1,1", "planck:1,2,3,4,5x"}) {
    const auto model = parse_counts_model(text);
    ASSERT_FALSE(model) << text;
    EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
  }
  EXPECT_NE(parse_counts_model("magic").error().message.find("optris"), std::string::npos);
}

}  // namespace
}  // namespace thermedge

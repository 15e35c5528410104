// Each option changes something under the presets that have it, and is refused by the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "thermedge/detector.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/sim/scene.hpp"

namespace thermedge {
namespace {

using Settings = std::vector<std::string>;

// One option, its value in a preset, and other values to try.
struct Option {
  std::string name;
  std::string value;
  Settings others;
};

// Collects the options of a preset by their full names.
class OptionCollector {
 public:
  template <class T>
  void operator()(std::string_view name, const T& value, Bounds bounds, std::string_view) {
    Option option{prefix_ + std::string(name), text_of(value), {}};
    const auto add = [&](double other) {
      const T valid = static_cast<T>(std::clamp(other, bounds.min, bounds.max));
      if (valid != value) {
        option.others.push_back(text_of(valid));
      }
    };
    if constexpr (std::is_same_v<T, bool>) {
      option.others = {text_of(!value)};
    } else {
      const auto number = static_cast<double>(value);
      for (const double other :
           {number + 2, 2 * number, number / 2, number / 1e6, 1.0, bounds.max, bounds.min}) {
        add(other);
      }
    }
    options.push_back(std::move(option));
  }

  template <class E, class Names>
  requires std::is_enum_v<E>
  void operator()(std::string_view name, const E& value, const Names& names, std::string_view) {
    Option option{prefix_ + std::string(name), {}, {}};
    for (const auto& known : names) {
      if (known.value == value) {
        option.value = known.name;
      } else {
        option.others.emplace_back(known.name);
      }
    }
    options.push_back(std::move(option));
  }

  template <class Unit, std::size_t N>
  void operator()(std::string_view name, const Quantity<Unit>& value,
                  const QuantityRange<Unit, N>& range, std::string_view) {
    Option option{prefix_ + std::string(name), detail::quantity_text(value, range.units), {}};
    for (const EnumName<Unit>& unit : range.units) {
      for (const double number : {1.0, 10.0, 100.0}) {
        option.others.push_back(text_of(number) + std::string(unit.name));
      }
    }
    options.push_back(std::move(option));
  }

  template <class O>
  void group(std::string_view name, const O& nested) {
    const std::string outer = prefix_;
    prefix_ += std::string(name) + ".";
    visit_options(nested, *this);
    prefix_ = outer;
  }

  std::vector<Option> options;

 private:
  static std::string text_of(bool value) { return value ? "true" : "false"; }
  static std::string text_of(int value) { return std::to_string(value); }
  static std::string text_of(double value) { return detail::shortest_text(value); }

  std::string prefix_;
};

std::vector<Option> options_of(Preset preset) {
  OptionCollector collector;
  const DetectorOptions options(preset);
  visit_options(options, collector);
  return std::move(collector.options);
}

// What an option needs before it matters; the same for all presets.
struct Need {
  std::string_view prefix;  // of the option's name
  std::string_view setting;
};
constexpr std::array kNeeds = {
    Need{"denoise.gaussian.", "denoise.method=gaussian"},
    Need{"denoise.nlm.", "denoise.method=nlm"},
    Need{"denoise.bm3d.", "denoise.method=bm3d"},
    // Only nlm and bm3d are told the noise.
    Need{"denoise.sigma_scale", "denoise.method=bm3d"},
    // Its reach matters where the filter is on at all.
    Need{"denoise.bilateral.space_px", "denoise.bilateral.range_sigmas=0.5"},
    // The worth of a count matters where a contrast is asked for in degrees.
    Need{"selection.degc_per_count", "selection.degc_per_count=1"},
    Need{"selection.degc_per_count", "selection.min_contrast=20degC"},
};

Settings needs_of(const std::string& option) {
  Settings settings;
  for (const Need& need : kNeeds) {
    if (option.starts_with(need.prefix)) {
      settings.emplace_back(need.setting);
    }
  }
  return settings;
}

// Whether the settings make valid options.
bool apply_all(const Settings& settings, DetectorOptions& options) {
  return std::all_of(settings.begin(), settings.end(),
                     [&](const std::string& setting) {
                       return io::apply_setting(setting, options).has_value();
                     }) &&
         options.check();
}

using Counts = Image<std::uint16_t>;

Counts render(std::string name, double sigma_counts) {
  sim::SceneOptions scene;
  scene.name = std::move(name);
  scene.camera.width = 160;
  scene.camera.height = 120;
  scene.camera.sigma_counts = sigma_counts;
  scene.camera.column_sigma_counts = sigma_counts / 2;
  auto frame = sim::render(scene, 0);
  EXPECT_TRUE(frame);
  return std::move(frame->counts);
}

// Noise of a hundredth of the range, of a tenth, and none; scenes with and without loops; pixels
// that are no measurement.
const std::vector<Counts>& frames() {
  static const std::vector<Counts> all = [] {
    std::vector<Counts> made;
    made.push_back(render("desk", 20));
    made.push_back(render("desk", 200));
    made.push_back(render("office", 0));
    made.push_back(render("road", 20));
    // With a black corner.
    made.push_back(render("desk", 20));
    for (int y = 0; y < 40; ++y) {
      std::fill_n(made.back().row(y), 60 - y, std::uint16_t{0});
    }
    return made;
  }();
  return all;
}

// The pixels, corners and score of each edge, whether kept or not, in an order of their own. What
// follows from its significance (log10_nfa, the order of the edges, which are kept) is left out: an
// option is effective only where it changes the edges themselves.
using EdgeShapes = std::vector<std::vector<double>>;

EdgeShapes shapes_of(const EdgeSet& set) {
  EdgeShapes shapes;
  for (const Edge& edge : set.edges) {
    std::vector<double> shape = {edge.score, edge.closed ? 1.0 : 0.0};
    for (const Point point : set.points_of(edge)) {
      shape.push_back(static_cast<double>(point.x));
      shape.push_back(static_cast<double>(point.y));
    }
    for (const std::uint32_t corner : set.corners_of(edge)) {
      shape.push_back(corner);
    }
    shapes.push_back(std::move(shape));
  }
  std::sort(shapes.begin(), shapes.end());
  return shapes;
}

EdgeShapes kept_of(const EdgeSet& set) {
  EdgeSet kept = set;
  kept.edges.resize(set.kept);
  return shapes_of(kept);
}

// What options of `selection` are judged by, and what all others are.
EdgeShapes observe(const DetectorOptions& options, const Counts& frame, bool selects) {
  auto detector = Detector::create(options);
  EXPECT_TRUE(detector);
  const auto detection = detector->detect(frame);
  EXPECT_TRUE(detection);
  return selects ? kept_of(detection->edges) : shapes_of(detection->edges);
}

// Whether one of the option's other values changes the result on one of the frames.
bool has_effect(Preset preset, const Option& option) {
  const bool selects = option.name.starts_with("selection.");
  DetectorOptions base(preset);
  base.threads = 1;
  EXPECT_TRUE(apply_all(needs_of(option.name), base)) << option.name;
  for (const Counts& frame : frames()) {
    const EdgeShapes before = observe(base, frame, selects);
    EXPECT_GT(before.size(), 3U);
    for (const std::string& other : option.others) {
      DetectorOptions changed = base;
      if (apply_all({option.name + "=" + other}, changed) &&
          observe(changed, frame, selects) != before) {
        return true;
      }
    }
  }
  return false;
}

class OptionMatrix : public testing::TestWithParam<Preset> {};

TEST_P(OptionMatrix, EachOptionOfThePresetChangesTheResult) {
  for (const Option& option : options_of(GetParam())) {
    if (option.name == "threads") {
      continue;  // Results are the same for every number of threads.
    }
    EXPECT_TRUE(has_effect(GetParam(), option)) << option.name;
  }
}

TEST_P(OptionMatrix, OptionsThatThePresetLacksAreRefusedByName) {
  DetectorOptions options(GetParam());
  const std::vector<Option> own = options_of(GetParam());
  const Preset other = GetParam() == Preset::kPaper ? Preset::kRobust : Preset::kPaper;
  int refused = 0;
  for (const Option& option : options_of(other)) {
    if (std::any_of(own.begin(), own.end(),
                    [&](const Option& known) { return known.name == option.name; })) {
      continue;
    }
    const Status status = io::apply_setting(option.name + "=" + option.value, options);
    ASSERT_FALSE(status) << option.name;
    EXPECT_EQ(status.error().option, option.name);
    EXPECT_EQ(status.error().message, "unknown option '" + option.name + "': preset " +
                                          std::string(preset_name(GetParam())) +
                                          " does not use it, preset " +
                                          std::string(preset_name(other)) + " does");
    ++refused;
  }
  EXPECT_GT(refused, 10);
}

TEST_P(OptionMatrix, OptionsOfADenoiserThatIsNotTheChosenOneAreRefusedByName) {
  const std::string method = std::string(
      kDenoiseMethods[static_cast<std::size_t>(DetectorOptions(GetParam()).denoise.method)].name);
  int refused = 0;
  for (const Option& option : options_of(GetParam())) {
    const bool of_other = option.name.starts_with("denoise.gaussian.") ||
                          option.name.starts_with("denoise.nlm.") ||
                          option.name.starts_with("denoise.bm3d.");
    if (!of_other || option.name.starts_with("denoise." + method + ".")) {
      continue;
    }
    DetectorOptions changed(GetParam());
    ASSERT_TRUE(io::apply_setting(option.name + "=" + option.others.front(), changed));
    const Status status = changed.check();
    ASSERT_FALSE(status) << option.name;
    EXPECT_TRUE(status.error().message.starts_with(option.name + " is used with denoise.method"))
        << status.error().message;
    ++refused;
  }
  EXPECT_GT(refused, 3);
}

INSTANTIATE_TEST_SUITE_P(Presets, OptionMatrix,
                         testing::Values(Preset::kRobust, Preset::kFast, Preset::kPaper),
                         [](const auto& preset) { return std::string(preset_name(preset.param)); });

}  // namespace
}  // namespace thermedge

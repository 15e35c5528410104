// What each denoiser does for each detector.
#include <fmt/core.h>

#include "csv.hpp"
#include "figures.hpp"
#include "measuring.hpp"
#include "thermedge/detector.hpp"
#include "thermedge/edge_fields.hpp"
#include "value_or_exit.hpp"

namespace thermedge::bench {
namespace {

struct Frames {
  int noise;  // counts
  std::vector<TestFrame> tuning, test;
};

void add_row(const Frames& frames, const std::string& denoiser, const Competitor& competitor,
             Csv& csv) {
  const std::size_t setting = best_setting(competitor, frames.tuning);
  const Performance p = measure(competitor, setting, frames.test);
  csv.add(fmt::format("{},{},{},{},{},{},{:.3f}", frames.noise, denoiser, competitor.name,
                      competitor.setting_name(setting), frames.test.size(), quality_cells(p.counts),
                      p.ms));
}

// All stages of preset `paper` that come after its denoiser.
Finder paper_after_denoiser() {
  DetectorOptions options = DetectorOptions(Preset::kPaper);
  options.denoise.method = DenoiseMethod::kNone;
  options.threads = 1;
  const auto detector = std::make_shared<Detector>(value_or_exit(Detector::create(options)));
  return {"defaults",
          [detector](ImageView<const std::uint8_t> levels, ImageView<std::uint8_t> map) {
            Image<std::uint16_t> counts(levels.width(), levels.height());
            copy_pixels(levels, counts.view());
            draw_mask(value_or_exit(detector->detect(Frame(counts, 8))).edges, map);
          }};
}

}  // namespace

void measure_denoisers(const BenchOptions& options) {
  const std::vector<CleanScene> tuning = random_scenes(1000, (options.scenes + 1) / 2);
  const std::vector<CleanScene> test = random_scenes(2000, options.scenes);
  Csv csv(options.out + "/denoisers_and_detectors.csv",
          "noise_counts,denoiser,detector,setting,frames,f,precision,recall,ms");
  for (const int noise : {8, 20}) {
    const Frames frames{noise, exposed(tuning, noise, 1000), exposed(test, noise, 2000)};
    for (const FrontEnd& front : denoising_fronts()) {
      for (Competitor& detector : detectors_on_levels()) {
        detector.fronts = {front};
        add_row(frames, front.name, detector, csv);
      }
      add_row(frames, front.name,
              {"thermedge paper", "thermedge", {}, {front}, {paper_after_denoiser()}}, csv);
    }
    // On counts instead of levels, so that only the methods of the library can stand in front.
    for (const auto& [name, method] : {std::pair{"none", DenoiseMethod::kNone},
                                       {"Gaussian", DenoiseMethod::kGaussian},
                                       {"NL-means", DenoiseMethod::kNlm},
                                       {"BM3D", DenoiseMethod::kBm3d}}) {
      DetectorOptions robust = DetectorOptions(Preset::kRobust);
      robust.denoise.method = method;
      add_row(frames, name, thermedge_competitor("thermedge robust", robust), csv);
    }
  }
  csv.write();
}

}  // namespace thermedge::bench

// The options of the whole detector.
#pragma once

#include <string>
#include <variant>

#include "thermedge/option_list.hpp"
#include "thermedge/presets.hpp"
#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/bad_pixels.hpp"
#include "thermedge/stages/canny.hpp"
#include "thermedge/stages/contours.hpp"
#include "thermedge/stages/corners.hpp"
#include "thermedge/stages/corners_paper.hpp"
#include "thermedge/stages/denoiser.hpp"
#include "thermedge/stages/edge_graph.hpp"
#include "thermedge/stages/gap_closing.hpp"
#include "thermedge/stages/linking.hpp"
#include "thermedge/stages/oriented_filter.hpp"
#include "thermedge/stages/scoring.hpp"
#include "thermedge/stages/selection.hpp"
#include "thermedge/stages/stripes.hpp"
#include "thermedge/stages/validity.hpp"

namespace thermedge {

// Stages that only the presets robust and fast have.
struct RobustOptions {
  OrientedFilterOptions oriented_filter;
  GraphOptions graph;
  GapClosingOptions gap_closing;
  CornerOptions corners;

  [[nodiscard]] Status check() const;
};

// Stages that only preset paper has.
struct PaperOptions {
  GreyScaleOptions grey_scale;
  CannyOptions canny{.blur = true};
  ContourOptions contours;
  LinkingOptions linking;
  PaperCornerOptions corners;
  ScoringOptions scoring;

  [[nodiscard]] Status check() const;
};

// A preset, and what was changed of it. The preset is chosen once; an option that it does not use
// does not exist here.
class DetectorOptions {
 public:
  DetectorOptions() : DetectorOptions(Preset::kRobust) {}
  explicit DetectorOptions(Preset preset);

  [[nodiscard]] Preset preset() const { return preset_; }

  int threads = 0;            // 0: one per core, 0..1024
  std::string simd = "auto";  // instruction set of the kernels: auto, or a name of simd_targets()
  // Stages that every preset has.
  ValidityOptions validity;
  BadPixelOptions bad_pixels;
  StripeOptions stripes;
  DenoiseOptions denoise;
  SelectionOptions selection;

  // Those of one kind of preset; null where the preset is of the other kind.
  [[nodiscard]] RobustOptions* robust() { return std::get_if<RobustOptions>(&own_); }
  [[nodiscard]] const RobustOptions* robust() const { return std::get_if<RobustOptions>(&own_); }
  [[nodiscard]] PaperOptions* paper() { return std::get_if<PaperOptions>(&own_); }
  [[nodiscard]] const PaperOptions* paper() const { return std::get_if<PaperOptions>(&own_); }

  // Fails with one line that names the first option that is out of its range, at odds with another
  // one, or set though nothing uses it (that of a denoiser which is not the chosen one).
  [[nodiscard]] Status check() const;

 private:
  Preset preset_;
  std::variant<RobustOptions, PaperOptions> own_;
};

template <OptionsOf<RobustOptions> O, class V>
void visit_options(O& o, V&& v) {
  v.group("oriented_filter", o.oriented_filter);
  v.group("graph", o.graph);
  v.group("gap_closing", o.gap_closing);
  v.group("corners", o.corners);
}

template <OptionsOf<PaperOptions> O, class V>
void visit_options(O& o, V&& v) {
  v.group("grey_scale", o.grey_scale);
  v.group("canny", o.canny);
  v.group("contours", o.contours);
  v.group("linking", o.linking);
  v.group("corners", o.corners);
  v.group("scoring", o.scoring);
}

template <OptionsOf<DetectorOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("threads", o.threads, Bounds{0, 1024}, "threads (0: one per core)");
  v.group("validity", o.validity);
  v.group("bad_pixels", o.bad_pixels);
  v.group("stripes", o.stripes);
  v.group("denoise", o.denoise);
  if (auto* robust = o.robust()) {
    visit_options(*robust, v);
  }
  if (auto* paper = o.paper()) {
    visit_options(*paper, v);
  }
  if (o.paper()) {
    const SelectionWithoutContrast selection{o.selection};
    v.group("selection", selection);
  } else {
    v.group("selection", o.selection);
  }
}

}  // namespace thermedge

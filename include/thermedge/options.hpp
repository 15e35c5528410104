// The options of the whole detector, and every option with its name, range and meaning in one
// place: the range checks, the TOML reader and writer, `--set` and `--dump-config` all walk these
// lists.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "thermedge/radiometry/grey_scale.hpp"
#include "thermedge/radiometry/stable_grey_scale.hpp"
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

namespace thermedge {

// Named sets of defaults. A preset is nothing but options: what it sets can be changed one by one.
enum class Preset {
  kRobust,  // the default: the best edges
  kFast,    // the same behind a Gaussian and a bilateral filter instead of BM3D
  kPaper,   // the paper to the letter; what the structs of the stages default to
};

// How edge pixels are found, and what follows from it.
enum class EdgeMethod {
  kCanny,     // the paper: on the denoised 8-bit view; contours by walking, linked; ranked by ES
  kOriented,  // on denoised counts, in units of the noise: oriented kernels; contours by a graph of
              // segments and junctions; ranked by suppressed_response and length, tested on the raw
              // frame
};

namespace detail {
BadPixelOptions robust_nuc();
DenoiseOptions robust_denoise();
SelectionOptions robust_selection();
}  // namespace detail

struct DetectorOptions {
  Preset preset = Preset::kRobust;
  EdgeMethod edges = EdgeMethod::kOriented;
  int threads = 0;  // 0: one per core
  BadPixelOptions nuc = detail::robust_nuc();
  GreyScaleOptions scale;
  DenoiseOptions denoise = detail::robust_denoise();
  CannyOptions canny;
  OrientedFilterOptions oriented;
  ContourOptions contours;
  GraphOptions graph;
  GapClosingOptions gap_closing;
  PaperCornerOptions paper_corners;
  CornerOptions corners;
  LinkingOptions linking;
  ScoringOptions scoring;
  SelectionOptions selection = detail::robust_selection();
};

[[nodiscard]] DetectorOptions preset_options(Preset preset);
[[nodiscard]] std::string_view preset_name(Preset preset);

// Fails with one line that names the first option out of range and its range.
[[nodiscard]] Status check_options(const DetectorOptions& options);

struct Bounds {
  double min;
  double max;
};

template <class E>
struct EnumName {
  E value;
  std::string_view name;
};
template <class E>
EnumName(E, std::string_view) -> EnumName<E>;

inline constexpr std::array kDenoiseMethods = {
    EnumName{DenoiseMethod::kNone, "none"}, EnumName{DenoiseMethod::kGaussian, "gaussian"},
    EnumName{DenoiseMethod::kNlm, "nlm"}, EnumName{DenoiseMethod::kBm3d, "bm3d"}};
inline constexpr std::array kBm3dProfiles = {EnumName{Bm3dProfile::kQuality, "quality"},
                                             EnumName{Bm3dProfile::kBalanced, "balanced"},
                                             EnumName{Bm3dProfile::kFast, "fast"}};
inline constexpr std::array kPresets = {EnumName{Preset::kRobust, "robust"},
                                        EnumName{Preset::kFast, "fast"},
                                        EnumName{Preset::kPaper, "paper"}};
inline constexpr std::array kEdgeMethods = {EnumName{EdgeMethod::kCanny, "canny"},
                                            EnumName{EdgeMethod::kOriented, "oriented"}};

template <class O, class Options>
concept OptionsOf = std::same_as<std::remove_const_t<O>, Options>;

// visit_options(options, visitor) calls, for each field in order,
//   visitor(name, field, bounds, help)   numbers: bool, int, double (bool has bounds 0..1)
//   visitor(name, field, names, help)    enumerations, `names` an array of EnumName
// Nested option structs are visited under "<name>." by the visitor's own `group(name, options)`.

template <OptionsOf<BadPixelOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("bad_pixels", o.bad_pixels, Bounds{0, 1}, "replace dead pixels by their neighbours' median");
  v("threshold_sigmas", o.threshold_sigmas, Bounds{1, 1000},
    "how far outside its neighbours' range a pixel is dead, in sigma");
  v("stripes", o.stripes, Bounds{0, 1}, "remove the fixed offsets of columns and rows");
}

template <OptionsOf<GreyScaleOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gain", o.gain, Bounds{1e-6, 1000}, "grey levels per count (0.5: 0.02 degC a level)");
}

template <OptionsOf<StableGreyScaleOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gain", o.gain, Bounds{0, 1000}, "grey levels per count (0: from the noise)");
  v("dead_band_levels", o.dead_band_levels, Bounds{0, 127},
    "levels that the median may move before the view follows");
  v("slew_levels", o.slew_levels, Bounds{0, 255}, "levels a frame that the view may move");
  v("cut_clipped_share", o.cut_clipped_share, Bounds{0, 1}, "clipped share that means a scene cut");
  v("cut_frames", o.cut_frames, Bounds{1, 1000}, "clipped frames in a row that mean a scene cut");
}

template <OptionsOf<GaussianOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("sigma_px", o.sigma_px, Bounds{0, 20}, "standard deviation, px (0: the 5x5 kernel of eq. 5)");
}

template <OptionsOf<NlmOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("patch_px", o.patch_px, Bounds{1, 15}, "side of the compared patches, odd, px");
  v("search_px", o.search_px, Bounds{1, 41}, "diameter of the search disc, odd, px");
  v("h_over_sigma", o.h_over_sigma, Bounds{0.1, 5}, "filter strength in units of the noise");
}

template <OptionsOf<Bm3dOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("profile", o.profile, kBm3dProfiles, "quality, balanced or fast");
  v("lambda", o.lambda, Bounds{0.5, 10}, "hard threshold in units of the noise");
  v("kaiser_beta", o.kaiser_beta, Bounds{0, 10}, "shape of the aggregation window");
  v("wiener", o.wiener, Bounds{0, 1}, "run the second stage");
}

template <OptionsOf<BilateralOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("range_sigmas", o.range_sigmas, Bounds{0, 10},
    "bilateral filter behind the method: range, in units of the noise (0: off)");
  v("space_px", o.space_px, Bounds{1, 10}, "... and its reach, sigma, px");
}

template <OptionsOf<DenoiseOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("method", o.method, kDenoiseMethods, "none, gaussian, nlm or bm3d");
  v("sigma_counts", o.sigma_counts, Bounds{0, 65535}, "noise, counts (0: measured on each frame)");
  v("sigma_scale", o.sigma_scale, Bounds{0.1, 10}, "nlm and bm3d are told so many times the noise");
  v("detrend", o.detrend, Bounds{0, 1}, "take the smooth background off while denoising");
  v.group("gaussian", o.gaussian);
  v.group("nlm", o.nlm);
  v.group("bm3d", o.bm3d);
  v.group("bilateral", o.bilateral);
}

template <OptionsOf<CannyOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("high_threshold", o.high_threshold, Bounds{0, 1e6},
    "Sobel magnitude of a certain edge, grey levels (0: automatic)");
  v("non_edge_share", o.non_edge_share, Bounds{0, 1},
    "automatic: share of pixels below the high one");
  v("low_over_high", o.low_over_high, Bounds{0, 1}, "low threshold as a share of the high one");
}

template <OptionsOf<OrientedFilterOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("across_px", o.across_px, Bounds{0.5, 2}, "width of the kernels across the edge, sigma, px");
  v("clean_across_px", o.clean_across_px, Bounds{0.5, 2},
    "the same where there is next to no noise, px");
  v("clean_along_px", o.clean_along_px, Bounds{0.5, 4}, "and along it, px");
  v("along_px", o.along_px, Bounds{0.5, 4}, "their length along it, sigma, px");
  v("low", o.low, Bounds{1e-6, 1000}, "hysteresis, in units of the noise: edges go on above this");
  v("high", o.high, Bounds{1e-6, 1000}, "... and hold a pixel above this");
  v("noise_floor", o.noise_floor, Bounds{0, 0.1},
    "least noise assumed, as a share of the frame's range; half of it is a clean frame");
  v("fine_px", o.fine_px, Bounds{0, 2}, "width of the fine derivative, sigma, px (0: none)");
  v("fine_above", o.fine_above, Bounds{1e-6, 1000},
    "its response, in noise, from which it decides");
}

template <OptionsOf<ContourOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("min_component_px", o.min_component_px, Bounds{0, 1e9},
    "components with fewer pixels are removed (0: none)");
  v("gap_px", o.gap_px, Bounds{1, 8}, "reach of a walking step, px");
  v("min_length_px", o.min_length_px, Bounds{0, 1e9},
    "shortest curve, px (0: more than (width + height) / 25)");
  v("closed_gap_px", o.closed_gap_px, Bounds{0, 100}, "ends this near close a curve, px");
}

template <OptionsOf<GraphOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("min_length_px", o.min_length_px, Bounds{1, 1e9}, "shortest curve, points");
  v("max_turn_deg", o.max_turn_deg, Bounds{0, 180},
    "sharper turns at a junction are ends, degrees");
  v("closed_gap_px", o.closed_gap_px, Bounds{0, 100}, "ends nearer than this close a curve, px");
  v("closed_length_gaps", o.closed_length_gaps, Bounds{0, 1000}, "... that is so many gaps long");
}

template <OptionsOf<GapClosingOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gap_px", o.gap_px, Bounds{0, 32}, "curves are carried on over gaps up to this, px (0: none)");
  v("max_turn_deg", o.max_turn_deg, Bounds{0, 90}, "sharpest turn into a bridge, degrees");
  v("min_contrast_ratio", o.min_contrast_ratio, Bounds{0, 1},
    "contrast across a bridge, as a share of that across the end before it");
}

template <OptionsOf<PaperCornerOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("sigma_px", o.sigma_px, Bounds{0.5, 10}, "smoothing of the curve before curvature, px");
  v("curvature_ratio", o.curvature_ratio, Bounds{1, 100},
    "a corner is sharper than this many times the mean of its region");
  v("max_angle_deg", o.max_angle_deg, Bounds{90, 180}, "wider angles are no corners, degrees");
  v("end_points", o.end_points, Bounds{0, 1}, "ends of open curves are corners");
  v("end_distance_px", o.end_distance_px, Bounds{0, 1000},
    "... where farther than this from every other corner, px");
}

template <OptionsOf<CornerOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("sigma_px", o.sigma_px, Bounds{0.5, 10}, "smoothing of the contour before curvature, px");
  v("curvature_ratio", o.curvature_ratio, Bounds{1, 100},
    "a corner is sharper than this many times the mean of its arms");
  v("max_angle_deg", o.max_angle_deg, Bounds{90, 180}, "wider angles are no corners, degrees");
  v("end_distance_px", o.end_distance_px, Bounds{0, 1000},
    "no farther than this from an end of its contour, the end stands for a corner, px");
}

template <OptionsOf<LinkingOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gap_px", o.gap_px, Bounds{0, 32}, "ends nearer than this are linked, px (0: no linking)");
}

template <OptionsOf<ScoringOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("loop_line_ratio", o.loop_line_ratio, Bounds{1e-6, 1e6}, "Phi of a loop (a line has 1)");
}

template <OptionsOf<SelectionOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("keep_edges", o.keep_edges, Bounds{0, 1e9}, "ET: the best so many edges are kept (0: all)");
  v("max_edgels", o.max_edgels, Bounds{0, 1e9}, "most edgels in the kept edges (0: any number)");
  v("min_score", o.min_score, Bounds{-1e9, 1e9},
    "oriented: edges with a lower score are dropped as weak");
  v("max_false_alarms", o.max_false_alarms, Bounds{0, 1e9},
    "false edges expected in a frame of noise; edges above it are dropped (0: no test)");
}

template <OptionsOf<DetectorOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("preset", o.preset, kPresets, "where the other options start from");
  v("edges", o.edges, kEdgeMethods, "how edge pixels are found: canny or oriented");
  v("threads", o.threads, Bounds{0, 1024}, "threads (0: one per core)");
  v.group("nuc", o.nuc);
  v.group("scale", o.scale);
  v.group("denoise", o.denoise);
  v.group("canny", o.canny);
  v.group("oriented", o.oriented);
  v.group("contours", o.contours);
  v.group("graph", o.graph);
  v.group("gap_closing", o.gap_closing);
  v.group("paper_corners", o.paper_corners);
  v.group("corners", o.corners);
  v.group("linking", o.linking);
  v.group("scoring", o.scoring);
  v.group("selection", o.selection);
}

namespace detail {

[[nodiscard]] std::string out_of_range(const std::string& name, double value, Bounds bounds);

// Remembers the first option that is not finite or out of its range.
class RangeChecker {
 public:
  explicit RangeChecker(std::string prefix) : prefix_(std::move(prefix)) {}

  template <class T>
  void operator()(std::string_view name, const T& value, Bounds bounds, std::string_view) {
    const auto number = static_cast<double>(value);
    if (message_.empty() && !(number >= bounds.min && number <= bounds.max)) {
      message_ = out_of_range(prefix_ + std::string(name), number, bounds);
    }
  }
  template <class E, class Names>
  requires std::is_enum_v<E>
  void operator()(std::string_view, const E&, const Names&, std::string_view) {}

  template <class O>
  void group(std::string_view name, const O& options) {
    RangeChecker nested(prefix_ + std::string(name) + ".");
    visit_options(options, nested);
    if (message_.empty()) {
      message_ = nested.message_;
    }
  }
  [[nodiscard]] Status status() const {
    return message_.empty() ? Status{} : failure(ErrorCode::kInvalidArgument, message_);
  }

 private:
  std::string prefix_;
  std::string message_;
};

}  // namespace detail

// Fails on the first option out of range, naming it as `prefix` + name.
template <class O>
[[nodiscard]] Status check_ranges(const O& options, std::string_view prefix) {
  detail::RangeChecker checker{std::string(prefix)};
  visit_options(options, checker);
  return checker.status();
}

}  // namespace thermedge

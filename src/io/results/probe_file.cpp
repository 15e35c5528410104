#include "thermedge/io/probe_file.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/digits.hpp"
#include "thermedge/io/edges_file.hpp"
#include "thermedge/options.hpp"

namespace thermedge::io {
namespace {

using Json = nlohmann::ordered_json;

// Six digits say more than is known of any value here.
Json rounded(double value) { return to_significant(value, 6); }

Json rounded(const std::optional<double>& value) { return value ? rounded(*value) : Json(nullptr); }

Json rounded(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) {
    list.push_back(rounded(value));
  }
  return list;
}

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

// Nothing where the response that was given does not fit.
std::optional<double> in_degc(const RecordingReport& report, double counts) {
  return report.is_degc_implausible ? std::nullopt : std::optional(counts * report.degc_per_count);
}

Json implausible_json(const RecordingReport& report) {
  const auto [low, high] = report.implausible_degc;
  return Json::array({rounded(low), rounded(high)});
}

Json range_json(const RecordingReport& report) {
  const std::optional<double> mean = in_degc(report, report.range_counts);
  return {
      {"min_counts", report.min_counts},
      {"max_counts", report.max_counts},
      {"min_degc", rounded(report.min_degc)},
      {"max_degc", rounded(report.max_degc)},
      {"mean_counts", rounded(report.range_counts)},
      {"implausible_degc", report.is_degc_implausible ? implausible_json(report) : Json(nullptr)},
      {"mean_degc", rounded(mean)},
      {"p1_to_p99_counts", rounded(report.robust_range_counts)},
      {"p1_to_p99_degc", rounded(in_degc(report, report.robust_range_counts))},
      {"degc_per_level", mean ? rounded(degc_per_level(*mean)) : Json(nullptr)}};
}

std::string_view name_of(NoiseKind kind) {
  return std::find_if(kNoiseKinds.begin(), kNoiseKinds.end(),
                      [&](const auto& known) { return known.value == kind; })
      ->name;
}

// 8 rows of 8 variances.
Json spectrum_json(const NoiseSpectrum& spectrum) {
  Json rows = Json::array();
  for (std::size_t v = 0; v < kNoiseBlockPx; ++v) {
    Json row = Json::array();
    for (std::size_t u = 0; u < kNoiseBlockPx; ++u) {
      row.push_back(rounded(static_cast<double>(spectrum[v * kNoiseBlockPx + u])));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

Json noise_json(const RecordingReport& report) {
  return {{"sigma_counts", rounded(report.sigma_counts)},
          {"sigma_value", rounded(report.sigma_value)},
          {"sigma_degc", rounded(in_degc(report, report.sigma_counts))},
          {"kind", name_of(report.noise_kind)},
          {"spectrum", spectrum_json(report.spectrum)},
          {"pixel_sigma_counts", rounded(report.pixel_sigma_counts)},
          {"frame_sigma_counts", rounded(report.frame_sigma_counts)},
          {"temporal_sigma_counts", rounded(report.temporal_sigma_counts)},
          {"fixed_pattern_sigma_counts", rounded(report.fixed_pattern_sigma_counts)},
          {"fixed_pattern_share", rounded(report.fixed_pattern_share)},
          {"offset_map_gain_8_frames", rounded(report.offset_map_gain_8_frames)},
          {"offset_map_gain_limit", rounded(report.offset_map_gain_limit)},
          {"column_sigma_counts", rounded(report.column_sigma_counts)},
          {"row_sigma_counts", rounded(report.row_sigma_counts)},
          {"snr", rounded(report.snr)}};
}

Json sequence_json(const RecordingReport& report) {
  return {{"repeated_frames", report.repeated_frames},
          {"longest_freeze_frames", report.longest_freeze},
          {"offset_jumps", report.offset_jumps},
          {"largest_jump_counts", rounded(report.largest_jump_counts)},
          {"moved_frames", report.scene_moved},
          {"flicker_counts", rounded(report.flicker_counts)}};
}

Json clipping_json(const RecordingReport& report) {
  Json list = Json::array();
  for (const GainClipping& entry : report.clipping) {
    list.push_back({{"gain", entry.gain}, {"clipped_share", rounded(entry.share)}});
  }
  return list;
}

Json series_json(const RecordingReport& report) {
  Json frames = Json::array(), medians = Json::array(), sigmas = Json::array();
  for (const ProbeSample& sample : report.series) {
    frames.push_back(sample.frame);
    medians.push_back(sample.median_counts);
    sigmas.push_back(rounded(sample.sigma_counts));
  }
  return {{"frame", std::move(frames)},
          {"median_counts", std::move(medians)},
          {"sigma_counts", std::move(sigmas)}};
}

Json suggested_json(const RecordingReport& report) {
  Json list = Json::array();
  for (const SuggestedOption& option : report.suggested) {
    list.push_back({{"option", option.name}, {"value", option.value}, {"reason", option.reason}});
  }
  return list;
}

Json input_json(const RecordingReport& report) {
  Json list = Json::array();
  for (const InputFault& fault : report.input) {
    list.push_back({{"flag", fault.flag}, {"value", fault.value}, {"reason", fault.reason}});
  }
  return list;
}

// Options of the input go into the file; a flag that no option stands for, into a comment.
std::string input_toml(const RecordingReport& report) {
  std::string text;
  for (const InputFault& fault : report.input) {
    text += "# " + fault.reason + "\n";
    text += fault.option.empty() ? "# on the command line: " + fault.flag + " " + fault.value + "\n"
                                 : fault.option + " = \"" + fault.value + "\"\n";
  }
  return text;
}

}  // namespace

std::string probe_to_json(const RecordingReport& report, const std::vector<std::string>& inputs) {
  const Json document = {
      {"format_version", kFormatVersion},
      {"inputs", inputs},
      {"frames", report.frames},
      {"width", report.width},
      {"height", report.height},
      {"container_bits", report.container_bits},
      {"used_bits", report.used_bits},
      {"unused_low_bits", report.unused_low_bits},
      {"degc_per_count", report.is_degc_implausible ? Json(nullptr) : Json(report.degc_per_count)},
      {"degc_per_count_assumed", report.is_degc_assumed},
      {"input", input_json(report)},
      {"range", range_json(report)},
      {"noise", noise_json(report)},
      {"invalid_pixels_per_frame",
       {{"given", rounded(report.given_invalid_pixels)},
        {"found", rounded(report.found_invalid_pixels)},
        {"dead_rows", rounded(report.dead_rows)},
        {"dead_columns", rounded(report.dead_columns)}}},
      {"bad_pixels", or_null(report.bad_pixels)},
      {"passing_bad_pixels_per_frame", rounded(report.passing_bad_pixels)},
      {"clipping", clipping_json(report)},
      {"sequence", sequence_json(report)},
      {"suggested", suggested_json(report)},
      {"histogram",
       {{"edges_counts", report.histogram.edges_counts},
        {"pixels", report.histogram.pixels},
        {"below", report.histogram.below},
        {"above", report.histogram.above}}},
      {"noise_map",
       {{"columns", report.noise_map.columns},
        {"rows", report.noise_map.rows},
        {"sigma_counts", rounded(report.noise_map.sigma_counts)}}},
      {"column_profile_counts", rounded(report.column_profile_counts)},
      {"row_profile_counts", rounded(report.row_profile_counts)},
      {"series", series_json(report)}};
  // A name that is not UTF-8 is shown with replacement characters rather than refused.
  return document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string suggested_toml(const RecordingReport& report) {
  std::string text;
  if (report.preset != DetectorOptions{}.preset()) {
    text = "preset = \"" + std::string(preset_name(report.preset)) + "\"\n";
  }
  text += input_toml(report);
  if (report.suggested.empty()) {
    return text + "# The detector's defaults suit this recording.\n";
  }
  for (const SuggestedOption& option : report.suggested) {
    text += "# " + option.reason + "\n" + option.name + " = " + option.value + "\n";
  }
  return text;
}

}  // namespace thermedge::io

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "results/digits.hpp"
#include "results/edges_json.hpp"
#include "thermedge/io/edges_file.hpp"

namespace thermedge::io {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kMeasuredDigits = 4;  // of noise, thresholds and evidence
constexpr int kSpectrumDecimals = 3;
constexpr int kMsDecimals = 3;

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json decimals(double value, int digits) { return or_null(to_decimals(value, digits)); }

Json digits(double value, int count) { return or_null(to_significant(value, count)); }

// Of measured figures that are known to a few per cent.
Json measure(double value) { return digits(value, kMeasuredDigits); }

Json pairs(const std::vector<float>& x, const std::vector<float>& y, Range range, int digits) {
  Json list = Json::array();
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    list.push_back({decimals(x[i], digits), decimals(y[i], digits)});
  }
  return list;
}

Json numbers(const std::vector<float>& values, Range range, int count) {
  Json list = Json::array();
  for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
    list.push_back(digits(values[i], count));
  }
  return list;
}

// What was measured at the points; null where there was no frame to measure on.
void add_measures_of_points(const Edgels& edgels, const Edge& edge, const EdgesFileOptions& options,
                            Json& json) {
  const bool is_measured = std::isfinite(edge.contrast_counts);
  const auto add = [&](bool wanted, const char* key, auto&& make) {
    if (wanted) {
      json[key] = is_measured ? make() : Json(nullptr);
    }
  };
  add(options.normals, "normals",
      [&] { return pairs(edgels.nx, edgels.ny, edge.edgels, kNormalDecimals); });
  add(options.strengths, "strength_counts_per_px",
      [&] { return numbers(edgels.magnitude_counts, edge.edgels, kStrengthDigits); });
  add(options.position_sigmas, "position_sigma_px",
      [&] { return numbers(edgels.position_sigma_px, edge.edgels, kPositionSigmaDigits); });
}

Json to_json(const EdgeSet& set, const Edge& edge, const EdgesFileOptions& options) {
  constexpr int kLengthDigits = 5;
  Json json = {{"index", edge.index},
               {"rank", edge.rank},
               {"score", digits(edge.score, kScoreDigits)},
               {"es", digits(edge.es, kScoreDigits)},
               {"z", measure(edge.z)},
               {"log10_nfa", measure(edge.log10_nfa)},
               {"closed", edge.closed},
               {"begins_at_invalid", edge.begins_at_invalid},
               {"ends_at_invalid", edge.ends_at_invalid},
               {"length_px", digits(edge.length_px, kLengthDigits)},
               {"contrast_counts", digits(edge.contrast_counts, kContrastDigits)},
               {"contrast_sigmas", digits(edge.contrast_sigmas, kContrastDigits)},
               {"corners", set.corners_of(edge)},
               {"connected", set.connections_of(edge)},
               {"points", pairs(set.edgels.x, set.edgels.y, edge.edgels, kPositionDecimals)}};
  add_measures_of_points(set.edgels, edge, options, json);
  return json;
}

Json dropped_edges(const EdgeSet& set, const EdgesFileOptions& options) {
  Json list = Json::array();
  for (std::size_t i = set.kept; i < set.edges.size(); ++i) {
    Json json = to_json(set, set.edges[i], options);
    json["reason"] = status_name(set.edges[i].status);
    list.push_back(std::move(json));
  }
  return list;
}

Json to_json(const StageTimes& times) {
  Json json = Json::object();
  for (const StageTime& time : times) {
    json[std::string(time.stage)] = decimals(time.ms, kMsDecimals);
  }
  json["total"] = decimals(total_ms(times), kMsDecimals);
  return json;
}

// Of the nodes of the map: the least and the greatest; 1 and 1 where the noise is even.
Json range_of(const NoiseLevelMap& map) {
  const ImageView<const float> nodes = map.nodes();
  float least = 1;
  float greatest = 1;
  for (int y = 0; y < nodes.height(); ++y) {
    const auto [low, high] = std::minmax_element(nodes.row(y), nodes.row(y) + nodes.width());
    least = y == 0 ? *low : std::min(least, *low);
    greatest = y == 0 ? *high : std::max(greatest, *high);
  }
  return {measure(least), measure(greatest)};
}

Json to_json(const NoiseSpectrum& spectrum) {
  Json rows = Json::array();
  for (std::size_t v = 0; v < kNoiseBlockPx; ++v) {
    Json row = Json::array();
    for (std::size_t u = 0; u < kNoiseBlockPx; ++u) {
      row.push_back(decimals(spectrum[v * kNoiseBlockPx + u], kSpectrumDecimals));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

// Figures that were measured on the frame, and the choices that follow from them.
Json measured(const Detection& detection) {
  const NoiseEstimate& noise = detection.corrections.noise;
  Json json = {{"pixel_sigma_counts", measure(noise.sigma_counts)},
               {"column_sigma_counts", measure(noise.column_sigma_counts)},
               {"row_sigma_counts", measure(noise.row_sigma_counts)}};
  if (detection.unit_counts > 0) {
    const NoiseModel& model = detection.corrections.noise_model;
    json["level_counts"] = measure(model.level_counts);
    json["level_range"] = range_of(model.map);
    json["spectrum"] = to_json(model.spectrum);
    json["unit_counts"] = measure(detection.unit_counts);
    json["kernel_px"] = {measure(detection.kernel_px.across_px),
                         measure(detection.kernel_px.along_px)};
  }
  return json;
}

// How many edges were dropped for each reason.
Json dropped_counts(const EdgeSet& set) {
  Json counts = Json::object();
  for (const EdgeStatus status : {EdgeStatus::kWeak, EdgeStatus::kInsignificant,
                                  EdgeStatus::kLowContrast, EdgeStatus::kBeyondBudget}) {
    counts[std::string(status_name(status))] =
        std::count_if(set.edges.begin(), set.edges.end(),
                      [&](const Edge& edge) { return edge.status == status; });
  }
  return counts;
}

Json to_json(const InvalidPixels& invalid) {
  return {{"given", invalid.given},
          {"found", invalid.found},
          {"dead_rows", invalid.dead_rows},
          {"dead_columns", invalid.dead_columns}};
}

}  // namespace

nlohmann::ordered_json frame_json(const Detection& detection, const std::string& source,
                                  const EdgesFileOptions& options) {
  const EdgeSet& set = detection.edges;
  Json edges = Json::array();
  for (const Edge& edge : set.kept_edges()) {
    edges.push_back(to_json(set, edge, options));
  }
  Json junctions = Json::array();
  for (const Junction& junction : set.junctions) {
    junctions.push_back({junction.at.x, junction.at.y});
  }
  Json document = {{"format_version", kFormatVersion},
                   {"source", source},
                   {"frame", detection.index},
                   {"stamp_ns", detection.stamp_ns ? Json(*detection.stamp_ns) : Json(nullptr)},
                   {"width", detection.width},
                   {"height", detection.height},
                   {"preset", preset_name(detection.preset)},
                   {"sigma_counts", measure(detection.sigma_counts)},
                   {"edges", std::move(edges)},
                   {"junctions", std::move(junctions)},
                   {"stats",
                    {{"ms", to_json(detection.times)},
                     {"measured", measured(detection)},
                     {"edges_found", set.edges.size()},
                     {"edges_dropped", dropped_counts(set)},
                     {"invalid_pixels", to_json(detection.corrections.invalid)},
                     {"bad_pixels", detection.corrections.bad_pixels.size()},
                     {"threshold_low", measure(detection.threshold_low)},
                     {"threshold_high", measure(detection.threshold_high)}}}};
  if (detection.preset == Preset::kPaper) {
    document["stats"]["clipped_low_share"] = measure(detection.clipped.low);
    document["stats"]["clipped_high_share"] = measure(detection.clipped.high);
  }
  if (options.dropped_edges) {
    document["dropped_edges"] = dropped_edges(set, options);
  }
  return document;
}

// A name that is not UTF-8 is shown with replacement characters rather than refused.
std::string json_line(const nlohmann::ordered_json& document) {
  return document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string edges_to_json(const Detection& detection, const std::string& source,
                          const EdgesFileOptions& options) {
  return json_line(frame_json(detection, source, options));
}

}  // namespace thermedge::io

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "thermedge/io/edges_file.hpp"

namespace thermedge::io {
namespace {

using Json = nlohmann::ordered_json;

// Short decimals: 1/1000 is far below what any value here is known to.
Json rounded(double value) {
  return std::isfinite(value) ? Json(std::round(value * 1000) / 1000) : Json(nullptr);
}

// Scores span many decades, so digits after the point would not do.
Json exact(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json to_json(const EdgeSet& set, const Edge& edge) {
  Json points = Json::array();
  for (std::uint32_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
    points.push_back({rounded(set.edgels.x[i]), rounded(set.edgels.y[i])});
  }
  return {{"index", edge.index},
          {"rank", edge.rank},
          {"score", exact(edge.score)},
          {"es", exact(edge.es)},
          {"z", rounded(edge.z)},
          {"log10_nfa", rounded(edge.log10_nfa)},
          {"closed", edge.closed},
          {"begins_at_invalid", edge.begins_at_invalid},
          {"ends_at_invalid", edge.ends_at_invalid},
          {"length_px", rounded(edge.length_px)},
          {"contrast_counts", rounded(edge.contrast_counts)},
          {"contrast_sigmas", rounded(edge.contrast_sigmas)},
          {"corners", set.corners_of(edge)},
          {"connected", set.connections_of(edge)},
          {"points", std::move(points)}};
}

Json to_json(const StageTimes& times) {
  Json json = Json::object();
  for (const StageTime& time : times) {
    json[std::string(time.stage)] = rounded(time.ms);
  }
  json["total"] = rounded(total_ms(times));
  return json;
}

struct StatusCounts {
  std::size_t weak = 0, insignificant = 0, low_contrast = 0, beyond_budget = 0;
};

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
  return {rounded(least), rounded(greatest)};
}

Json to_json(const NoiseSpectrum& spectrum) {
  Json rows = Json::array();
  for (std::size_t v = 0; v < kNoiseBlockPx; ++v) {
    Json row = Json::array();
    for (std::size_t u = 0; u < kNoiseBlockPx; ++u) {
      row.push_back(rounded(spectrum[v * kNoiseBlockPx + u]));
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

// Figures that were measured on the frame, and the choices that follow from them.
Json measured(const Detection& detection) {
  const NoiseEstimate& noise = detection.corrections.noise;
  Json json = {{"pixel_sigma_counts", rounded(noise.sigma_counts)},
               {"column_sigma_counts", rounded(noise.column_sigma_counts)},
               {"row_sigma_counts", rounded(noise.row_sigma_counts)}};
  if (detection.unit_counts > 0) {
    const NoiseModel& model = detection.corrections.noise_model;
    json["level_counts"] = rounded(model.level_counts);
    json["level_range"] = range_of(model.map);
    json["spectrum"] = to_json(model.spectrum);
    json["unit_counts"] = rounded(detection.unit_counts);
    json["kernel_px"] = {rounded(detection.kernel_px.across_px),
                         rounded(detection.kernel_px.along_px)};
  }
  return json;
}

StatusCounts count_statuses(const EdgeSet& set) {
  StatusCounts counts;
  for (const Edge& edge : set.edges) {
    counts.weak += edge.status == EdgeStatus::kWeak ? 1 : 0;
    counts.insignificant += edge.status == EdgeStatus::kInsignificant ? 1 : 0;
    counts.low_contrast += edge.status == EdgeStatus::kLowContrast ? 1 : 0;
    counts.beyond_budget += edge.status == EdgeStatus::kBeyondBudget ? 1 : 0;
  }
  return counts;
}

Json to_json(const InvalidPixels& invalid) {
  return {{"given", invalid.given},
          {"found", invalid.found},
          {"dead_rows", invalid.dead_rows},
          {"dead_columns", invalid.dead_columns}};
}

Json to_json(const StatusCounts& counts) {
  return {{"weak", counts.weak},
          {"insignificant", counts.insignificant},
          {"low_contrast", counts.low_contrast},
          {"beyond_budget", counts.beyond_budget}};
}

}  // namespace

std::string edges_to_json(const Detection& detection, const std::string& source) {
  const EdgeSet& set = detection.edges;
  Json edges = Json::array();
  for (const Edge& edge : set.kept_edges()) {
    edges.push_back(to_json(set, edge));
  }
  Json junctions = Json::array();
  for (const Junction& junction : set.junctions) {
    junctions.push_back({junction.at.x, junction.at.y});
  }
  Json document = {{"source", source},
                   {"width", detection.width},
                   {"height", detection.height},
                   {"preset", preset_name(detection.preset)},
                   {"sigma_counts", rounded(detection.sigma_counts)},
                   {"edges", std::move(edges)},
                   {"junctions", std::move(junctions)},
                   {"stats",
                    {{"ms", to_json(detection.times)},
                     {"measured", measured(detection)},
                     {"edges_found", set.edges.size()},
                     {"edges_dropped", to_json(count_statuses(set))},
                     {"invalid_pixels", to_json(detection.corrections.invalid)},
                     {"bad_pixels", detection.corrections.bad_pixels.size()},
                     {"threshold_low", rounded(detection.threshold_low)},
                     {"threshold_high", rounded(detection.threshold_high)}}}};
  if (detection.preset == Preset::kPaper) {
    document["stats"]["clipped_low_share"] = rounded(detection.clipped.low);
    document["stats"]["clipped_high_share"] = rounded(detection.clipped.high);
  }
  // A name that is not UTF-8 is shown with replacement characters rather than refused.
  return document.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace thermedge::io

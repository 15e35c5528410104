#include "pipeline.hpp"

#include "paper_pipeline.hpp"
#include "robust_pipeline.hpp"

namespace thermedge::detail {

std::unique_ptr<Pipeline> make_pipeline(const DetectorOptions& options) {
  if (const PaperOptions* paper = options.paper()) {
    return std::make_unique<PaperPipeline>(options, *paper);
  }
  return std::make_unique<RobustPipeline>(options, *options.robust());
}

void round_to_levels(ImageView<const float> in, Image<std::uint8_t>& levels) {
  levels.resize(in.width(), in.height());
  for (int y = 0; y < in.height(); ++y) {
    std::transform(in.row(y), in.row(y) + in.width(), levels.row(y), [](float value) {
      return static_cast<std::uint8_t>(std::min(std::max(value, 0.0F), 255.0F) + 0.5F);
    });
  }
}

void binarize(ImageView<const std::uint8_t> map, Image<std::uint8_t>& binary) {
  binary.resize(map.width(), map.height());
  for (int y = 0; y < map.height(); ++y) {
    std::transform(map.row(y), map.row(y) + map.width(), binary.row(y),
                   [](std::uint8_t value) { return value != 0 ? std::uint8_t{255} : value; });
  }
}

ImageView<const std::uint8_t> mask_invalid(ImageView<const std::uint8_t> edges,
                                           ImageView<const std::uint8_t> valid,
                                           Image<std::uint8_t>& masked) {
  constexpr int kReachPx = 2;
  if (valid.empty()) {
    return edges;
  }
  copy_image(edges, masked);
  for (int y = 0; y < valid.height(); ++y) {
    for (int x = 0; x < valid.width(); ++x) {
      if (valid(x, y) != 0) {
        continue;
      }
      const int bottom = std::min(y + kReachPx, valid.height() - 1);
      const int left = std::max(x - kReachPx, 0);
      const int right = std::min(x + kReachPx, valid.width() - 1);
      for (int near_y = std::max(y - kReachPx, 0); near_y <= bottom; ++near_y) {
        std::fill(masked.row(near_y) + left, masked.row(near_y) + right + 1, std::uint8_t{0});
      }
    }
  }
  return masked;
}

void forget_contrast(EdgeSet& edges) {
  for (Edge& edge : edges.edges) {
    edge.contrast_counts = edge.z = edge.log10_nfa = std::numeric_limits<double>::quiet_NaN();
  }
}

void convert_to_frame_units(Detection& found) {
  const double unit = 1 / found.corrections.counts_per_unit;
  if (unit == 1) {
    return;
  }
  NoiseEstimate& noise = found.corrections.noise;
  for (double* value :
       {&noise.sigma_counts, &noise.column_sigma_counts, &noise.row_sigma_counts,
        &found.corrections.noise_model.level_counts, &found.sigma_counts, &found.unit_counts}) {
    *value *= unit;
  }
  for (std::vector<float>* offsets :
       {&found.corrections.stripes.columns, &found.corrections.stripes.rows,
        &found.edges.edgels.magnitude_counts}) {
    for (float& offset : *offsets) {
      offset = static_cast<float>(offset * unit);
    }
  }
  for (Edge& edge : found.edges.edges) {
    edge.contrast_counts *= unit;
  }
}

}  // namespace thermedge::detail

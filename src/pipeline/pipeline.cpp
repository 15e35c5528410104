#include "pipeline.hpp"

#include <cmath>

#include "fill_square.hpp"
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

// Only pixels beside a valid one clear more than themselves.
void keep_clear_of_invalid(ImageView<const std::uint8_t> valid, Image<std::uint8_t>& clear) {
  const int width = valid.width();
  const int height = valid.height();
  clear.resize(width, height);
  for (int y = 0; y < height; ++y) {
    std::transform(valid.row(y), valid.row(y) + width, clear.row(y),
                   [](std::uint8_t value) { return value != 0 ? std::uint8_t{1} : value; });
  }
  const auto is_inside = [&](int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u) {
        if (valid(u, v) != 0) {
          return false;
        }
      }
    }
    return true;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (valid(x, y) != 0 || is_inside(x, y)) {
        continue;
      }
      fill_square(clear.view(), x, y, kInvalidReachPx, std::uint8_t{0});
    }
  }
}

ImageView<const std::uint8_t> mask_invalid(ImageView<const std::uint8_t> edges,
                                           ImageView<const std::uint8_t> clear,
                                           Image<std::uint8_t>& masked) {
  if (clear.empty()) {
    return edges;
  }
  masked.resize(edges.width(), edges.height());
  for (int y = 0; y < edges.height(); ++y) {
    std::transform(edges.row(y), edges.row(y) + edges.width(), clear.row(y), masked.row(y),
                   [](std::uint8_t edge, std::uint8_t is_clear) {
                     return is_clear != 0 ? edge : std::uint8_t{0};
                   });
  }
  return masked;
}

void mark_cut_ends(ImageView<const std::uint8_t> valid, EdgeSet& edges) {
  constexpr int kReachPx = kInvalidReachPx + 2;
  if (valid.empty()) {
    return;
  }
  const auto is_cut = [&](std::uint32_t edgel) {
    const auto x = static_cast<int>(std::floor(edges.edgels.x[edgel] + 0.5F));
    const auto y = static_cast<int>(std::floor(edges.edgels.y[edgel] + 0.5F));
    for (int v = std::max(y - kReachPx, 0); v <= std::min(y + kReachPx, valid.height() - 1); ++v) {
      for (int u = std::max(x - kReachPx, 0); u <= std::min(x + kReachPx, valid.width() - 1); ++u) {
        if (valid(u, v) == 0) {
          return true;
        }
      }
    }
    return false;
  };
  for (Edge& edge : edges.edges) {
    if (!edge.closed && edge.edgels.count > 0) {
      edge.begins_at_invalid = is_cut(edge.edgels.first);
      edge.ends_at_invalid = is_cut(edge.edgels.first + edge.edgels.count - 1);
    }
  }
}

void forget_contrast(EdgeSet& edges) {
  for (Edge& edge : edges.edges) {
    edge.contrast_counts = edge.contrast_sigmas = edge.z = edge.log10_nfa =
        std::numeric_limits<double>::quiet_NaN();
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

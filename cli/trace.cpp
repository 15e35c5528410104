// `trace`: contours, corners, links and ranks of binary edge maps.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "edge_command.hpp"

namespace thermedge::cli {
namespace {

// The values of a map: none, one or two. NaN is none.
struct MapValues {
  std::optional<double> low, high;
  bool are_more = false;

  void add(double value) {
    if (std::isnan(value) || value == low || value == high) {
      return;
    }
    if (!low) {
      low = value;
    } else if (!high) {
      high = std::max(*low, value);
      low = std::min(*low, value);
    } else {
      are_more = true;
    }
  }
};

// From where on a pixel is an edge: of two values the higher one, of one value all that is not 0.
template <class T>
Result<double> threshold_of(ImageView<const T> pixels) {
  MapValues values;
  for (int y = 0; y < pixels.height() && !values.are_more; ++y) {
    std::for_each(pixels.row(y), pixels.row(y) + pixels.width(),
                  [&](T value) { values.add(static_cast<double>(value)); });
  }
  if (values.are_more) {
    return failure(ErrorCode::kBadData,
                   "has more than two values, where an edge map has two; --threshold VALUE says "
                   "from where on a pixel is an edge");
  }
  const double only = values.low.value_or(0);
  return values.high.value_or(only == 0 ? only + 1 : only);
}

// 1 where a pixel is an edge.
template <class T>
Status mark_edges(ImageView<const T> pixels, std::optional<double> threshold,
                  Image<std::uint8_t>& map) {
  const Result<double> least = threshold ? Result<double>(*threshold) : threshold_of(pixels);
  return least.map([&](double edge) {
    map.resize(pixels.width(), pixels.height());
    for (int y = 0; y < map.height(); ++y) {
      std::transform(pixels.row(y), pixels.row(y) + map.width(), map.row(y), [&](T value) {
        return static_cast<std::uint8_t>(static_cast<double>(value) >= edge);
      });
    }
  });
}

struct TraceCommand : EdgeCommand {
  std::optional<double> threshold;
};

}  // namespace

void add_trace(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "trace", "contours, corners, links and ranks of binary edge maps that another detector made");
  auto command = std::make_shared<TraceCommand>();
  command->add_to(app);
  app.add_option(
      "--threshold", command->threshold,
      "pixels of at least this value are edges; needed for maps of more than two values");
  app.callback([command, &exit_code] {
    exit_code = command->run_on_frames(
        [&threshold = command->threshold, map = std::make_shared<Image<std::uint8_t>>()](
            Detector& detector, const io::SourceFrame& frame, Detection& detection) {
          const Status marked =
              frame.is_float()
                  ? mark_edges(ImageView<const float>(frame.values), threshold, *map)
                  : mark_edges(ImageView<const std::uint16_t>(frame.counts), threshold, *map);
          return marked.and_then([&] { return detector.trace(map->view(), detection); });
        });
  });
}

}  // namespace thermedge::cli

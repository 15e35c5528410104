// `trace`: contours, corners, links and ranks of binary edge maps.
#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "edge_command.hpp"

namespace thermedge::cli {
namespace {

// 1 where a pixel is an edge. NaN is none.
template <class T>
void mark_edges(ImageView<const T> pixels, Image<std::uint8_t>& map) {
  map.resize(pixels.width(), pixels.height());
  for (int y = 0; y < map.height(); ++y) {
    std::transform(pixels.row(y), pixels.row(y) + map.width(), map.row(y),
                   [](T value) { return std::uint8_t{value > 0 || value < 0}; });
  }
}

}  // namespace

void add_trace(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "trace", "contours, corners, links and ranks of binary edge maps that another detector made");
  auto command = std::make_shared<EdgeCommand>();
  command->add_to(app);
  app.callback([command, &exit_code] {
    exit_code = command->run_on_frames(
        [map = std::make_shared<Image<std::uint8_t>>()](
            Detector& detector, const io::SourceFrame& frame, Detection& detection) {
          frame.is_float() ? mark_edges(ImageView<const float>(frame.values), *map)
                           : mark_edges(ImageView<const std::uint16_t>(frame.counts), *map);
          return detector.trace(map->view(), detection);
        });
  });
}

}  // namespace thermedge::cli

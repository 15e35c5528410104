// `trace`: contours, corners, links and ranks of binary edge maps.
#include <algorithm>
#include <memory>

#include "commands.hpp"
#include "edge_command.hpp"

namespace thermedge::cli {

void add_trace(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "trace", "contours, corners, links and ranks of binary edge maps that another detector made");
  auto command = std::make_shared<EdgeCommand>();
  command->add_to(app);
  app.callback([command, &exit_code] {
    exit_code = command->run_on_frames(
        [map = std::make_shared<Image<std::uint8_t>>()](
            Detector& detector, const io::SourceFrame& frame, Detection& detection) {
          map->resize(frame.counts.width(), frame.counts.height());
          for (int y = 0; y < map->height(); ++y) {
            std::transform(frame.counts.row(y), frame.counts.row(y) + map->width(), map->row(y),
                           [](std::uint16_t value) { return std::uint8_t{value != 0}; });
          }
          return detector.trace(map->view(), detection);
        });
  });
}

}  // namespace thermedge::cli

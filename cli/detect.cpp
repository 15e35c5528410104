// `detect`: frames to edges.
#include <memory>

#include "commands.hpp"
#include "edge_command.hpp"

namespace thermedge::cli {

void add_detect(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand("detect", "find edges in frames");
  auto command = std::make_shared<EdgeCommand>();
  command->add_to(app);
  command->add_denoising_to(app);
  command->common.add_validity_to(app);
  app.callback([command, &exit_code] {
    exit_code = command->run_on_frames(
        [](Detector& detector, const io::SourceFrame& frame, Detection& detection) {
          return detector.detect(frame.frame(), detection);
        });
  });
}

}  // namespace thermedge::cli

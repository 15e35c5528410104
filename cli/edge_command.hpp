// Shared by `detect` and `trace`.
#pragma once

#include <functional>
#include <string>

#include "detector_command.hpp"
#include "thermedge/detector.hpp"

namespace thermedge::cli {

struct EdgeCommand : DetectorCommand {
  std::string write;                  // kinds of results
  std::optional<std::string> points;  // what JSON has of each point
  bool all_edges = false;
  bool explain = false;

  void add_to(CLI::App& app);

  // Runs `step(detector, frame, detection)` on each frame and writes the result. Returns the exit
  // code.
  using Step = std::function<Status(Detector&, const io::SourceFrame&, Detection&)>;
  [[nodiscard]] int run_on_frames(const Step& step) const;

 private:
  [[nodiscard]] Status check_explain() const;
};

}  // namespace thermedge::cli

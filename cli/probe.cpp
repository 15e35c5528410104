// `probe`: what a recording is like.
#include "thermedge/probe.hpp"

#include <fmt/core.h>

#include <memory>

#include "commands.hpp"
#include "common.hpp"
#include "probe_page.hpp"
#include "thermedge/io/probe_file.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::cli {
namespace {

struct ProbeCommand {
  CommonOptions common;
  ProbeOptions probe;
  std::string toml;
  bool json = false;

  int run() const {
    Report report = common.report();
    const auto source = common.prepare();
    if (!source) {
      report.error(source.error().message);
      return kBadUsage;
    }
    RecordingProbe recording(probe);
    const int exit_code = for_each_frame(
        common, *source, report,
        [&](const io::Frame& frame) -> Status { return recording.add(frame.counts, frame.bits); });
    const RecordingReport result = recording.report();
    if (result.frames == 0) {
      if (exit_code == kGood) {
        report.error(name() + ": holds no frames");
      }
      return kBadInput;
    }
    if (!toml.empty()) {
      if (const Status status = io::write_file(toml, io::suggested_toml(result)); !status) {
        report.error(status.error().message);
        return kBadInput;
      }
    }
    fmt::print("{}", json ? io::probe_to_json(result, common.inputs) : probe_page(result, name()));
    return exit_code;
  }

  [[nodiscard]] std::string name() const {
    return common.inputs.size() == 1
               ? common.inputs.front()
               : fmt::format("{} and {} more", common.inputs.front(), common.inputs.size() - 1);
  }
};

}  // namespace

void add_probe(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "probe", "what a recording is like: range, noise, stripes, dead pixels, freezes, options");
  auto command = std::make_shared<ProbeCommand>();
  command->common.add_to(app);
  app.remove_option(app.get_option("-o"));
  app.add_option("--degc-per-count", command->probe.degc_per_count, "worth of a count, degC")
      ->check(CLI::Range(1e-9, 1000.0))
      ->capture_default_str();
  app.add_flag("--json", command->json, "everything as one JSON object");
  app.add_option("--toml", command->toml, "file for the suggested options, for detect --config");
  app.callback([command, &exit_code] { exit_code = command->run(); });
}

}  // namespace thermedge::cli

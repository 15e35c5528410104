// `evaluate`: how good are these edges?
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>

#include "commands.hpp"
#include "common.hpp"
#include "console.hpp"
#include "evaluate_tracks.hpp"
#include "evaluation_page.hpp"
#include "standard_output.hpp"
#include "thermedge/eval/evaluate.hpp"
#include "thermedge/io/files.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::cli {
namespace {

namespace fs = std::filesystem;

struct EvaluateCommand : RunOptions {
  std::string found;
  std::string truth;
  std::string output;
  eval::EvaluationOptions options;
  TracksCommand tracks;
  std::optional<double> least_contrast_counts;
  bool no_thin = false;
  bool empty = false;
  bool json = false;

  [[nodiscard]] int run();

 private:
  [[nodiscard]] Result<std::string> with_truth(const eval::PredictionSet& set,
                                               Console& report) const;
  [[nodiscard]] Status check_output() const;
  [[nodiscard]] Result<std::string> judge(Console& report) const;
  [[nodiscard]] Result<std::string> alone(const eval::PredictionSet& set, Console& report) const;
  [[nodiscard]] bool as_json() const { return json || io::ending_of(output) == ".json"; }
};

void report_all(const std::vector<Error>& errors, Console& report) {
  for (const Error& error : errors) {
    report.error(error.message + "; left out");
  }
}

Result<std::string> EvaluateCommand::with_truth(const eval::PredictionSet& set,
                                                Console& report) const {
  const auto truth_set = eval::GroundTruthSet::open(truth, {least_contrast_counts.value_or(0), {}});
  if (!truth_set) {
    return tl::unexpected(truth_set.error());
  }
  return eval::evaluate(set, *truth_set, options, *make_runner(threads.value_or(0)))
      .map([&](const eval::Evaluation& evaluation) {
        report_all(evaluation.errors, report);
        return as_json()
                   ? eval::evaluation_to_json(evaluation, found, truth)
                   : found + " against " + truth + ": " + evaluation_page(evaluation, options);
      });
}

Result<std::string> EvaluateCommand::alone(const eval::PredictionSet& set, Console& report) const {
  return eval::evaluate_without_truth(set, options, *make_runner(threads.value_or(0)))
      .map([&](const eval::TruthlessEvaluation& evaluation) {
        report_all(evaluation.errors, report);
        return as_json() ? eval::evaluation_to_json(evaluation, found)
                         : found + ": " + evaluation_page(evaluation, options, empty);
      });
}

// Files of results and truth, alone or in directories.
Status EvaluateCommand::check_output() const {
  constexpr std::array<std::string_view, 8> kRead = {".png", ".json", ".jsonl", ".npz",
                                                     ".mat", ".npy",  ".tif",   ".tiff"};
  if (output.empty()) {
    return {};
  }
  InputFiles inputs;
  for (const std::string& input : {found, truth}) {
    inputs.add(input);
    std::error_code error;
    for (fs::directory_iterator entry(input, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string path = entry->path().string();
      if (std::find(kRead.begin(), kRead.end(), io::ending_of(path)) != kRead.end()) {
        inputs.add(path);
      }
    }
  }
  return inputs.check_file("-o", output);
}

Result<std::string> EvaluateCommand::judge(Console& report) const {
  if (tracks.on) {
    return tracks.run(found, truth, least_contrast_counts.value_or(-1), options.sigma_counts,
                      threads.value_or(0), as_json(), report);
  }
  return eval::PredictionSet::open(found).and_then([&](const eval::PredictionSet& opened) {
    return truth.empty() ? alone(opened, report) : with_truth(opened, report);
  });
}

int EvaluateCommand::run() {
  Console report = this->report();
  if (empty && !truth.empty()) {
    return report.fail({ErrorCode::kInvalidArgument, "--empty: empty scenes have no GT"});
  }
  if (const Status status = check_output(); !status) {
    return report.fail(status.error());
  }
  options.count.thin = !no_thin;
  options.progress = [&report](std::size_t done, std::size_t all) { report.progress(done, all); };
  const Result<std::string> text = judge(report);
  if (!text) {
    return report.fail(text.error());
  }
  if (output.empty()) {
    print(*text);
  } else if (const Status status = io::write_file(output, *text); !status) {
    return report.fail(status.error());
  }
  return report.exit_code();
}

}  // namespace

void add_evaluate(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "evaluate", "compare edges with the true ones: precision, recall, F, structure, positions");
  auto command = std::make_shared<EvaluateCommand>();
  eval::EvaluationOptions& options = command->options;
  app.add_option("PRED", command->found,
                 "directory of edge maps (8-bit PNG, 255 strongest) or of results (JSON), one such "
                 "file, or JSON lines (.jsonl)")
      ->required();
  app.add_option(
      "GT", command->truth,
      "true edges: a directory in which each result's file name is looked for as .npz, .mat "
      "(BSDS), .png, _*.png or .json; one such file; or JSON lines (.jsonl). Without: "
      "structure and repeatability");
  app.add_option("--at", options.at, "only at this threshold")->check(CLI::Range(1, 255));
  app.add_option("--thresholds", options.thresholds, "number of thresholds for strength maps")
      ->check(CLI::Range(1, 254))
      ->capture_default_str();
  app.add_flag("--no-thin", command->no_thin,
               "thin strength maps once instead of at every threshold, which is many times faster");
  app.add_option("--max-dist", options.count.max_distance,
                 "largest distance of two matched pixels, as a share of the diagonal")
      ->check(CLI::Range(0.0, 0.1))
      ->capture_default_str();
  app.add_option("--least-contrast", command->least_contrast_counts,
                 "true curves of less contrast, in counts, may be found or missed (default 0; with "
                 "--tracks 40, or 2 sigma where that is more)")
      ->check(CLI::Range(0.0, 65535.0));
  app.add_option("--sigma", options.sigma_counts,
                 "noise in counts, for recall by contrast (0: taken from the results)")
      ->check(CLI::Range(0.0, 65535.0))
      ->capture_default_str();
  app.add_option("--shift", options.most_shift_px,
                 "without GT: largest motion between two frames, px")
      ->check(CLI::Range(0, 64))
      ->capture_default_str();
  app.add_flag("--empty", command->empty, "the scenes hold no edges: count false alarms");
  app.add_option("-o,--output", command->output,
                 "file for the result: a page of text, or JSON (.json)");
  app.add_flag("--json", command->json, "one JSON object instead of the page");
  command->tracks.add_to(app);
  command->add_to(app);
  app.callback([command, &exit_code] { exit_code = command->run(); });
}

}  // namespace thermedge::cli

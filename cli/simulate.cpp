#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "commands.hpp"
#include "common.hpp"
#include "line_file.hpp"
#include "signal_guard.hpp"
#include "thermedge/io/write.hpp"
#include "thermedge/sim/scene.hpp"
#include "thermedge/sim/truth_file.hpp"

namespace thermedge::cli {
namespace {

constexpr std::array<std::string_view, 4> kKinds = {"counts", "clean", "truth", "depth"};

// What SCENE, --set and the flags change.
constexpr const char* kDefaultKeys = "camera=pi450&path=hand&frames=100";

constexpr const char* kTruthFile = "truth.jsonl";
constexpr const char* kTrajectoryFile = "trajectory.txt";

struct SimulateCommand : RunOptions {
  std::string scene;
  std::string output;
  std::optional<std::string> camera;
  std::optional<std::string> path;
  std::string write = "counts,clean,truth,depth";
  std::string format = "png";
  std::optional<std::string> frames;
  std::optional<std::string> seed;
  std::optional<std::string> netd_mk;
  std::vector<std::string> settings;

  [[nodiscard]] bool writes(std::string_view kind) const {
    const auto kinds = split_list(write);
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> given_keys() const;
  [[nodiscard]] Result<sim::SceneOptions> options() const;
  [[nodiscard]] Status check_output() const;
  [[nodiscard]] int run() const;
  [[nodiscard]] Status write_frame(const sim::TrueFrame& frame, OutputDirectory& directory) const;
  [[nodiscard]] Status write_all(sim::Renderer& renderer, Console& report) const;
};

using Keys = std::vector<std::pair<std::string, std::string>>;

// --set, then the flags, which win.
Keys SimulateCommand::given_keys() const {
  Keys keys;
  for (const std::string& setting : settings) {
    const auto equals = std::min(setting.find('='), setting.size());
    keys.emplace_back(setting.substr(0, equals),
                      setting.substr(std::min(equals + 1, setting.size())));
  }
  const auto add = [&](const char* key, const std::optional<std::string>& value) {
    if (value) {
      keys.emplace_back(key, *value);
    }
  };
  add("camera", camera);
  add("path", path);
  add("frames", frames);
  add("seed", seed);
  add("netd_mk", netd_mk);
  return keys;
}

// All keys go into one text, as the camera comes first there, wherever it stands: the others change
// it.
Result<sim::SceneOptions> SimulateCommand::options() const {
  sim::SceneOptions scratch;
  const auto typed = sim::parse_scene(scene);
  if (!typed) {  // an input like a file, whatever is wrong with it
    return failure(ErrorCode::kBadData, typed.error().message);
  }
  const std::size_t mark = std::min(scene.find('?'), scene.size());
  std::string keys = kDefaultKeys;
  keys += mark < scene.size() ? "&" + scene.substr(mark + 1) : "";
  for (const auto& [key, value] : given_keys()) {
    if (Status status = sim::set_scene_key(key, value, scratch); !status) {
      return tl::unexpected(status.error());
    }
    keys.append("&").append(key).append("=").append(value);
  }
  return sim::parse_scene(scene.substr(0, mark) + "?" + keys).map([&](sim::SceneOptions options) {
    options.depth = writes("depth");
    return options;
  });
}

// As the camera would give it without noise: in whole counts.
Image<std::uint16_t> rounded(ImageView<const float> clean) {
  Image<std::uint16_t> counts(clean.width(), clean.height());
  for (int y = 0; y < clean.height(); ++y) {
    std::transform(clean.row(y), clean.row(y) + clean.width(), counts.row(y), [](float value) {
      return static_cast<std::uint16_t>(std::clamp(value, 0.0F, 65535.0F) + 0.5F);
    });
  }
  return counts;
}

Status SimulateCommand::write_frame(const sim::TrueFrame& frame, OutputDirectory& directory) const {
  directory.begin_frame(fmt::format("frame_{:06}", frame.index));
  const auto picture = [&](const std::string& kind, const std::string& ending, auto view) {
    return directory.path(kind, ending).and_then([&](const std::string& file) {
      return io::write_picture(file, view);
    });
  };
  using Counts = ImageView<const std::uint16_t>;
  Status status;
  if (writes("counts")) {
    status = picture("counts", "." + format, Counts(frame.counts.view()));
  }
  if (status && writes("clean")) {
    const Image<std::uint16_t> clean = rounded(frame.clean);
    status = picture("clean", "." + format, Counts(clean.view()));
  }
  if (status && writes("depth")) {
    status = picture("depth", ".png", Counts(frame.depth_mm.view()));
  }
  return status;
}

Status SimulateCommand::write_all(sim::Renderer& renderer, Console& report) const {
  const auto runner = make_runner(threads.value_or(0));
  OutputDirectory directory(output);
  const std::filesystem::path folder(output);
  LineFile truth((folder / kTruthFile).string());
  LineFile trajectory((folder / kTrajectoryFile).string());
  const auto count = static_cast<std::size_t>(renderer.options().frames);
  report.set_results(output);
  SignalGuard signals;
  signals.set_last_words(report.interruption_line(0, 0));
  for (std::size_t done = 0; done < count;) {
    signals.begin_frame();
    Status status =
        renderer.render(static_cast<int>(done), *runner).and_then([&](const sim::TrueFrame& frame) {
          return write_frame(frame, directory).and_then([&]() -> Status {
            if (!writes("truth")) {
              return {};
            }
            return truth.write(sim::truth_line(frame)).and_then([&] {
              return trajectory.write(sim::trajectory_line(frame));
            });
          });
        });
    if (!status) {
      return status;
    }
    report.progress(++done, count);
    signals.set_last_words(report.interruption_line(done, 0));
    signals.end_frame();
  }
  report.summarize(count, 0);
  return {};
}

// The scene may be a file. It may lie in the directory, whose folders have the pictures, but must
// not be one of the files there.
Status SimulateCommand::check_output() const {
  InputFiles inputs;
  inputs.add(scene);
  const auto in_output = [&](const char* name) {
    return inputs.check_file("-o", (std::filesystem::path(output) / name).string());
  };
  return parse_output(output, {})
      .and_then([&](const OutputTarget&) { return in_output(kTruthFile); })
      .and_then([&] { return in_output(kTrajectoryFile); });
}

int SimulateCommand::run() const {
  Console report = this->report();
  for (const std::string& kind : split_list(write)) {
    if (std::find(kKinds.begin(), kKinds.end(), kind) == kKinds.end()) {
      report.error("--write " + kind + ": should be some of counts, clean, truth, depth");
      return kBadUsage;
    }
  }
  if (const Status status = check_output(); !status) {
    return report.fail(status.error());
  }
  auto renderer = options().and_then(sim::Renderer::create);
  if (!renderer) {
    return report.fail(renderer.error());
  }
  const Status status = write_all(*renderer, report);
  return status ? report.exit_code() : report.fail(status.error());
}

}  // namespace

void add_simulate(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "simulate", "a thermal scene as a camera sees it: frames with their true edges");
  auto command = std::make_shared<SimulateCommand>();
  app.add_option("SCENE", command->scene,
                 "desk, corridor, office, road, empty, or a scene file (.toml, docs/scenes.md)")
      ->required()
      ->type_name(fmt::format("FILE:{{{}}}", fmt::join(sim::scene_names(), ",")));
  app.add_option("-o,--output", command->output, "directory")->required();
  app.add_option("--camera", command->camera, "the camera's optics and noise (default pi450)")
      ->check(CLI::IsMember(sim::camera_names()));
  app.add_option("--path", command->path, "how the camera moves (default hand)")
      ->check(CLI::IsMember({"hand", "drive", "pan", "shake", "still"}));
  app.add_option("--frames", command->frames, "number of frames (default 100)")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--seed", command->seed, "noise, path, variations of the scene");
  app.add_option("--netd-mk", command->netd_mk, "temporal noise, mK (default: the camera's)");
  app.add_option("--write", command->write, "some of counts,clean,truth,depth")
      ->capture_default_str();
  app.add_option("--format", command->format, "of the pictures")
      ->check(CLI::IsMember({"png", "tif", "npy"}))
      ->capture_default_str();
  app.add_option("--set", command->settings,
                 "another key of sim:NAME?key=value, e.g. shutter_every=200; may be repeated")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_to(app);
  app.callback([command, &exit_code] { exit_code = command->run(); });
}

}  // namespace thermedge::cli

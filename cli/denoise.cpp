// `denoise`: frames with less noise.
#include <algorithm>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "common.hpp"
#include "picture_output.hpp"
#include "standard_output.hpp"
#include "thermedge/frame_denoiser.hpp"
#include "thermedge/io/config.hpp"
#include "thermedge/io/source_options.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::cli {
namespace {

// With the bits that the frame came with.
Status write_counts(const std::string& path, ImageView<const std::uint16_t> counts, int bits) {
  if (bits == 16) {
    return io::write_picture(path, counts);
  }
  Image<std::uint8_t> levels(counts.width(), counts.height());
  for (int y = 0; y < counts.height(); ++y) {
    std::transform(counts.row(y), counts.row(y) + counts.width(), levels.row(y),
                   [](std::uint16_t count) {
                     return static_cast<std::uint8_t>(std::min<std::uint16_t>(count, 255));
                   });
  }
  return io::write_picture(path, ImageView<const std::uint8_t>(levels.view()));
}

// In the unit of a float frame.
Status write_values(const std::string& path, const FrameDenoiser& denoiser,
                    const io::SourceFrame& frame) {
  Image<float> values(frame.width(), frame.height());
  denoiser.copy_values(values);
  return io::write_picture(path, ImageView<const float>(values.view()));
}

struct DenoiseCommand {
  CommonOptions common;
  ConfigOptions config;
  std::optional<std::string> method;
  std::optional<std::string> sigma;

  [[nodiscard]] Status apply_to(FrameDenoiserOptions& options, io::SourceOptions& source) const;
  [[nodiscard]] int run() const;
};

Status DenoiseCommand::apply_to(FrameDenoiserOptions& options, io::SourceOptions& source) const {
  Status status = config.apply(options, source);
  if (method) {
    status =
        status.and_then([&] { return io::apply_setting("denoise.method=" + *method, options); });
  }
  if (sigma) {
    status = status.and_then([&] { return parse_sigma(*sigma); }).map([&](double counts) {
      options.denoise.sigma_counts = counts;
    });
  }
  return status.and_then([&] { return options.check(); });
}

int DenoiseCommand::run() const {
  Console console = common.report();
  FrameDenoiserOptions options;
  io::SourceOptions configured;
  if (const Status status = apply_to(options, configured); !status) {
    return console.fail(status.error());
  }
  const auto source = common.source_options(configured);
  if (!source) {
    return console.fail(source.error());
  }
  if (config.dump) {
    print(io::dump_config(options) + io::dump_source_options(*source));
    return kGood;
  }
  if (const Status status = common.check(); !status) {
    return console.fail(status.error());
  }
  auto output = PictureOutput::create(common.output, common.input_files(*source, {config.file}));
  if (!output) {
    return console.fail(output.error());
  }
  console.set_results(common.output);
  const auto runner = make_runner(common.threads.value_or(0));
  FrameDenoiser denoiser(options);
  return for_each_frame(
      common, *source, console, output->room(), [&](const io::SourceFrame& frame) -> Status {
        return denoiser.run(frame.frame(), *runner)
            .and_then([&](ImageView<const std::uint16_t> counts) {
              return output->path(frame.stem, frame.is_float() ? ".tif" : ".png")
                  .and_then([&](const std::string& path) {
                    return frame.is_float() ? write_values(path, denoiser, frame)
                                            : write_counts(path, counts, frame.bits);
                  });
            });
      });
}

}  // namespace

void add_denoise(CLI::App& program, int& exit_code) {
  CLI::App& app = *program.add_subcommand(
      "denoise",
      "remove noise from frames, in counts; slower than in detect, for a better picture");
  auto command = std::make_shared<DenoiseCommand>();
  command->common.add_to(app);
  command->common.add_validity_to(app);
  command->config.add_to(app);
  app.get_option("INPUT")->required(false);  // --dump-config needs none
  app.add_option("--method", command->method, "denoiser (default bm3d)")
      ->check(CLI::IsMember(names_of(kDenoiseMethods)));
  app.add_option("--sigma", command->sigma, "noise: auto (the default) or counts");
  app.callback([command, &exit_code] { exit_code = command->run(); });
}

}  // namespace thermedge::cli

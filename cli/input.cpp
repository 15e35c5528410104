#include "input.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "thermedge/sim/scene.hpp"

namespace thermedge::cli {
namespace {

constexpr std::string_view kSimPrefix = "sim:";

class SimSource final : public io::FrameSource {
 public:
  SimSource(std::string spec, sim::Renderer renderer)
      : spec_(std::move(spec)),
        stem_(std::filesystem::path(renderer.options().name).stem().string()),
        frames_(renderer.options().frames),
        renderer_(std::move(renderer)),
        runner_(make_runner(0)) {}

  Result<bool> next(io::SourceFrame& frame) override {
    if (index_ >= frames_) {
      return false;
    }
    auto rendered = renderer_.render(index_, *runner_);
    if (!rendered) {
      index_ = frames_;
      return tl::unexpected(rendered.error());
    }
    frame.counts = std::move(rendered->counts);
    frame.values.resize(0, 0);
    frame.valid.resize(0, 0);
    frame.counts_model.reset();
    frame.stamp_ns = rendered->stamp_ns;
    frame.bits = 16;
    frame.source = spec_;
    frame.stem = stem_;
    if (frames_ > 1) {
      frame.source += fmt::format("[{}]", index_);
      frame.stem += fmt::format("_{:04}", index_);
    }
    frame.index = index_++;
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override { return static_cast<std::size_t>(frames_); }

 private:
  std::string spec_;
  std::string stem_;
  int frames_;
  sim::Renderer renderer_;
  std::unique_ptr<ParallelRunner> runner_;
  int index_ = 0;
};

Result<std::unique_ptr<io::FrameSource>> open_one(const std::string& input,
                                                  const io::SourceOptions& options) {
  if (!input.starts_with(kSimPrefix)) {
    return io::open_files({input}, options);
  }
  return sim::parse_scene(input).and_then(sim::Renderer::create).map([&](sim::Renderer renderer) {
    return std::unique_ptr<io::FrameSource>(
        std::make_unique<SimSource>(input, std::move(renderer)));
  });
}

// One input after the other.
class InputChain final : public io::FrameSource {
 public:
  InputChain(const std::vector<std::string>& inputs, const io::SourceOptions& options) {
    for (const std::string& input : inputs) {
      inputs_.push_back(open_one(input, options));
    }
  }

  Result<bool> next(io::SourceFrame& frame) override {
    while (current_ < inputs_.size()) {
      auto& input = inputs_[current_];
      if (!input) {
        ++current_;
        return tl::unexpected(input.error());
      }
      auto more = (*input)->next(frame);
      if (!more || *more) {
        return more;
      }
      ++current_;
    }
    return false;
  }

  [[nodiscard]] std::size_t size_hint() const override {
    std::size_t total = 0;
    for (const auto& input : inputs_) {
      const std::size_t size = input ? (*input)->size_hint() : 1;
      if (size == 0) {
        return 0;
      }
      total += size;
    }
    return total;
  }

 private:
  std::vector<Result<std::unique_ptr<io::FrameSource>>> inputs_;
  std::size_t current_ = 0;
};

// Frames with the pixels that are no measurement noted.
class MaskedSource final : public io::FrameSource {
 public:
  MaskedSource(std::unique_ptr<io::FrameSource> frames, const ValidityInput& validity,
               const io::Crop& crop, Image<std::uint16_t> mask)
      : frames_(std::move(frames)), validity_(validity), crop_(crop), mask_(std::move(mask)) {}

  Result<bool> next(io::SourceFrame& frame) override {
    if (ended_) {
      return false;
    }
    auto more = frames_->next(frame);
    if (!more || !*more) {
      return more;
    }
    const auto mask = mask_of(frame);
    if (!mask) {
      ended_ = true;
      return tl::unexpected(mask.error());
    }
    mark_invalid(*mask, frame);
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override { return frames_->size_hint(); }

 private:
  // The mask is that of the frames as they are used, or of the frames before they were cropped.
  [[nodiscard]] Result<ImageView<const std::uint16_t>> mask_of(const io::SourceFrame& frame) const {
    const ImageView<const std::uint16_t> mask = mask_;
    const bool fits = mask.width() == frame.width() && mask.height() == frame.height();
    if (mask.empty() || fits) {
      return mask;
    }
    const auto part = crop_.within(mask.width(), mask.height());
    if (part && part->width == frame.width() && part->height == frame.height()) {
      return mask.crop(part->x, part->y, part->width, part->height);
    }
    return failure(
        ErrorCode::kInvalidArgument,
        fmt::format("--mask {}: {}x{} pixels; should be {}x{} as {}", validity_.mask, mask.width(),
                    mask.height(), frame.width(), frame.height(), frame.source));
  }

  // Besides the pixels that the file itself has no number for.
  void mark_invalid(ImageView<const std::uint16_t> mask, io::SourceFrame& frame) const {
    if (frame.valid.empty()) {
      frame.valid.resize(frame.width(), frame.height());
      fill_pixels(frame.valid.view(), std::uint8_t{1});
    }
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const double value = frame.is_float() ? static_cast<double>(frame.values(x, y))
                                              : static_cast<double>(frame.counts(x, y));
        const bool is_masked = !mask.empty() && mask(x, y) == 0;
        const bool is_invalid = std::find(validity_.counts.begin(), validity_.counts.end(),
                                          value) != validity_.counts.end();
        frame.valid(x, y) = is_masked || is_invalid ? std::uint8_t{0} : frame.valid(x, y);
      }
    }
  }

  std::unique_ptr<io::FrameSource> frames_;
  ValidityInput validity_;
  io::Crop crop_;
  Image<std::uint16_t> mask_;
  bool ended_ = false;
};

Result<Image<std::uint16_t>> read_mask(const std::string& path) {
  auto picture = io::read_picture(path);
  if (!picture) {
    return failure(picture.error().code, "--mask " + picture.error().message);
  }
  if (picture->bits != 8) {
    return failure(ErrorCode::kUnsupported,
                   fmt::format("--mask {}: a picture of 16 bits; should be one of 8", path));
  }
  return std::move(picture->counts);
}

}  // namespace

Result<std::unique_ptr<io::FrameSource>> open_inputs(const CommonOptions& common,
                                                     const io::SourceOptions& options,
                                                     Console& report) {
  const ValidityInput& validity = common.validity;
  io::SourceOptions of_chain = options;
  of_chain.crop = {};
  of_chain.note = [&report](const std::string& note) { report.note(note); };
  std::unique_ptr<io::FrameSource> frames =
      io::crop_frames(std::make_unique<InputChain>(common.inputs, of_chain), options.crop);
  if (validity.empty()) {
    return frames;
  }
  Image<std::uint16_t> mask;
  if (!validity.mask.empty()) {
    auto read = read_mask(validity.mask);
    if (!read) {
      return tl::unexpected(read.error());
    }
    mask = std::move(*read);
  }
  return std::unique_ptr<io::FrameSource>(
      std::make_unique<MaskedSource>(std::move(frames), validity, options.crop, std::move(mask)));
}

}  // namespace thermedge::cli

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
               Image<std::uint16_t> mask)
      : frames_(std::move(frames)), validity_(validity), mask_(std::move(mask)) {}

  Result<bool> next(io::SourceFrame& frame) override {
    if (ended_) {
      return false;
    }
    auto more = frames_->next(frame);
    if (!more || !*more) {
      return more;
    }
    const int width = frame.counts.width();
    const int height = frame.counts.height();
    if (!mask_.empty() && (mask_.width() != width || mask_.height() != height)) {
      ended_ = true;
      return failure(ErrorCode::kInvalidArgument,
                     fmt::format("--mask {}: {}x{} pixels; should be {}x{} as {}", validity_.mask,
                                 mask_.width(), mask_.height(), width, height, frame.source));
    }
    frame.valid.resize(width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const bool is_masked = !mask_.empty() && mask_(x, y) == 0;
        const bool is_invalid = std::find(validity_.counts.begin(), validity_.counts.end(),
                                          frame.counts(x, y)) != validity_.counts.end();
        frame.valid(x, y) = is_masked || is_invalid ? 0 : 1;
      }
    }
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override { return frames_->size_hint(); }

 private:
  std::unique_ptr<io::FrameSource> frames_;
  ValidityInput validity_;
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

Result<std::unique_ptr<io::FrameSource>> open_inputs(const std::vector<std::string>& inputs,
                                                     const io::SourceOptions& options,
                                                     const ValidityInput& validity) {
  std::unique_ptr<io::FrameSource> frames = std::make_unique<InputChain>(inputs, options);
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
      std::make_unique<MaskedSource>(std::move(frames), validity, std::move(mask)));
}

}  // namespace thermedge::cli

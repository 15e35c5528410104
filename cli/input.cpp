#include "input.hpp"

#include <fmt/core.h>

#include <utility>

#include "thermedge/sim/scene.hpp"

namespace thermedge::cli {
namespace {

constexpr std::string_view kSimPrefix = "sim:";

class SimSource final : public io::FrameSource {
 public:
  SimSource(std::string spec, sim::SceneOptions options)
      : spec_(std::move(spec)), options_(std::move(options)) {}

  Result<bool> next(io::Frame& frame) override {
    if (index_ >= options_.frames) {
      return false;
    }
    auto rendered = sim::render(options_, index_);
    if (!rendered) {
      index_ = options_.frames;
      return tl::unexpected(rendered.error());
    }
    frame.counts = std::move(rendered->counts);
    frame.bits = 16;
    frame.source = spec_;
    frame.stem = options_.name;
    if (options_.frames > 1) {
      frame.source += fmt::format("[{}]", index_);
      frame.stem += fmt::format("_{:04}", index_);
    }
    frame.index = index_++;
    return true;
  }

  [[nodiscard]] std::size_t size_hint() const override {
    return static_cast<std::size_t>(options_.frames);
  }

 private:
  std::string spec_;
  sim::SceneOptions options_;
  int index_ = 0;
};

Result<std::unique_ptr<io::FrameSource>> open_one(const std::string& input,
                                                  const io::SourceOptions& options) {
  if (!input.starts_with(kSimPrefix)) {
    return io::open_files({input}, options);
  }
  return sim::parse_scene(input).map([&](sim::SceneOptions scene) {
    return std::unique_ptr<io::FrameSource>(std::make_unique<SimSource>(input, std::move(scene)));
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

  Result<bool> next(io::Frame& frame) override {
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

}  // namespace

std::unique_ptr<io::FrameSource> open_inputs(const std::vector<std::string>& inputs,
                                             const io::SourceOptions& options) {
  return std::make_unique<InputChain>(inputs, options);
}

}  // namespace thermedge::cli

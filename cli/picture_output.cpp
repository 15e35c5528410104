#include "picture_output.hpp"

#include <filesystem>
#include <utility>

namespace thermedge::cli {
namespace {

constexpr std::array<std::string_view, 6> kEndings = {".png", ".tif", ".tiff",
                                                      ".pgm", ".npy", ".raw"};

}  // namespace

PictureOutput::PictureOutput(const std::string& output, bool one_file, const InputFiles& inputs)
    : output_(output), inputs_(inputs), directory_(output, inputs), one_file_(one_file) {}

Result<PictureOutput> PictureOutput::create(const std::string& output, const InputFiles& inputs) {
  if (output.empty() || output == "-") {
    return failure(ErrorCode::kInvalidArgument,
                   "-o is required: a file for one frame, a directory for many");
  }
  return parse_output(output, kEndings).and_then([&](const OutputTarget& target) {
    const bool one_file = target.kind == OutputKind::kFile;
    return (one_file ? inputs.check_file("-o", output) : inputs.check_directory("-o", output))
        .map([&] { return PictureOutput(output, one_file, inputs); });
  });
}

Result<std::string> PictureOutput::path(const std::string& stem, const std::string& ending) {
  if (one_file_) {
    return output_;
  }
  directory_.begin_frame(stem);
  return directory_.path("", ending);
}

Result<std::string> PictureOutput::beside(const std::string& name) const {
  const std::filesystem::path output(output_);
  std::string path = one_file_
                         ? (output.parent_path() / (output.stem().string() + "_" + name)).string()
                         : (output / name).string();
  return inputs_.check_file("-o", path).map([&] { return std::move(path); });
}

}  // namespace thermedge::cli

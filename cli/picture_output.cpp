#include "picture_output.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace thermedge::cli {
namespace {

constexpr std::string_view kPictureEndings[] = {".png", ".tif", ".tiff", ".pgm", ".npy", ".raw"};

}  // namespace

PictureOutput::PictureOutput(const std::string& output)
    : output_(output),
      directory_(output),
      one_file_(std::find(std::begin(kPictureEndings), std::end(kPictureEndings),
                          std::filesystem::path(output).extension().string()) !=
                std::end(kPictureEndings)) {}

Result<std::string> PictureOutput::path(const std::string& stem) {
  if (!one_file_) {
    directory_.begin_frame(stem);
    return directory_.path("", ".png");
  }
  if (++written_ > 1) {
    return only_one_frame(output_);
  }
  return output_;
}

std::string PictureOutput::beside(const std::string& name) const {
  const std::filesystem::path output(output_);
  return one_file_ ? (output.parent_path() / (output.stem().string() + "_" + name)).string()
                   : (output / name).string();
}

}  // namespace thermedge::cli

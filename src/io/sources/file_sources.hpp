// The frames of one file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "thermedge/io/source.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// Names the frame: by its file, and by its place there where the file holds several.
void label_frame(SourceFrame& frame, const std::string& path, std::string stem, std::int64_t index,
                 bool is_one_of_several);

// A picture file, page by page; it is read into memory at the first one.
[[nodiscard]] std::unique_ptr<FrameSource> make_picture_source(const std::string& path,
                                                               const SourceOptions& options);

// Frames of one size without a header, from a file or standard input ("-"), one at a time.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> open_raw_source(const std::string& path,
                                                                   const SourceOptions& options);

}  // namespace thermedge::io

// Files and names of files.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "thermedge/limits.hpp"
#include "thermedge/result.hpp"

namespace thermedge::io {

// The system's words for a value of `errno`.
[[nodiscard]] std::string reason_of(int error_number);

// The whole file. Errors: it is missing, no regular file, unreadable, or larger than max_bytes.
[[nodiscard]] Result<std::vector<std::byte>> read_file(const std::string& path,
                                                       const Limits& limits);

// File name without directories and ending.
[[nodiscard]] std::string stem_of(const std::string& path);

// Ending of the file name with its dot, in small letters.
[[nodiscard]] std::string ending_of(const std::string& path);

// Whether the name ends like that of a picture (.png .tif .tiff .pgm .npy .raw, any case).
[[nodiscard]] bool has_picture_ending(const std::string& path);
[[nodiscard]] bool has_raw_ending(const std::string& path);

// Natural order: digits compare as numbers, so frame2 comes before frame10.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

// The files that an input stands for: itself; the pictures in a directory; the matches of a glob,
// directories among them again for their pictures. Directories and globs come in natural order.
// `with_raw`: files in directories that end like frames without a header (.bin, .dat ...) are
// pictures, too. Errors: nothing there.
[[nodiscard]] Result<std::vector<std::string>> expand_input(const std::string& input,
                                                            bool with_raw = false);

}  // namespace thermedge::io

// The INPUT arguments of the command line as one sequence of frames.
#pragma once

#include <cstddef>
#include <memory>

#include "common.hpp"
#include "thermedge/io/source.hpp"

namespace thermedge::cli {

// Opens files, directories, globs, "-" and "sim:NAME?...", one after the other, in the order given.
// An input that cannot be opened is one error of next(); the following inputs still run. What is
// passed over in a file is noted to `report`, which must outlive the frames. SourceFrame::valid is
// set by the command's --mask and --invalid. Errors: the mask cannot be read, or has not 8 bits.
// A frame of another size than the mask is one error of next(), after which there are no more
// frames.
[[nodiscard]] Result<std::unique_ptr<io::FrameSource>> open_inputs(const CommonOptions& common,
                                                                   const io::SourceOptions& options,
                                                                   Console& report);

}  // namespace thermedge::cli

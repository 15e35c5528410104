// Standard output, where results go: each leaves the program when it is done, and none gets lost
// without a word.
#pragma once

#include <string_view>

#include "thermedge/result.hpp"

namespace thermedge::cli {

// Writes `text` at once. A failure is kept, what follows it is not written, and `main` reports it
// once, whoever printed.
void print(std::string_view text);

[[nodiscard]] bool standard_output_failed();

// Writes what was printed by other means, too. Errors: something printed in this run got lost.
[[nodiscard]] Status finish_standard_output();

}  // namespace thermedge::cli

// Which known names an unknown word may stand for: "did you mean".
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace thermedge {

// The names that `word` may be a misspelling or the beginning of, nearest first, at most 3; those
// with the same distance in the order of `names`. A misspelling has at most one wrong, missing,
// additional or exchanged letter in every three of the word; upper case counts as lower case, and
// "-" as "_". Thread-safe.
[[nodiscard]] std::vector<std::string> similar_names(std::string_view word,
                                                     std::span<const std::string> names);

// "; did you mean a or b?"; empty where no name is similar.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> names);

}  // namespace thermedge

// Named sets of options. Their values stand in one table, src/pipeline/presets.cpp.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "thermedge/option_list.hpp"

namespace thermedge {

enum class Preset {
  kRobust,  // the default: the best edges
  kFast,    // robust's stages after a Gaussian and a bilateral filter instead of BM3D
  kPaper,   // as the text of the paper says
};

inline constexpr std::array kPresets = {EnumName{Preset::kRobust, "robust"},
                                        EnumName{Preset::kFast, "fast"},
                                        EnumName{Preset::kPaper, "paper"}};

[[nodiscard]] std::string_view preset_name(Preset preset);
[[nodiscard]] std::optional<Preset> preset_named(std::string_view name);

// What it is for, in at most 75 characters.
[[nodiscard]] std::string_view preset_meaning(Preset preset);

}  // namespace thermedge

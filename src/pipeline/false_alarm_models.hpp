// Which false-alarm model was measured for which denoiser and filter.
#pragma once

#include <optional>
#include <string_view>

#include "thermedge/stages/denoiser.hpp"
#include "thermedge/stages/oriented_filter.hpp"
#include "thermedge/stages/significance.hpp"

namespace thermedge::detail {

struct FalseAlarmLookup {
  std::optional<FalseAlarmModel> model;
  std::string_view why_none;  // empty where there is a model
};

// A model holds for the options it was measured with, but for the noise that the denoiser is told.
[[nodiscard]] FalseAlarmLookup look_up_false_alarms(const DenoiseOptions& denoise,
                                                    const OrientedFilterOptions& filter);

}  // namespace thermedge::detail

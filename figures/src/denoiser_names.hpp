// How denoisers are called on sheets.
#pragma once

#include <string_view>

#include "thermedge/stages/denoiser.hpp"

namespace thermedge::figures {

[[nodiscard]] constexpr std::string_view display_name(DenoiseMethod method) {
  switch (method) {
    case DenoiseMethod::kNone:
      return "not denoised";
    case DenoiseMethod::kGaussian:
      return "Gaussian";
    case DenoiseMethod::kNlm:
      return "NL-means";
    case DenoiseMethod::kBm3d:
      return "BM3D";
  }
  return "";
}

}  // namespace thermedge::figures

#include "thermedge/io/edges_file.hpp"

namespace thermedge::io {

std::string_view status_name(EdgeStatus status) {
  switch (status) {
    case EdgeStatus::kKept:
      return "kept";
    case EdgeStatus::kBeyondBudget:
      return "beyond_budget";
    case EdgeStatus::kWeak:
      return "weak";
    case EdgeStatus::kInsignificant:
      return "insignificant";
    case EdgeStatus::kLowContrast:
      return "low_contrast";
  }
  return "";
}

}  // namespace thermedge::io

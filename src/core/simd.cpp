#include "thermedge/simd.hpp"

#include "simd_config.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace thermedge {
namespace {

std::string upper(std::string_view name) {
  std::string result(name);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

// In Highway's order: a lower bit is a better target. Read once, before any choice is made,
// because a choice hides the other targets from Highway's own query.
const std::vector<std::int64_t>& available_targets() {
  static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return targets;
}

std::int64_t& selected_target() {
  static std::int64_t target = available_targets().front();
  return target;
}

void select(std::int64_t target) {
  selected_target() = target;
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().Update(target);
}

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : available_targets()) {
    names.emplace_back(hwy::TargetName(target));
  }
  return names;
}

std::string simd_target() { return hwy::TargetName(selected_target()); }

Status set_simd_target(std::string_view name) {
  const std::string wanted = upper(name);
  std::string known = "auto";
  for (const std::int64_t target : available_targets()) {
    const std::string candidate = hwy::TargetName(target);
    if (wanted == "AUTO" || wanted == upper(candidate)) {
      select(target);
      return {};
    }
    known += ", " + candidate;
  }
  return failure(ErrorCode::kInvalidArgument,
                 "SIMD target '" + std::string(name) + "': this machine has " + known);
}

}  // namespace thermedge

#include "thermedge/simd.hpp"

#include "simd_config.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cctype>
#include <cstdint>

#include "simd_dispatch.hpp"

namespace thermedge {
namespace {

std::string upper(std::string_view name) {
  std::string result(name);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

struct Target {
  std::int64_t bit;         // Highway's
  std::size_t table_index;  // in its dispatch tables
};

// In Highway's order: a lower bit is a better target.
const std::vector<Target>& targets() {
  static const std::vector<Target> known = [] {
    std::vector<Target> found;
    for (const std::int64_t bit : hwy::SupportedAndGeneratedTargets()) {
      hwy::ChosenTarget chosen;
      chosen.Update(bit);
      found.push_back({bit, chosen.GetIndex()});
    }
    return found;
  }();
  return known;
}

// Place in targets() of the choice of each thread.
thread_local std::size_t current_place = 0;

}  // namespace

std::size_t detail::simd_table_index() { return targets()[current_place].table_index; }

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (const Target& target : targets()) {
    names.emplace_back(hwy::TargetName(target.bit));
  }
  return names;
}

SimdTarget::SimdTarget() : place_(0) {}

Result<SimdTarget> SimdTarget::named(std::string_view name) {
  const std::string wanted = upper(name);
  if (wanted == "AUTO") {
    return SimdTarget();
  }
  std::string known = "auto";
  for (std::size_t i = 0; i < targets().size(); ++i) {
    const std::string candidate = hwy::TargetName(targets()[i].bit);
    if (wanted == upper(candidate)) {
      return SimdTarget(i);
    }
    known += ", " + candidate;
  }
  return failure(ErrorCode::kInvalidArgument,
                 "SIMD target '" + std::string(name) + "': this machine has " + known);
}

std::string SimdTarget::name() const { return hwy::TargetName(targets()[place_].bit); }

SimdScope::SimdScope(SimdTarget target) : before_(current()) { current_place = target.place_; }
SimdScope::~SimdScope() { current_place = before_.place_; }
SimdTarget SimdScope::current() { return SimdTarget(current_place); }

}  // namespace thermedge

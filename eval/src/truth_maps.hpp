// Shared by the readers of truth.
#pragma once

#include <string>
#include <utility>

#include "size_text.hpp"
#include "thermedge/eval/counts.hpp"
#include "thermedge/result.hpp"

namespace thermedge::eval {

// 1 where a value is above `level`, 0 elsewhere.
template <class T>
[[nodiscard]] Image<std::uint8_t> map_above(ImageView<T> values, int level) {
  Image<std::uint8_t> map(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      map(x, y) = values(x, y) > level ? 1 : 0;
    }
  }
  return map;
}

// An error where there is no annotator's map, `wanted` being what should be there, or where sizes
// differ.
[[nodiscard]] inline Result<TruthMaps> checked_maps(TruthMaps maps, const std::string& name,
                                                    const std::string& wanted) {
  if (maps.annotators.empty()) {
    return failure(ErrorCode::kBadData, name + ": should hold " + wanted);
  }
  const auto first = maps.annotators.front().view();
  for (const auto* list : {&maps.annotators, &maps.accepted}) {
    for (const auto& map : *list) {
      if (!same_size(map.view(), first)) {
        return failure(ErrorCode::kBadData, name + ": maps of different sizes, " +
                                                size_text(first) + " and " + size_text(map.view()));
      }
    }
  }
  return maps;
}

}  // namespace thermedge::eval

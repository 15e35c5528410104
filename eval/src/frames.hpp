// Shared by evaluation with and without truth.
#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/eval/evaluate.hpp"

namespace thermedge::eval {

// Names the first option that is out of range.
[[nodiscard]] Status check(const EvaluationOptions& options);

struct Thresholds {
  bool binary = false;
  std::vector<int> values;
};

// The one asked for; the upper value of binary maps; or a sweep.
[[nodiscard]] Thresholds choose_thresholds(const PredictionSet& found,
                                           const EvaluationOptions& options);

// Runs `work(i)`, which gives a Result, for each frame. A frame that fails leaves its error in
// place of its result.
template <class T, class F>
std::vector<Result<T>> for_each_frame(const PredictionSet& found, ParallelRunner& runner,
                                      const Progress& progress, std::size_t count, F&& work) {
  std::vector<Result<T>> results(count);
  std::mutex mutex;
  std::size_t done = 0;
  runner.run(static_cast<int>(count), [&](int task) {
    const auto i = static_cast<std::size_t>(task);
    results[i] = io::catch_bad_alloc(found.names()[i], [&] { return work(i); });
    if (progress) {
      const std::lock_guard lock(mutex);
      progress(++done, count);
    }
  });
  return results;
}

template <class T>
std::vector<T> take_good(std::vector<Result<T>> results, std::vector<Error>& errors) {
  std::vector<T> good;
  for (Result<T>& result : results) {
    if (result) {
      good.push_back(std::move(*result));
    } else {
      errors.push_back(std::move(result.error()));
    }
  }
  return good;
}

}  // namespace thermedge::eval

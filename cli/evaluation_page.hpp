// The page that `evaluate` prints.
#pragma once

#include <string>

#include "thermedge/eval/evaluate.hpp"

namespace thermedge::cli {

// At most 100 characters a line.
[[nodiscard]] std::string evaluation_page(const eval::Evaluation& evaluation,
                                          const eval::EvaluationOptions& options);
// `empty`: the scenes hold nothing, so what was found is a false alarm.
[[nodiscard]] std::string evaluation_page(const eval::TruthlessEvaluation& evaluation,
                                          const eval::EvaluationOptions& options, bool empty);

}  // namespace thermedge::cli

// The runner on several threads; it is left out where the library is built without oneTBB.
#pragma once

#include <memory>

#include "thermedge/parallel_runner.hpp"

namespace thermedge {

// How many threads oneTBB uses when it is not told.
[[nodiscard]] int core_count();

// `threads` is at least 2.
[[nodiscard]] std::unique_ptr<ParallelRunner> make_tbb_runner(int threads);

}  // namespace thermedge

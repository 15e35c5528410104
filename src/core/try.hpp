// Hands an error on to the caller.
#pragma once

#include <tl/expected.hpp>
#include <utility>

// Returns the error of a Status or Result from the function that this stands in.
#define THERMEDGE_TRY(expression)                                \
  do {                                                           \
    if (auto thermedge_tried = (expression); !thermedge_tried) { \
      return tl::unexpected(std::move(thermedge_tried).error()); \
    }                                                            \
  } while (false)

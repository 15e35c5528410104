// Joins broken curves (paper Algorithm 5).
#pragma once

#include <cstdint>
#include <vector>

#include "thermedge/contours.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct LinkingOptions {
  double gap_px = 3;  // GAP_LINK: ends nearer than this are linked, 0..32 px; 0 turns linking off
};

enum class LinkType {
  kEndToEnd = 1,     // two curves became one
  kEndToMiddle = 2,  // T-junction: recorded as a connection
  kLoop = 3,         // the two ends of one curve: it became closed
};

struct Link {
  LinkType type = LinkType::kEndToEnd;
  std::uint32_t a = 0;  // contour in the linked set whose end was linked
  std::uint32_t b = 0;  // the other contour in the linked set; a itself for kLoop, kEndToEnd
  Pixel from;           // the end
  Pixel to;             // the pixel it was linked to
};

struct LinkedContours {
  ContourSet contours;      // bridge pixels are inserted where curves were joined
  std::vector<Link> links;  // in the order in which they were made: types 1 and 3, then 2
  void clear();
};

// Types 1 and 3: all pairs of ends of open curves nearer than gap_px, by distance (ties: by index of
// the first end, then of the second), greedily, each end once. Type 2: ends that are still free,
// to the nearest pixel of another curve under gap_px.
// One object per thread; allocates on the first frame of a size only.
class Linker {
 public:
  explicit Linker(const LinkingOptions& options) : options_(options) {}

  // `width`, `height`: of the frame. `linked` is cleared first. Errors: an option out of range.
  [[nodiscard]] Status run(const ContourSet& contours, int width, int height,
                           LinkedContours& linked);

 private:
  struct EndPair {
    std::int64_t squared_distance;
    std::uint32_t a, b;  // end 2 i + k is end k of contour i
  };
  LinkingOptions options_;
  Image<std::int32_t> owner_;
  std::vector<EndPair> pairs_;
  std::vector<std::int32_t> partner_;
  std::vector<std::uint32_t> cells_;
};

}  // namespace thermedge

// Joins broken curves (paper Algorithm 5).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"
#include "thermedge/stages/contour_chains.hpp"
#include "thermedge/stages/contours.hpp"

namespace thermedge {

struct LinkingOptions {
  double gap_px = 3;  // GAP_LINK: ends nearer than this are linked, 0..32 px; 0 turns linking off

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<LinkingOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("gap_px", o.gap_px, Bounds{0, 32}, "ends nearer than this are linked, px (0: no linking)");
}

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

// Types 1 and 3: all pairs of ends of open curves nearer than gap_px, by distance (ties: by index
// of the first end, then of the second), greedily, each end once. Type 2: ends that are still free,
// to the nearest pixel of another curve under gap_px (ties: smaller column, then smaller row).
//
// A joined curve takes the place and the direction of the earliest of its parts. A bridge is a
// digital line between the two ends; it may cross pixels of other curves. That of a loop comes
// last. Junctions: the ends linked by type 2. gap_px = 0: contours and junctions pass through
// unchanged. Paper: Algorithm 5. One object per thread; allocates on the first frame of a size
// only.
class Linker {
 public:
  explicit Linker(const LinkingOptions& options) : options_(options) {}

  // `width`, `height`: of the frame, in which all contours lie. `linked` is cleared first.
  // Errors: an option out of range.
  [[nodiscard]] Status run(const ContourSet& contours, int width, int height,
                           LinkedContours& linked);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(offsets_, chains_, next_at_pixel_, end_at_, owner_);
  }

 private:
  void prepare(const ContourSet& contours, int width, int height, LinkedContours& linked);
  void place_ends(const ContourSet& contours);
  void join_ends(const ContourSet& contours, LinkedContours& linked);
  [[nodiscard]] std::int32_t find_free_end(Pixel around, std::span<const Pixel> offsets,
                                           std::int32_t other_than) const;
  void join(const ContourSet& contours, std::int32_t a, std::int32_t b, LinkedContours& linked);
  void assemble(const ContourSet& contours, LinkedContours& linked);
  void paint_owners(const ContourSet& contours, const LinkedContours& linked);
  void connect_free_ends(const ContourSet& contours, LinkedContours& linked) const;

  LinkingOptions options_;
  std::vector<Pixel> offsets_;  // under gap_px, nearest first
  detail::CurveChains chains_;
  std::vector<std::int32_t> next_at_pixel_;  // of each end: the next end at the same pixel
  Image<std::int32_t> end_at_;               // first of the ends at each pixel, -1: none
  Image<std::int32_t> owner_;                // linked contour of each pixel, -1: none
};

}  // namespace thermedge

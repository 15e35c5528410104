// Curves joined end to end, and what comes of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "thermedge/memory.hpp"
#include "thermedge/stages/contours.hpp"

namespace thermedge::detail {

// Ends of the curves of a set are numbered: 2 i is the first point of contour i, 2 i + 1 the last.
constexpr std::size_t contour_of(std::int32_t end) { return static_cast<std::size_t>(end) / 2; }
constexpr std::int32_t other_end(std::int32_t end) { return end ^ 1; }
[[nodiscard]] Pixel pixel_of(const ContourSet& contours, std::int32_t end);

// Appends the pixels of the digital line strictly between `from` and `to`.
void append_line(Pixel from, Pixel to, std::vector<Pixel>& points);

// Which ends are joined with which. A join is a digital line; it may go by way of a corner.
// Allocates in reserve() only.
class CurveChains {
 public:
  void reserve(std::size_t most_contours);
  // All ends of open curves are free.
  void reset(const ContourSet& contours);

  [[nodiscard]] std::int32_t ends() const { return static_cast<std::int32_t>(ends_.size()); }
  [[nodiscard]] bool is_free(std::int32_t end) const;
  // Joins two free ends. True: they were those of one chain, which is a loop now.
  bool join(std::int32_t a, std::int32_t b, std::optional<Pixel> corner = std::nullopt);
  // Carries a free end on to a pixel, which becomes the last one.
  void extend(std::int32_t end, Pixel to);

  // Appends the chains to `chained`. A chain takes the place and the direction of the earliest of
  // its curves. The line that closes a loop comes last.
  void assemble(const ContourSet& contours, ContourSet& chained);
  // In what assemble() appended to a cleared set: the chain that a contour became part of.
  [[nodiscard]] std::int32_t chain_of(std::size_t contour) const { return chain_of_[contour]; }

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const { return memory_of(ends_, chain_of_); }

 private:
  struct End {
    std::int32_t partner;  // the end that it was joined to, or one of the states below
    std::int32_t far;      // where a chain of curves ends here: the chain's other end
    std::optional<Pixel>
        corner;  // of the line to the partner; or where the curve was carried on to
  };
  static constexpr std::int32_t kFree = -1;
  static constexpr std::int32_t kSeam = -2;    // joined to the other end of its own chain: a loop
  static constexpr std::int32_t kClosed = -3;  // of a curve that came closed: no end at all
  static constexpr std::int32_t kExtended = -4;

  [[nodiscard]] End& at(std::int32_t end) { return ends_[static_cast<std::size_t>(end)]; }
  [[nodiscard]] const End& at(std::int32_t end) const {
    return ends_[static_cast<std::size_t>(end)];
  }
  [[nodiscard]] std::int32_t chain_start(std::int32_t end) const;
  void append_chain(const ContourSet& contours, std::int32_t start, ContourSet& chained);

  std::vector<End> ends_;
  std::vector<std::int32_t> chain_of_;
};

}  // namespace thermedge::detail

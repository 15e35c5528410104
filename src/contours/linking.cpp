#include "thermedge/stages/linking.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pixel_window.hpp"
#include "thermedge/stages/contour_chains.hpp"

namespace thermedge {
namespace {

using detail::contour_of;
using detail::pixel_of;

constexpr std::int32_t kNone = -1;

int reach_of(double gap_px) { return static_cast<int>(std::ceil(gap_px)); }

}  // namespace

Status LinkingOptions::check() const { return check_ranges(*this, "linking."); }

void LinkedContours::clear() {
  contours.clear();
  links.clear();
}

// Algorithm 5.
Status Linker::run(const ContourSet& contours, int width, int height, LinkedContours& linked) {
  linked.clear();
  if (Status status = options_.check(); !status) {
    return status;
  }
  prepare(contours, width, height, linked);
  place_ends(contours);
  join_ends(contours, linked);
  assemble(contours, linked);
  if (offsets_.empty()) {
    linked.contours.junctions.assign(contours.junctions.begin(), contours.junctions.end());
    return {};
  }
  paint_owners(contours, linked);
  connect_free_ends(contours, linked);
  return {};
}

// Every join uses up two ends and inserts less than gap_px pixels.
void Linker::prepare(const ContourSet& contours, int width, int height, LinkedContours& linked) {
  const double gap_px = options_.gap_px;
  const int reach = reach_of(gap_px);
  const std::size_t most_contours = contours.items.capacity();
  detail::list_offsets(
      reach,
      [=](Pixel offset) {
        return static_cast<double>(squared_distance(offset, {})) < gap_px * gap_px;
      },
      offsets_);
  chains_.reserve(most_contours);
  next_at_pixel_.reserve(2 * most_contours);
  linked.links.reserve(2 * most_contours);
  linked.contours.items.reserve(most_contours);
  linked.contours.junctions.reserve(std::max(2 * most_contours, contours.junctions.capacity()));
  linked.contours.points.reserve(contours.points.capacity() +
                                 most_contours * static_cast<std::size_t>(reach));
  end_at_.resize(width, height);
  owner_.resize(width, height);
}

void Linker::place_ends(const ContourSet& contours) {
  fill_pixels(end_at_.view(), kNone);
  chains_.reset(contours);
  next_at_pixel_.resize(static_cast<std::size_t>(chains_.ends()));
  for (std::int32_t end = 0; end < chains_.ends(); ++end) {
    const Pixel at = pixel_of(contours, end);
    assert(end_at_.view().contains(at.x, at.y));
    next_at_pixel_[static_cast<std::size_t>(end)] = end_at_(at.x, at.y);
    end_at_(at.x, at.y) = end;
  }
}

// Distance by distance, each free end in turn takes the first free end at that distance: the order
// of all pairs sorted by distance, first and second end, without a list of them.
void Linker::join_ends(const ContourSet& contours, LinkedContours& linked) {
  const auto differs = [](Pixel a, Pixel b) {
    return squared_distance(a, {}) != squared_distance(b, {});
  };
  for (auto first = offsets_.begin(); first != offsets_.end();) {
    const auto adjacent = std::adjacent_find(first, offsets_.end(), differs);
    const auto last = adjacent == offsets_.end() ? adjacent : adjacent + 1;
    for (std::int32_t end = 0; end < chains_.ends(); ++end) {
      if (!chains_.is_free(end)) {
        continue;
      }
      const std::int32_t partner =
          find_free_end(pixel_of(contours, end), std::span(first, last), end);
      if (partner != kNone) {
        join(contours, end, partner, linked);
      }
    }
    first = last;
  }
}

std::int32_t Linker::find_free_end(Pixel around, std::span<const Pixel> offsets,
                                   std::int32_t other_than) const {
  std::int32_t found = kNone;
  for (const Pixel offset : offsets) {
    const Pixel at{around.x + offset.x, around.y + offset.y};
    if (!end_at_.view().contains(at.x, at.y)) {
      continue;
    }
    for (std::int32_t end = end_at_(at.x, at.y); end != kNone;
         end = next_at_pixel_[static_cast<std::size_t>(end)]) {
      if (end != other_than && chains_.is_free(end) && (found == kNone || end < found)) {
        found = end;
      }
    }
  }
  return found;
}

// Until assemble(), the link names the contours as they came.
void Linker::join(const ContourSet& contours, std::int32_t a, std::int32_t b,
                  LinkedContours& linked) {
  const bool loop = chains_.join(a, b);
  const auto contour = static_cast<std::uint32_t>(contour_of(a));
  linked.links.push_back({loop ? LinkType::kLoop : LinkType::kEndToEnd, contour, contour,
                          pixel_of(contours, a), pixel_of(contours, b)});
}

void Linker::assemble(const ContourSet& contours, LinkedContours& linked) {
  chains_.assemble(contours, linked.contours);
  for (Link& link : linked.links) {
    link.a = link.b = static_cast<std::uint32_t>(chains_.chain_of(link.a));
  }
}

// A pixel under a bridge stays with the curve that had it first.
void Linker::paint_owners(const ContourSet& contours, const LinkedContours& linked) {
  fill_pixels(owner_.view(), kNone);
  for (std::size_t i = 0; i < linked.contours.items.size(); ++i) {
    for (const Pixel pixel : linked.contours.pixels(linked.contours.items[i])) {
      owner_(pixel.x, pixel.y) = static_cast<std::int32_t>(i);
    }
  }
  for (std::size_t i = 0; i < contours.items.size(); ++i) {
    for (const Pixel pixel : contours.pixels(contours.items[i])) {
      owner_(pixel.x, pixel.y) = chains_.chain_of(i);
    }
  }
}

void Linker::connect_free_ends(const ContourSet& contours, LinkedContours& linked) const {
  for (std::int32_t end = 0; end < chains_.ends(); ++end) {
    if (!chains_.is_free(end)) {
      continue;
    }
    const Pixel from = pixel_of(contours, end);
    const std::int32_t self = chains_.chain_of(contour_of(end));
    const auto target = [=](Pixel offset) { return Pixel{from.x + offset.x, from.y + offset.y}; };
    const auto owner = [&](Pixel at) {
      return owner_.view().contains(at.x, at.y) ? owner_(at.x, at.y) : kNone;
    };
    const auto nearest = std::find_if(offsets_.begin(), offsets_.end(), [&](Pixel offset) {
      const std::int32_t other = owner(target(offset));
      return other != kNone && other != self;
    });
    if (nearest != offsets_.end()) {
      const Pixel to = target(*nearest);
      linked.links.push_back({LinkType::kEndToMiddle, static_cast<std::uint32_t>(self),
                              static_cast<std::uint32_t>(owner(to)), from, to});
      linked.contours.junctions.push_back({from});
    }
  }
}

}  // namespace thermedge

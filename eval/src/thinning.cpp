#include "thermedge/eval/thinning.hpp"

#include <algorithm>
#include <iterator>

#include "by_strength.hpp"
#include "neighbourhood.hpp"

namespace thermedge::eval {
namespace {

// Conditions G1 and G2 of Lam, Lee & Suen, with x1..x8 = neighbours 0..7.
constexpr bool is_border(unsigned code) {
  int pairs_from_edge = 0;
  int pairs_from_corner = 0;
  for (int k = 0; k < kNeighbours; k += 2) {
    pairs_from_edge += has(code, k) || has(code, k + 1) ? 1 : 0;
    pairs_from_corner += has(code, k + 1) || has(code, k + 2) ? 1 : 0;
  }
  const int fewer = std::min(pairs_from_edge, pairs_from_corner);
  return crossings(code) == 1 && fewer >= 2 && fewer <= 3;
}

// G3 for the side of neighbour `k` (0: first pass, 4: second pass).
constexpr bool is_on_side(unsigned code, int k) {
  return !((has(code, k + 1) || has(code, k + 2) || !has(code, k + 7)) && has(code, k));
}

using Removable = std::array<std::array<bool, 256>, 2>;  // of the two passes, by neighbourhood

constexpr Removable make_removable() {
  Removable table{};
  for (unsigned code = 0; code < 256; ++code) {
    table[0][code] = is_border(code) && is_on_side(code, 0);
    table[1][code] = is_border(code) && is_on_side(code, 4);
  }
  return table;
}

constexpr Removable kRemovable = make_removable();

// Whether a pixel can go alone: no end, and no connection is broken.
constexpr std::array<bool, 256> make_spare() {
  std::array<bool, 256> table{};
  for (unsigned code = 0; code < 256; ++code) {
    table[code] = std::popcount(code) >= 2 && crossings(code) == 1;
  }
  return table;
}

constexpr std::array<bool, 256> kSpare = make_spare();

// A pass only has to look at pixels whose neighbours changed since it last saw them.
class Thinner {
 public:
  explicit Thinner(Neighbourhoods& pixels) : pixels_(pixels), waiting_(pixels.size(), 0) {
    for (const std::int32_t place : pixels.places()) {
      enqueue(place);
    }
  }

  void run() {
    while (!queues_[0].empty() || !queues_[1].empty()) {
      run_pass(0);
      run_pass(1);
    }
  }

 private:
  // A pixel that can't go now may be able to when its neighbours change, and is then seen again.
  void enqueue(std::int32_t place) {
    std::uint8_t& waiting = waiting_[static_cast<std::size_t>(place)];
    for (const unsigned pass : {0U, 1U}) {
      const auto bit = static_cast<std::uint8_t>(1U << pass);
      if ((waiting & bit) == 0 && kRemovable[pass][pixels_.code(place)]) {
        waiting |= bit;
        queues_[pass].push_back(place);
      }
    }
  }

  void run_pass(unsigned pass) {
    removed_.clear();
    for (const std::int32_t place : queues_[pass]) {
      waiting_[static_cast<std::size_t>(place)] &= static_cast<std::uint8_t>(~(1U << pass));
      if (pixels_.is_set(place) && kRemovable[pass][pixels_.code(place)]) {
        removed_.push_back(place);
      }
    }
    queues_[pass].clear();
    for (const std::int32_t place : removed_) {
      pixels_.remove(place);
    }
    for (const std::int32_t place : removed_) {
      for (unsigned left = pixels_.code(place); left != 0; left &= left - 1) {
        enqueue(pixels_.neighbour(place, std::countr_zero(left)));
      }
    }
  }

  Neighbourhoods& pixels_;
  std::vector<std::uint8_t> waiting_;  // bit 0, 1: in the queue of that pass
  std::array<std::vector<std::int32_t>, 2> queues_;
  std::vector<std::int32_t> removed_;
};

}  // namespace

Neighbourhoods::Neighbourhoods(ImageView<const std::uint8_t> map)
    : stride_(map.width() + 2),
      // The frame has one row above and one below, and a column on each side.
      steps_{1, 1 - stride_, -stride_, -1 - stride_, -1, stride_ - 1, stride_, stride_ + 1},
      set_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(map.height() + 2), 0),
      codes_(set_.size(), 0) {
  for (int y = 0; y < map.height(); ++y) {
    const std::uint8_t* row = map.row(y);
    for (int x = 0; x < map.width(); ++x) {
      if (row[x] != 0) {
        const std::int32_t place = (y + 1) * stride_ + x + 1;
        places_.push_back(place);
        set_[index(place)] = 1;
        for (int k = 0; k < kNeighbours; ++k) {
          codes_[index(neighbour(place, k))] |= static_cast<std::uint8_t>(1U << opposite(k));
        }
      }
    }
  }
}

void thin(ImageView<std::uint8_t> map) {
  Neighbourhoods pixels(map);
  Thinner(pixels).run();
  for (int y = 0; y < map.height(); ++y) {
    std::copy_n(pixels.row(y), map.width(), map.row(y));
  }
}

void thin_nested(ImageView<std::uint8_t> strength) {
  Neighbourhoods pixels(strength);
  std::vector<std::uint8_t> strengths;
  for (int y = 0; y < strength.height(); ++y) {
    std::copy_if(strength.row(y), strength.row(y) + strength.width(), std::back_inserter(strengths),
                 [](std::uint8_t value) { return value != 0; });
  }
  std::vector<std::int32_t> left = weakest_first(strengths);
  std::transform(left.begin(), left.end(), left.begin(), [&](std::int32_t index) {
    return pixels.places()[static_cast<std::size_t>(index)];
  });
  for (bool changed = true; changed;) {
    changed = false;
    for (const std::int32_t place : left) {
      if (pixels.is_set(place) && kSpare[pixels.code(place)]) {
        pixels.remove(place);
        changed = true;
      }
    }
  }
  for (int y = 0; y < strength.height(); ++y) {
    std::transform(strength.row(y), strength.row(y) + strength.width(), pixels.row(y),
                   strength.row(y), [](std::uint8_t value, std::uint8_t set) {
                     return static_cast<std::uint8_t>(set != 0 ? value : 0);
                   });
  }
}

}  // namespace thermedge::eval

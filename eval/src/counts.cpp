#include "thermedge/eval/counts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "by_strength.hpp"
#include "size_text.hpp"
#include "thermedge/eval/matching.hpp"
#include "thermedge/eval/thinning.hpp"

namespace thermedge::eval {
namespace {

// 1 where the strength is at least the threshold.
void set_at(ImageView<const std::uint8_t> strength, double threshold, Image<std::uint8_t>& map) {
  map.resize(strength.width(), strength.height());
  for (int y = 0; y < strength.height(); ++y) {
    std::transform(
        strength.row(y), strength.row(y) + strength.width(), map.row(y),
        [&](std::uint8_t value) { return static_cast<std::uint8_t>(value >= threshold ? 1 : 0); });
  }
}

bool same_pixels(ImageView<const std::uint8_t> map, ImageView<const std::uint8_t> truth) {
  for (int y = 0; y < map.height(); ++y) {
    if (!std::equal(map.row(y), map.row(y) + map.width(), truth.row(y),
                    [](std::uint8_t a, std::uint8_t b) { return (a != 0) == (b != 0); })) {
      return false;
    }
  }
  return true;
}

bool is_any_of(ImageView<const std::uint8_t> map, std::span<const Image<std::uint8_t>> annotators) {
  return std::any_of(annotators.begin(), annotators.end(), [&](const Image<std::uint8_t>& truth) {
    return same_pixels(map, truth.view());
  });
}

bool is_truth(ImageView<const std::uint8_t> strength, int threshold, const TruthMaps& truth) {
  Image<std::uint8_t> map;
  set_at(strength, threshold, map);
  return is_any_of(map.view(), truth.annotators);
}

double share(std::int64_t part, std::int64_t whole) {
  return static_cast<double>(part) / static_cast<double>(std::max<std::int64_t>(whole, 1));
}

// The pixels that any threshold finds, in reading order, and who can be matched with them.
class Counter {
 public:
  Counter(ImageView<const std::uint8_t> strength, const TruthMaps& truth, int lowest,
          const CountOptions& options)
      : strength_(strength), truth_(truth.annotators) {
    for (int y = 0; y < strength.height(); ++y) {
      for (int x = 0; x < strength.width(); ++x) {
        if (strength(x, y) >= lowest) {
          pixels_.push_back({x, y});
          ++histogram_[strength(x, y)];
        }
      }
    }
    const double radius_px = match_radius_px(options, strength.width(), strength.height());
    const auto graphs_of = [&](const std::vector<Image<std::uint8_t>>& maps) {
      std::vector<MatchGraph> graphs;
      graphs.reserve(maps.size());
      for (const auto& map : maps) {
        graphs.emplace_back(pixels_, map.view(), radius_px);
      }
      return graphs;
    };
    annotators_ = graphs_of(truth.annotators);
    accepted_ = graphs_of(truth.accepted);
  }

  [[nodiscard]] std::vector<MatchCounts> thin_each(std::span<const int> thresholds) const;
  [[nodiscard]] std::vector<MatchCounts> nested(std::span<const int> thresholds) const;

 private:
  // Whether the same pixels are found at both thresholds.
  [[nodiscard]] bool same_pixels(int lower, int higher) const {
    return std::all_of(histogram_.begin() + lower, histogram_.begin() + higher,
                       [](int count) { return count == 0; });
  }
  [[nodiscard]] std::int64_t truth_count() const {
    return std::accumulate(annotators_.begin(), annotators_.end(), std::int64_t{0},
                           [](std::int64_t sum, const MatchGraph& graph) {
                             return sum + static_cast<std::int64_t>(graph.truth_count());
                           });
  }
  // Numbers of the pixels that are left of those at or above the threshold.
  [[nodiscard]] std::vector<std::int32_t> thinned(int threshold) const;

  ImageView<const std::uint8_t> strength_;
  std::span<const Image<std::uint8_t>> truth_;
  std::vector<Pixel> pixels_;
  std::array<int, 256> histogram_{};
  std::vector<MatchGraph> annotators_;
  std::vector<MatchGraph> accepted_;
};

std::vector<std::int32_t> Counter::thinned(int threshold) const {
  Image<std::uint8_t> map;
  found_at(strength_, threshold, truth_, map);
  std::vector<std::int32_t> left;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (map(pixels_[i].x, pixels_[i].y) != 0) {
      left.push_back(static_cast<std::int32_t>(i));
    }
  }
  return left;
}

std::vector<MatchCounts> Counter::thin_each(std::span<const int> thresholds) const {
  std::vector<PixelMatcher> matchers;
  for (const auto* graphs : {&annotators_, &accepted_}) {
    for (const MatchGraph& graph : *graphs) {
      matchers.emplace_back(graph);
    }
  }
  const std::size_t first_of_precision = accepted_.empty() ? 0 : annotators_.size();
  std::vector<MatchCounts> counts(thresholds.size());
  for (std::size_t t = 0; t < thresholds.size(); ++t) {
    if (t > 0 && same_pixels(thresholds[t - 1], thresholds[t])) {
      counts[t] = counts[t - 1];
      continue;
    }
    const std::vector<std::int32_t> found = thinned(thresholds[t]);
    counts[t].truth = truth_count();
    counts[t].found = static_cast<std::int64_t>(found.size());
    for (std::size_t m = 0; m < matchers.size(); ++m) {
      const auto pairs = static_cast<std::int64_t>(matchers[m].match(found));
      counts[t].truth_matched += m < annotators_.size() ? pairs : 0;
    }
    counts[t].found_matched = std::count_if(found.begin(), found.end(), [&](std::int32_t pixel) {
      return std::any_of(matchers.begin() + static_cast<std::ptrdiff_t>(first_of_precision),
                         matchers.end(),
                         [&](const PixelMatcher& matcher) { return matcher.is_matched(pixel); });
    });
  }
  return counts;
}

std::vector<MatchCounts> Counter::nested(std::span<const int> thresholds) const {
  std::vector<std::uint8_t> weakness;  // so that equally strong pixels stay in reading order
  weakness.reserve(pixels_.size());
  for (const Pixel pixel : pixels_) {
    weakness.push_back(static_cast<std::uint8_t>(255 - strength_(pixel.x, pixel.y)));
  }
  const std::vector<std::int32_t> strongest_first = weakest_first(weakness);

  std::vector<std::int64_t> truth_gains(pixels_.size(), 0);
  std::vector<std::uint8_t> hits(pixels_.size(), 0);
  const auto add = [&](const std::vector<MatchGraph>& graphs, bool for_recall, bool for_hits) {
    for (const MatchGraph& graph : graphs) {
      const std::vector<std::uint8_t> gains = match_in_order(graph, strongest_first);
      for (std::size_t i = 0; i < gains.size(); ++i) {
        truth_gains[i] += for_recall ? gains[i] : 0;
        hits[i] |= for_hits ? gains[i] : std::uint8_t{0};
      }
    }
  };
  add(annotators_, true, accepted_.empty());
  add(accepted_, false, true);

  std::vector<MatchCounts> counts(thresholds.size());
  MatchCounts sum;
  sum.truth = truth_count();
  for (std::size_t t = thresholds.size(); t-- > 0;) {
    for (auto i = static_cast<std::size_t>(sum.found);
         i < pixels_.size() &&
         255 - weakness[static_cast<std::size_t>(strongest_first[i])] >= thresholds[t];
         ++i) {
      sum += {truth_gains[i], 0, hits[i], 1};
    }
    counts[t] = sum;
  }
  return counts;
}

Status check(ImageView<const std::uint8_t> strength, const TruthMaps& truth) {
  if (truth.annotators.empty()) {
    return failure(ErrorCode::kBadData, "the truth holds no edge map");
  }
  for (const auto* maps : {&truth.annotators, &truth.accepted}) {
    for (const auto& map : *maps) {
      if (!same_size(map.view(), strength)) {
        return failure(ErrorCode::kBadData,
                       size_text(strength) + " pixels, but its truth has " + size_text(map.view()));
      }
    }
  }
  return {};
}

}  // namespace

double f_measure(double precision, double recall) {
  return 2 * precision * recall / std::max(precision + recall, 1e-12);
}

// Where there is nothing to find and nothing was found, all is right.
double MatchCounts::recall() const {
  return truth == 0 && found == 0 ? 1 : share(truth_matched, truth);
}
double MatchCounts::precision() const {
  return truth == 0 && found == 0 ? 1 : share(found_matched, found);
}
double MatchCounts::f_measure() const { return eval::f_measure(precision(), recall()); }

MatchCounts& MatchCounts::operator+=(const MatchCounts& other) {
  truth_matched += other.truth_matched;
  truth += other.truth;
  found_matched += other.found_matched;
  found += other.found;
  return *this;
}

// The square root is rounded correctly everywhere, hypot is not.
double match_radius_px(const CountOptions& options, int width, int height) {
  const double w = width;
  const double h = height;
  return options.max_distance * std::sqrt(w * w + h * h);
}

void thin_at(ImageView<const std::uint8_t> strength, double threshold, Image<std::uint8_t>& map) {
  set_at(strength, threshold, map);
  thin(map);
}

void found_at(ImageView<const std::uint8_t> strength, double threshold,
              std::span<const Image<std::uint8_t>> annotators, Image<std::uint8_t>& map) {
  set_at(strength, threshold, map);
  if (!is_any_of(map.view(), annotators)) {
    thin(map);
  }
}

Result<std::vector<MatchCounts>> count_matches(ImageView<const std::uint8_t> strength,
                                               const TruthMaps& truth,
                                               std::span<const int> thresholds,
                                               const CountOptions& options) {
  if (Status status = check(strength, truth); !status) {
    return tl::unexpected(status.error());
  }
  if (thresholds.empty()) {
    return std::vector<MatchCounts>{};
  }
  if (options.thin || (thresholds.size() == 1 && is_truth(strength, thresholds.front(), truth))) {
    return Counter(strength, truth, thresholds.front(), options).thin_each(thresholds);
  }
  Image<std::uint8_t> thinned(strength.width(), strength.height());
  copy_pixels(strength, thinned.view());
  thin_nested(thinned);
  return Counter(thinned.view(), truth, thresholds.front(), options).nested(thresholds);
}

}  // namespace thermedge::eval

#include "thermedge/eval/scores.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "thermedge/edge_fields.hpp"

namespace thermedge::eval {
namespace {

// `count` values from `first` to `last`.
std::vector<double> spread(double first, double last, int count) {
  std::vector<double> values(static_cast<std::size_t>(count), first);
  const double step = count > 1 ? (last - first) / (count - 1) : 0.0;
  for (int i = 1; i < count; ++i) {
    values[static_cast<std::size_t>(i)] = i * step + first;
  }
  if (count > 1) {
    values.back() = last;
  }
  return values;
}

struct OperatingPoint {
  double threshold, precision, recall;
};

// The best point on the curve; of equally good ones the first. Thresholds may have any distance, so
// each gap is looked at in as many steps.
void find_best(std::span<const OperatingPoint> curve, Scores& scores) {
  constexpr int kSteps = 100;
  const std::vector<double> steps = spread(0, 1, kSteps);
  scores.f = -1;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const OperatingPoint& to = curve[i];
    const OperatingPoint& from = curve[i > 0 ? i - 1 : 0];
    for (std::size_t s = i > 0 ? 0 : steps.size() - 1; s < steps.size(); ++s) {
      const double d = steps[s];
      const double recall = to.recall * d + from.recall * (1 - d);
      const double precision = to.precision * d + from.precision * (1 - d);
      const double f = f_measure(precision, recall);
      if (f > scores.f) {
        scores.f = f;
        scores.threshold = to.threshold * d + from.threshold * (1 - d);
        scores.precision = precision;
        scores.recall = recall;
      }
    }
  }
}

// Precision is interpolated between recalls; of the points of one recall, that of the lowest
// threshold counts. Outside of the recalls that were reached there is no area.
double average_precision(std::vector<OperatingPoint> curve) {
  std::stable_sort(
      curve.begin(), curve.end(),
      [](const OperatingPoint& a, const OperatingPoint& b) { return a.recall < b.recall; });
  curve.erase(std::unique(curve.begin(), curve.end(),
                          [](const OperatingPoint& a, const OperatingPoint& b) {
                            return a.recall == b.recall;
                          }),
              curve.end());
  if (curve.size() < 2) {
    return 0;
  }
  constexpr double kStep = 0.01;
  double sum = 0;
  std::size_t right = 1;
  for (int i = 0; i <= 100; ++i) {
    const double recall = i * kStep;
    if (recall < curve.front().recall || recall > curve.back().recall) {
      continue;
    }
    while (curve[right].recall < recall) {
      ++right;
    }
    const OperatingPoint& a = curve[right - 1];
    const OperatingPoint& b = curve[right];
    sum += a.precision + (b.precision - a.precision) * (recall - a.recall) / (b.recall - a.recall);
  }
  return sum * kStep;
}

MatchCounts best_of(const std::vector<MatchCounts>& counts) {
  return *std::max_element(
      counts.begin(), counts.end(),
      [](const MatchCounts& a, const MatchCounts& b) { return a.f_measure() < b.f_measure(); });
}

// The set pixels as one edge, for the distance transform.
EdgeSet edges_of(ImageView<const std::uint8_t> map) {
  EdgeSet set;
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (map(x, y) != 0) {
        set.edgels.x.push_back(static_cast<float>(x));
        set.edgels.y.push_back(static_cast<float>(y));
      }
    }
  }
  Edge edge;
  edge.edgels = {0, static_cast<std::uint32_t>(set.edgels.size())};
  set.edges.push_back(edge);
  set.kept = 1;
  return set;
}

double merit_of(ImageView<const std::uint8_t> found, std::size_t found_count,
                ImageView<const std::uint8_t> truth) {
  const EdgeSet edges = edges_of(truth);
  const std::size_t truth_count = edges.edgels.size();
  if (found_count == 0 || truth_count == 0) {
    return found_count == truth_count ? 1 : 0;
  }
  DistanceTransform transform;
  DistanceField field;
  transform.run(edges, found.width(), found.height(),
                static_cast<float>(found.width() + found.height()), field);
  double sum = 0;
  for (int y = 0; y < found.height(); ++y) {
    for (int x = 0; x < found.width(); ++x) {
      if (found(x, y) != 0) {
        const auto distance = static_cast<double>(field.distance_px(x, y));
        sum += 1 / (1 + distance * distance / 9);
      }
    }
  }
  return sum / static_cast<double>(std::max(found_count, truth_count));
}

}  // namespace

std::vector<int> spread_thresholds(int count) {
  const double margin = 1.0 / (count + 1);
  std::vector<int> thresholds;
  for (const double share : spread(margin, 1 - margin, count)) {
    thresholds.push_back(static_cast<int>(std::ceil(share * 255)));
  }
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  return thresholds;
}

Scores score(std::span<const std::vector<MatchCounts>> counts, std::span<const int> thresholds) {
  std::vector<MatchCounts> sums(thresholds.size());
  MatchCounts at_best;
  for (const auto& frame : counts) {
    for (std::size_t t = 0; t < sums.size(); ++t) {
      sums[t] += frame[t];
    }
    at_best += best_of(frame);
  }
  std::vector<OperatingPoint> curve;
  for (std::size_t t = 0; t < sums.size(); ++t) {
    curve.push_back({static_cast<double>(thresholds[t]), sums[t].precision(), sums[t].recall()});
  }
  Scores scores;
  find_best(curve, scores);
  scores.ois = at_best.f_measure();
  scores.ap = average_precision(std::move(curve));
  return scores;
}

PrattFom pratt_merit(ImageView<const std::uint8_t> found,
                     std::span<const Image<std::uint8_t>> annotators) {
  std::size_t found_count = 0;
  for (int y = 0; y < found.height(); ++y) {
    found_count += static_cast<std::size_t>(
        found.width() - std::count(found.row(y), found.row(y) + found.width(), 0));
  }
  PrattFom merit;
  for (const auto& truth : annotators) {
    const double value = merit_of(found, found_count, truth);
    merit.mean += value;
    merit.best = std::max(merit.best, value);
  }
  merit.mean /= static_cast<double>(std::max<std::size_t>(annotators.size(), 1));
  return merit;
}

}  // namespace thermedge::eval

#include "hota.hpp"

#include <cmath>
#include <map>

#include "assignment.hpp"

namespace thermedge::eval {
namespace {

constexpr std::size_t kAlphas = 19;
constexpr std::size_t kLevels = kAlphas + 1;  // the last one: every pair within reach

double alpha_of(std::size_t level) { return static_cast<double>(level + 1) * 0.05; }

using IdPair = std::pair<std::int32_t, std::int32_t>;  // true edge, track

// Over all frames, before any pairs are formed.
struct Totals {
  std::map<std::int32_t, double> truth, found;  // samples of each identity
  std::map<IdPair, double> possible;            // shares of them that may be pairs
  double true_samples = 0, found_samples = 0;

  // Jaccard index of two identities.
  [[nodiscard]] double alignment(const IdPair& ids) const {
    const double both = possible.at(ids);
    return both / (truth.at(ids.first) + found.at(ids.second) - both);
  }
};

IdPair ids_of(const FrameSamples& frame, const SamplePair& pair) {
  return {frame.true_visits[static_cast<std::size_t>(pair.truth)],
          frame.tracks[static_cast<std::size_t>(pair.found)]};
}

void add_frame(const FrameSamples& frame, Totals& totals) {
  for (const std::int32_t id : frame.true_visits) {
    ++totals.truth[id];
  }
  for (const std::int32_t id : frame.tracks) {
    ++totals.found[id];
  }
  totals.true_samples += static_cast<double>(frame.true_visits.size());
  totals.found_samples += static_cast<double>(frame.tracks.size());
  std::vector<double> by_truth(frame.true_visits.size(), 0);
  std::vector<double> by_found(frame.tracks.size(), 0);
  for (const SamplePair& pair : frame.pairs) {
    by_truth[static_cast<std::size_t>(pair.truth)] += static_cast<double>(pair.similarity);
    by_found[static_cast<std::size_t>(pair.found)] += static_cast<double>(pair.similarity);
  }
  for (const SamplePair& pair : frame.pairs) {
    const auto similarity = static_cast<double>(pair.similarity);
    totals.possible[ids_of(frame, pair)] +=
        similarity / (by_truth[static_cast<std::size_t>(pair.truth)] +
                      by_found[static_cast<std::size_t>(pair.found)] - similarity);
  }
}

// Pairs that are formed, by the identities, at each level.
struct Matches {
  std::map<IdPair, std::array<std::int64_t, kLevels>> counts;
  std::array<std::int64_t, kLevels> pairs{};
  std::array<double, kLevels> similarity{};

  void add(const IdPair& ids, double value) {
    auto& of_ids = counts[ids];
    constexpr double kSlack = 1e-6;  // similarities are rounded
    for (std::size_t level = 0; level < kLevels; ++level) {
      if (level == kAlphas || value >= alpha_of(level) - kSlack) {
        ++of_ids[level];
        ++pairs[level];
        similarity[level] += value;
      }
    }
  }
  void add(const Matches& other) {
    for (const auto& [ids, more] : other.counts) {
      auto& of_ids = counts[ids];
      for (std::size_t level = 0; level < kLevels; ++level) {
        of_ids[level] += more[level];
      }
    }
    for (std::size_t level = 0; level < kLevels; ++level) {
      pairs[level] += other.pairs[level];
      similarity[level] += other.similarity[level];
    }
  }
};

Matches match(const FrameSamples& frame, const Totals& totals) {
  constexpr double kAlong = 1e-6;  // of equal pairs, those that lie side by side
  std::vector<PossiblePair> pairs;
  pairs.reserve(frame.pairs.size());
  for (const SamplePair& pair : frame.pairs) {
    const double gain = totals.alignment(ids_of(frame, pair)) *
                        static_cast<double>(pair.similarity) *
                        (1 - kAlong * static_cast<double>(pair.along_px));
    pairs.push_back({pair.truth, pair.found, gain});
  }
  const auto partners = best_assignment(pairs, frame.true_visits.size(), frame.tracks.size());
  Matches matches;
  for (const SamplePair& pair : frame.pairs) {
    if (partners[static_cast<std::size_t>(pair.truth)] == pair.found) {
      matches.add(ids_of(frame, pair), static_cast<double>(pair.similarity));
    }
  }
  return matches;
}

double share(double part, double whole) { return whole > 0 ? part / whole : 0; }

Hota figures_at(std::size_t level, const Matches& matches, const Totals& totals) {
  const auto pairs = static_cast<double>(matches.pairs[level]);
  Hota result;
  result.det_re = share(pairs, totals.true_samples);
  result.det_pr = share(pairs, totals.found_samples);
  result.det_a = share(pairs, totals.true_samples + totals.found_samples - pairs);
  for (const auto& [ids, counts] : matches.counts) {
    const auto both = static_cast<double>(counts[level]);
    const double truth = totals.truth.at(ids.first);
    const double found = totals.found.at(ids.second);
    result.ass_a += share(both * both, (truth + found - both) * pairs);
    result.ass_re += share(both * both, truth * pairs);
    result.ass_pr += share(both * both, found * pairs);
  }
  result.hota = std::sqrt(result.det_a * result.ass_a);
  result.loc_a = matches.similarity[level] / pairs;
  return result;
}

Hota mean_of(const std::vector<Hota>& all) {
  Hota mean;
  double with_pairs = 0;
  for (const Hota& one : all) {
    for (const auto field : {&Hota::hota, &Hota::det_a, &Hota::det_re, &Hota::det_pr, &Hota::ass_a,
                             &Hota::ass_re, &Hota::ass_pr}) {
      mean.*field += one.*field / static_cast<double>(all.size());
    }
    if (!std::isnan(one.loc_a)) {
      mean.loc_a += one.loc_a;
      ++with_pairs;
    }
  }
  mean.loc_a /= with_pairs;
  return mean;
}

}  // namespace

HotaFigures measure_hota(std::span<const FrameSamples* const> frames, ParallelRunner& runner) {
  Totals totals;
  for (const FrameSamples* frame : frames) {
    add_frame(*frame, totals);
  }
  std::vector<Matches> of_frames(frames.size());
  runner.run(static_cast<int>(frames.size()), [&](int i) {
    of_frames[static_cast<std::size_t>(i)] = match(*frames[static_cast<std::size_t>(i)], totals);
  });
  Matches matches;
  for (const Matches& one : of_frames) {
    matches.add(one);
  }
  HotaFigures figures;
  for (std::size_t level = 0; level < kAlphas; ++level) {
    figures.by_alpha.push_back(figures_at(level, matches, totals));
  }
  figures.mean = mean_of(figures.by_alpha);
  figures.at_reach = figures_at(kAlphas, matches, totals);
  return figures;
}

}  // namespace thermedge::eval

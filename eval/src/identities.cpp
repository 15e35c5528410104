#include "identities.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>
#include <set>

namespace thermedge::eval {
namespace {

using Id = std::int32_t;
using Length = std::int64_t;

// Lengths of the second identity of a pair, by the first.
using Table = std::map<Id, std::map<Id, Length>>;

void add_to(Table& table, const std::map<std::pair<Id, Id>, Length>& lengths) {
  for (const auto& [ids, length] : lengths) {
    table[ids.first][ids.second] += length;
  }
}

// How many lengths, largest first, make up 95 % of all.
std::size_t count_most(std::vector<Length> lengths) {
  std::sort(lengths.begin(), lengths.end(), std::greater<>());
  const Length all = std::accumulate(lengths.begin(), lengths.end(), Length{0});
  Length sum = 0;
  std::size_t count = 0;
  while (count < lengths.size() && sum * 100 < all * 95) {
    sum += lengths[count++];
  }
  return count;
}

void add_true_edge(const std::map<Id, Length>& labels, IdentityFigures& figures) {
  std::vector<Length> lengths;
  for (const auto& [track, length] : labels) {
    figures.found_px += static_cast<double>(length);
    if (track != kNoTrack) {
      lengths.push_back(length);
      figures.labelled_px += static_cast<double>(length);
    }
  }
  if (lengths.empty()) {
    return;
  }
  figures.main_px += static_cast<double>(*std::max_element(lengths.begin(), lengths.end()));
  ++figures.edges;
  figures.all_edge_ids += lengths.size();
  figures.edge_ids += count_most(std::move(lengths));
}

void add_track(Length length, const std::map<Id, Length>& places, const std::set<Id>& edges,
               IdentityFigures& figures) {
  if (places.empty()) {
    figures.false_px += static_cast<double>(length);
    return;
  }
  const auto main =
      std::max_element(places.begin(), places.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  if (edges.contains(main->first)) {
    ++figures.ids;
    figures.id_px += static_cast<double>(length);
    figures.pure_px += static_cast<double>(main->second);
  }
}

// Labels by visit over the frames [from, to).
Table labels_in(std::span<const FrameFigures> frames, std::size_t from, std::size_t to) {
  Table labels;
  for (std::size_t i = from; i < std::min(to, frames.size()); ++i) {
    add_to(labels, frames[i].labels);
  }
  return labels;
}

// The track with the most length; kNoTrack where there is none.
Id main_track(const std::map<Id, Length>& labels) {
  Id main = kNoTrack;
  Length most = 0;
  for (const auto& [track, length] : labels) {
    if (track != kNoTrack && length > most) {
      main = track;
      most = length;
    }
  }
  return main;
}

// The gap before frame `after`; the last frame before it is `before`.
void add_gap(std::span<const FrameFigures> frames, std::size_t before, std::size_t after,
             GapFigures& figures) {
  constexpr std::size_t kBefore = 5;
  constexpr std::size_t kSettle = 2;
  constexpr std::size_t kAfter = 5;
  const Table old = labels_in(frames, before + 1 - std::min(kBefore, before + 1), before + 1);
  const Table now = labels_in(frames, after + kSettle, after + kSettle + kAfter);
  ++figures.gaps;
  for (const auto& [visit, labels] : now) {
    const auto known = old.find(visit);
    const Id main = known == old.end() ? kNoTrack : main_track(known->second);
    if (main == kNoTrack) {
      continue;
    }
    for (const auto& [track, length] : labels) {
      figures.found_px += static_cast<double>(length);
      figures.same_px += track == main ? static_cast<double>(length) : 0;
    }
  }
}

}  // namespace

GapFigures measure_gaps(std::span<const FrameFigures> frames, const std::vector<bool>& counts) {
  GapFigures figures;
  std::size_t last = frames.size();  // that counts
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (counts[i] && last < i && i > last + 1) {
      add_gap(frames, last, i, figures);
    }
    last = counts[i] ? i : last;
  }
  return figures;
}

double IdentityFigures::harmonic_mean() const {
  return 2 * kept() * purity() / (kept() + purity());
}

double IdentityFigures::ids_per_edge() const {
  return static_cast<double>(edge_ids) / static_cast<double>(edges);
}

IdentityFigures measure_identities(std::span<const FrameFigures> frames, const TrackIndex& index) {
  IdentityFigures figures;
  Table labels;  // tracks by visit
  Table places;  // true edges by track
  std::map<Id, Length> tracks;
  for (const FrameFigures& frame : frames) {
    add_to(labels, frame.labels);
    add_to(places, frame.places);
    for (const auto& [track, length] : frame.track_px) {
      tracks[track] += length;
    }
    for (const auto& [visit, length] : frame.true_px) {
      figures.true_px += static_cast<double>(length);
    }
  }
  std::set<Id> edges;  // that count
  for (const Visit& visit : index.visits()) {
    if (visit.counts) {
      edges.insert(visit.edge);
    }
  }
  for (const auto& [visit, lengths] : labels) {
    add_true_edge(lengths, figures);
  }
  for (const auto& [track, length] : tracks) {
    add_track(length, places[track], edges, figures);
  }
  return figures;
}

}  // namespace thermedge::eval

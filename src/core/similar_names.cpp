#include "thermedge/similar_names.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>

namespace thermedge {
namespace {

constexpr std::size_t kMostNames = 3;
constexpr std::size_t kLettersPerMistake = 3;
constexpr std::size_t kShortestBeginning = 3;  // letters; fewer begin too many names
constexpr std::size_t kLongestWord = 100;      // letters; longer ones are no names

std::string folded(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return letter == '-' ? '_' : static_cast<char>(std::tolower(letter));
  });
  return text;
}

// Letters to be changed, added, removed or exchanged with their neighbour (optimal string
// alignment), row by row of the table of distances between beginnings of both words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    above[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    before.swap(above);
    above.swap(row);
  }
  return above[b.size()];
}

}  // namespace

std::vector<std::string> similar_names(std::string_view word, std::span<const std::string> names) {
  struct Candidate {
    std::size_t distance;
    const std::string* name;
  };
  std::vector<Candidate> candidates;
  if (word.size() > kLongestWord) {
    return {};
  }
  const std::string wanted = folded(word);
  const std::size_t most_mistakes = std::max<std::size_t>(wanted.size() / kLettersPerMistake, 1);
  for (const std::string& name : names) {
    const std::string known = folded(name);
    const std::size_t distance = edit_distance(wanted, known);
    const bool is_beginning = wanted.size() >= kShortestBeginning && known.starts_with(wanted);
    if (distance <= most_mistakes && distance < wanted.size()) {
      candidates.push_back({distance, &name});
    } else if (is_beginning) {
      candidates.push_back({most_mistakes + 1, &name});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  std::vector<std::string> similar;
  for (const Candidate& candidate : candidates) {
    // One that is much nearer than the others is what was meant.
    if (similar.size() < kMostNames && candidate.distance <= candidates[0].distance + 1) {
      similar.push_back(*candidate.name);
    }
  }
  return similar;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> names) {
  const std::vector<std::string> similar = similar_names(word, names);
  std::string text;
  for (std::size_t i = 0; i < similar.size(); ++i) {
    text += i == 0 ? "; did you mean " : i + 1 == similar.size() ? " or " : ", ";
    text += similar[i];
  }
  return text.empty() ? text : text + "?";
}

}  // namespace thermedge

// Which edges are kept.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "thermedge/edge_set.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

// Units of a contrast: counts (units of a float frame, levels of an 8-bit one), the noise at the
// edge's place, degrees.
enum class ContrastUnit { kCounts, kSigma, kDegc };
inline constexpr std::array kContrastUnits = {EnumName{ContrastUnit::kCounts, "counts"},
                                              EnumName{ContrastUnit::kSigma, "sigma"},
                                              EnumName{ContrastUnit::kDegc, "degC"}};

struct SelectionOptions {
  int keep_edges = 100;         // ET: how many of the best edges are kept; 0: all (text: no value)
  int max_edgels = 0;           // most edgels in the kept edges together; 0: any number
  double min_score = -1e9;      // edges with a lower score are too weak
  double max_false_alarms = 0;  // edges with a larger expected number are dropped; 0: no such test
  // Edges with a smaller contrast are dropped; 0: none. Not of preset paper. In degC it needs
  // degc_per_count; without noise every contrast is more than any number of sigma.
  Quantity<ContrastUnit> min_contrast = {};
  double degc_per_count = 0;  // worth of a count for min_contrast, 0..1000 degC; 0: not known

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

// The options that preset paper has, too.
template <OptionsOf<SelectionOptions> O>
struct SelectionWithoutContrast {
  O& options;
};
template <class O>
SelectionWithoutContrast(O&) -> SelectionWithoutContrast<O>;

template <class O, class V>
void visit_options(const SelectionWithoutContrast<O>& selection, V&& v) {
  auto& o = selection.options;
  v("keep_edges", o.keep_edges, Bounds{0, 1e9}, "ET: number of best edges that are kept (0: all)");
  v("max_edgels", o.max_edgels, Bounds{0, 1e9},
    "limit on the edgels of all kept edges together (0: none)");
  v("min_score", o.min_score, Bounds{-1e9, 1e9}, "edges with a lower score are dropped as weak");
  v("max_false_alarms", o.max_false_alarms, Bounds{0, 1e9},
    "expected number of false edges in a frame of pure noise (0: no test)");
}

template <OptionsOf<SelectionOptions> O, class V>
void visit_options(O& o, V&& v) {
  visit_options(SelectionWithoutContrast<O>{o}, v);
  v("min_contrast", o.min_contrast, QuantityRange{Bounds{0, 1e9}, kContrastUnits},
    "edges with a smaller contrast are dropped: a number of counts, or \"3sigma\", \"0.5degC\"");
  v("degc_per_count", o.degc_per_count, Bounds{0, 1000},
    "worth of a count, degC, which min_contrast in degC needs (0: not known)");
}

struct SelectionTuning {
  int junction_reach_px = 2;  // two kept edges within this of a junction meet there: edgels have
                              // moved to the ridge, at most a pixel, and curves share its pixels
};

// Gives each edge its status: too weak, not significant, of too little contrast, beyond a budget
// (the kept edges are the longest row of best ones within both) or kept. Those that passed the
// tests come first, each part in the order of its rank before; ids, ranks, connections and the
// edges of edgels follow. Paper: Algorithm 6 (ET). One object per thread; allocates on the first
// frame of a size only.
class EdgeSelector {
 public:
  explicit EdgeSelector(const SelectionOptions& options, const SelectionTuning& tuning = {})
      : options_(options), tuning_(tuning) {}

  // `counts_per_unit`: of a float frame, whose unit min_contrast is in (Corrections); contrasts are
  // still in counts. Errors: an option out of range.
  [[nodiscard]] Status run(EdgeSet& edges, double counts_per_unit = 1);

  // Keeps only the junctions at which two kept edges meet (within junction_reach_px). Call it after
  // run. `width`, `height`: of the frame.
  void keep_junctions(int width, int height, EdgeSet& edges);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const { return detail::memory_of(rank_of_, owner_); }

 private:
  [[nodiscard]] EdgeStatus judge(const Edge& edge, double counts_per_unit) const;
  [[nodiscard]] bool has_contrast(const Edge& edge, double counts_per_unit) const;
  void reorder(EdgeSet& edges);
  void keep_best(EdgeSet& edges) const;

  SelectionOptions options_;
  SelectionTuning tuning_;
  std::vector<std::int32_t> rank_of_;  // of each edge, by its rank before
  Image<std::int32_t> owner_;          // kept edge of each pixel, -1: none
};

}  // namespace thermedge

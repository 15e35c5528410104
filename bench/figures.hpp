// The measurements of edges_bench. Each writes one CSV file or two.
#pragma once

#include <string>
#include <vector>

namespace thermedge::bench {

struct BenchOptions {
  std::string out;                    // directory of the CSV files
  int scenes = 8;                     // random scenes; half as many others for tuning
  std::vector<std::string> prepared;  // directories of prepared scenes, see test_frames.hpp
};

void measure_noise(const BenchOptions& options);         // edges.csv: F over noise
void measure_conditions(const BenchOptions& options);    // conditions.csv: F in users' conditions
void measure_single_edges(const BenchOptions& options);  // single_edges.csv
void measure_false_alarms(const BenchOptions& options);  // false_alarms.csv, noise_kinds.csv
void measure_denoisers(const BenchOptions& options);     // denoisers_and_detectors.csv
void measure_scaling(const BenchOptions& options);       // scaling.csv: times

}  // namespace thermedge::bench

// Finds the one edge of a step and prints the version and the number of edges.
#include <cstdint>
#include <cstdio>
#include <vector>

#include "thermedge/detector.hpp"
#include "thermedge/version.hpp"

int main() {
  constexpr int kSize = 64;
  std::vector<std::uint16_t> counts(kSize * kSize, 1000);
  for (int y = 0; y < kSize; ++y) {
    for (int x = kSize / 2; x < kSize; ++x) {
      counts[y * kSize + x] = 3000;
    }
  }
  auto detector = thermedge::Detector::create({});
  if (!detector) {
    std::fprintf(stderr, "%s\n", detector.error().message.c_str());
    return 1;
  }
  const auto detection =
      detector->detect(thermedge::ImageView<const std::uint16_t>(counts.data(), kSize, kSize));
  if (!detection) {
    std::fprintf(stderr, "%s\n", detection.error().message.c_str());
    return 1;
  }
  const auto edges = detection->kept_edges().size();
  std::printf("%s: %zu edge%s\n", thermedge::kVersion, edges, edges == 1 ? "" : "s");
}

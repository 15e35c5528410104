// Detects the edges of one picture and prints the best ten.
//   detect FRAME.png
#include <algorithm>
#include <cstdio>

#include "thermedge/detector.hpp"
#include "thermedge/io/source.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: detect FRAME\n");
    return 2;
  }
  const auto frame = thermedge::io::read_picture(argv[1]);
  if (!frame) {
    std::fprintf(stderr, "%s\n", frame.error().message.c_str());
    return 1;
  }
  auto detector = thermedge::Detector::create();
  if (!detector) {
    std::fprintf(stderr, "%s\n", detector.error().message.c_str());
    return 1;
  }
  const auto detection = detector->detect(frame->frame());
  if (!detection) {
    std::fprintf(stderr, "%s\n", detection.error().message.c_str());
    return 1;
  }
  const auto kept = detection->kept_edges();
  for (const thermedge::Edge& edge : kept.first(std::min<std::size_t>(10, kept.size()))) {
    std::printf("edge %d: %.0f px, %.0f counts of contrast, %s\n", edge.index, edge.length_px,
                edge.contrast_counts, edge.closed ? "closed" : "open");
  }
}

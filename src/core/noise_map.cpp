#include <algorithm>

#include "thermedge/noise_model.hpp"

namespace thermedge {

void NoiseLevelMap::reserve(int frame_width, int frame_height) {
  across_.reserve(static_cast<std::size_t>(frame_width));
  down_.reserve(static_cast<std::size_t>(frame_height));
  nodes_.resize(frame_width / kNoiseBlockPx + 2, frame_height / kNoiseBlockPx + 2);
  nodes_.resize(0, 0);
}

void NoiseLevelMap::set_nodes(ImageView<const float> nodes, int frame_width, int frame_height) {
  nodes_.resize(nodes.width(), nodes.height());
  copy_pixels(nodes, nodes_.view());
  find_places(frame_width, nodes.width(), across_);
  find_places(frame_height, nodes.height(), down_);
}

void NoiseLevelMap::find_places(int pixels, int nodes, std::vector<Place>& places) {
  places.resize(static_cast<std::size_t>(pixels));
  const double way = std::max(2.0 * (pixels - kNoiseBlockPx), 1.0);  // of the nodes, in half pixels
  for (int i = 0; i < pixels; ++i) {
    const double gone = std::clamp(2.0 * i - (kNoiseBlockPx - 1), 0.0, way);
    const double at = gone * (nodes - 1) / way;
    const int node = std::min(static_cast<int>(at), nodes - 2);
    places[static_cast<std::size_t>(i)] = {node, at - node};
  }
}

double NoiseLevelMap::between(const Place& across, const Place& down) const {
  const auto on_row = [&](int row) {
    const double left = nodes_(across.node, row);
    return left + across.share * (nodes_(across.node + 1, row) - left);
  };
  const double upper = on_row(down.node);
  return upper + down.share * (on_row(down.node + 1) - upper);
}

double NoiseLevelMap::at(int x, int y) const {
  return is_even()
             ? 1
             : between(across_[static_cast<std::size_t>(x)], down_[static_cast<std::size_t>(y)]);
}

void NoiseLevelMap::row(int y, float* out) const {
  const Place& down = down_[static_cast<std::size_t>(y)];
  std::transform(across_.begin(), across_.end(), out,
                 [&](const Place& across) { return static_cast<float>(between(across, down)); });
}

}  // namespace thermedge

#include "thermedge/noise_model.hpp"

#include <algorithm>

#include "noise_map_simd.hpp"

namespace thermedge {

void NoiseLevelMap::reserve(int frame_width, int frame_height) {
  across_.reserve(static_cast<std::size_t>(frame_width));
  shares_.reserve(static_cast<std::size_t>(frame_width) + 1);
  down_.reserve(static_cast<std::size_t>(frame_height));
  nodes_.resize(frame_width / kNoiseBlockPx + 2, frame_height / kNoiseBlockPx + 2);
  nodes_.resize(0, 0);
}

void NoiseLevelMap::set_nodes(ImageView<const float> nodes, int frame_width, int frame_height) {
  nodes_.resize(nodes.width(), nodes.height());
  copy_pixels(nodes, nodes_.view());
  find_places(frame_width, nodes.width(), across_);
  find_places(frame_height, nodes.height(), down_);
  shares_.resize(across_.size() + 1);
  std::transform(across_.begin(), across_.end(), shares_.begin(),
                 [](const Place& place) { return place.share; });
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

// Of a column of nodes, at a row of the frame.
double NoiseLevelMap::on_column(int column, const Place& down) const {
  const double upper = nodes_(column, down.node);
  return upper + down.share * (nodes_(column, down.node + 1) - upper);
}

double NoiseLevelMap::at(int x, int y) const {
  if (is_even()) {
    return 1;
  }
  const Place& across = across_[static_cast<std::size_t>(x)];
  const Place& down = down_[static_cast<std::size_t>(y)];
  const double left = on_column(across.node, down);
  return left + across.share * (on_column(across.node + 1, down) - left);
}

template <class F>
void NoiseLevelMap::for_each_run(int y, F&& task) const {
  const Place& down = down_[static_cast<std::size_t>(y)];
  std::size_t x = 0;
  for (int column = 0; column + 1 < nodes_.width(); ++column) {
    const std::size_t begin = x;
    while (x < across_.size() && across_[x].node == column) {
      ++x;
    }
    const double left = on_column(column, down);
    const double step = on_column(column + 1, down) - left;
    task(begin, detail::LevelRun{&shares_[begin], left, step, static_cast<int>(x - begin)});
  }
}

void NoiseLevelMap::row(int y, float* out) const {
  for_each_run(y, [=](std::size_t x, const detail::LevelRun& run) { level_run(run, out + x); });
}

void NoiseLevelMap::even_out(ImageView<const float> in, float middle, float offset,
                             ImageView<float> out) const {
  for (int y = 0; y < in.height(); ++y) {
    for_each_run(y, [&](std::size_t x, const detail::LevelRun& run) {
      even_out_run(run, in.row(y) + x, middle, offset, out.row(y) + x);
    });
  }
}

void NoiseLevelMap::undo_even_out(float middle, ImageView<float> frame) const {
  for (int y = 0; y < frame.height(); ++y) {
    for_each_run(y, [&](std::size_t x, const detail::LevelRun& run) {
      undo_even_out_run(run, middle, frame.row(y) + x);
    });
  }
}

}  // namespace thermedge

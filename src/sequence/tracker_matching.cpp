// Where tracks are to be found in a frame, and which edgels go on from which samples.
#include <algorithm>
#include <array>
#include <cmath>

#include "tracker_state.hpp"

namespace thermedge {

using detail::dot;

bool Tracker::Impl::is_inside(const Sample& sample) const {
  return sample.x >= 0 && sample.y >= 0 && sample.x <= static_cast<float>(width - 1) &&
         sample.y <= static_cast<float>(height - 1);
}

// All samples by the motion of the picture. Normals turn with it: the derivative of the map along
// the edge is the edge's new direction.
void Tracker::Impl::predict(const Motion& motion) {
  const auto noise = static_cast<float>(tuning.motion_noise_px * tuning.motion_noise_px +
                                        motion.sigma_px * motion.sigma_px);
  for (Sample& sample : samples) {
    const Point at = motion({sample.x, sample.y});
    const Point along = motion({sample.x - sample.ny, sample.y + sample.nx});
    const float dx = along.x - at.x;
    const float dy = along.y - at.y;
    const float length = std::sqrt(dx * dx + dy * dy);
    sample.x = at.x;
    sample.y = at.y;
    if (length > 0) {
      sample.nx = dy / length;
      sample.ny = -dx / length;
    }
    sample.variance += noise;
  }
}

float Tracker::Impl::distance_along_normal(const Sample& sample, std::int32_t edgel) const {
  const auto e = static_cast<std::size_t>(edgel);
  return dot(edges->edgels.x[e] - sample.x, edges->edgels.y[e] - sample.y, sample.nx, sample.ny);
}

float Tracker::Impl::position_sigma(std::int32_t edgel) const {
  const float sigma = edges->edgels.position_sigma_px[static_cast<std::size_t>(edgel)];
  const auto least = static_cast<float>(tuning.least_position_sigma_px);
  return std::isfinite(sigma) ? std::hypot(sigma, least) : 1.0F;
}

float Tracker::Impl::gate_of(const Sample& sample) const {
  const double least = tuning.least_position_sigma_px;
  const double deviation = std::sqrt(static_cast<double>(sample.variance) + least * least);
  return static_cast<float>(std::clamp(3 * deviation, tuning.least_gate_px, tuning.most_gate_px));
}

// Whether an edgel looks like the continuation of a sample.
bool Tracker::Impl::agree(const Sample& sample, std::int32_t edgel, float gate) const {
  constexpr float kAlongPx = 2;  // how far apart along the edge
  const auto e = static_cast<std::size_t>(edgel);
  const Edgels& edgels = edges->edgels;
  const float dx = edgels.x[e] - sample.x;
  const float dy = edgels.y[e] - sample.y;
  if (std::abs(dot(dx, dy, sample.nx, sample.ny)) > gate ||
      std::abs(dot(dx, dy, -sample.ny, sample.nx)) > kAlongPx) {
    return false;
  }
  if (dot(edgels.nx[e], edgels.ny[e], sample.nx, sample.ny) <
      static_cast<float>(tuning.least_normal_cosine)) {
    return false;
  }
  const auto most = static_cast<float>(tuning.most_contrast_ratio);
  const float gradient = edgels.magnitude_counts[e];
  return gradient <= most * sample.gradient && sample.gradient <= most * gradient;
}

namespace {

// Where to look for the nearest of two that are close to each other, when the other one hides it:
// places along the normal, px.
constexpr std::array kLookPx = {0.0F, 2.0F, -2.0F, 4.0F, -4.0F};

}  // namespace

// The edgel that continues a sample; -1: none.
std::int32_t Tracker::Impl::find_edgel(const Sample& sample, float gate) const {
  for (const float far : kLookPx) {
    const std::int32_t edgel =
        edgel_field.at(sample.x + far * sample.nx, sample.y + far * sample.ny);
    if (edgel >= 0 && agree(sample, edgel, gate)) {
      return edgel;
    }
  }
  return -1;
}

// The sample that an edgel continues; -1: none.
std::int32_t Tracker::Impl::find_sample(std::size_t edgel) const {
  const Edgels& e = edges->edgels;
  for (const float far : kLookPx) {
    const std::int32_t found =
        sample_field.at(e.x[edgel] + far * e.nx[edgel], e.y[edgel] + far * e.ny[edgel]);
    if (found >= 0) {
      const Sample& sample = samples[static_cast<std::size_t>(found)];
      if (agree(sample, static_cast<std::int32_t>(edgel), gate_of(sample))) {
        return found;
      }
    }
  }
  return -1;
}

// Least squares of the distances along the normals, twice: what stays where it was along the
// direction in which nothing tells.
void Tracker::Impl::find_own_shifts() {
  constexpr int kRounds = 2;
  constexpr float kHuberPx = 1;
  constexpr double kPrior = 0.1;  // of the number of samples: a shift along an edge is not seen
  sums.resize(tracks.size());
  own_shifts.resize(tracks.size());
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    own_shifts[i] = {tracks[i].shift_x, tracks[i].shift_y};
  }
  for (int round = 0; round < kRounds; ++round) {
    std::fill(sums.begin(), sums.end(), NormalSums{});
    for (const Sample& sample : samples) {
      const auto t = static_cast<std::size_t>(sample.track);
      Sample moved = sample;
      moved.x += own_shifts[t][0];
      moved.y += own_shifts[t][1];
      const std::int32_t edgel = find_edgel(moved, static_cast<float>(tuning.most_gate_px));
      if (edgel < 0) {
        continue;
      }
      const float far = distance_along_normal(moved, edgel);
      const float weight = 1 / std::max(std::abs(far) / kHuberPx, 1.0F);
      const auto nx = static_cast<double>(sample.nx);
      const auto ny = static_cast<double>(sample.ny);
      const auto w = static_cast<double>(weight);
      NormalSums& sum = sums[t];
      sum.xx += w * nx * nx;
      sum.xy += w * nx * ny;
      sum.yy += w * ny * ny;
      sum.x += w * nx * static_cast<double>(far);
      sum.y += w * ny * static_cast<double>(far);
      ++sum.count;
    }
    for (std::size_t i = 0; i < tracks.size(); ++i) {
      const NormalSums& sum = sums[i];
      if (sum.count < tuning.shift_samples) {
        continue;
      }
      const double prior = kPrior * sum.count;
      const double xx = sum.xx + prior;
      const double yy = sum.yy + prior;
      const double determinant = xx * yy - sum.xy * sum.xy;
      own_shifts[i][0] += static_cast<float>((yy * sum.x - sum.xy * sum.y) / determinant);
      own_shifts[i][1] += static_cast<float>((xx * sum.y - sum.xy * sum.x) / determinant);
    }
  }
  for (Sample& sample : samples) {
    sample.x += own_shifts[static_cast<std::size_t>(sample.track)][0];
    sample.y += own_shifts[static_cast<std::size_t>(sample.track)][1];
  }
  const auto gain = static_cast<float>(tuning.shift_gain);
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    tracks[i].shift_x = gain * own_shifts[i][0];
    tracks[i].shift_y = gain * own_shifts[i][1];
  }
}

// Samples that left the picture go; the others are painted.
void Tracker::Impl::move_tracks() {
  std::erase_if(samples, [&](const Sample& sample) {
    const bool left = !is_inside(sample);
    track_of(sample.track).left = left;
    return left;
  });
  sample_field.start(width, height);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& s = samples[i];
    sample_field.paint(static_cast<std::int32_t>(i), s.x, s.y, s.nx, s.ny);
  }
}

// An edgel takes the vote of the sample nearest to it whose nearest edgel is on the same edge.
void Tracker::Impl::vote() {
  const Edgels& edgels = edges->edgels;
  for (const Edge& edge : edges->kept_edges()) {
    for (std::uint32_t i = edge.edgels.first; i < edge.edgels.first + edge.edgels.count; ++i) {
      const std::int32_t found = find_sample(i);
      if (found < 0) {
        continue;
      }
      const Sample& sample = samples[static_cast<std::size_t>(found)];
      const std::int32_t back = find_edgel(sample, gate_of(sample));
      if (back < 0 || edgels.edge[static_cast<std::size_t>(back)] != edgels.edge[i]) {
        continue;
      }
      const auto edgel = static_cast<std::int32_t>(i);
      const float far = distance_along_normal(sample, edgel);
      const float sigma = position_sigma(edgel);
      const float spread = sample.variance + sigma * sigma + 0.25F;
      votes[i] = {sample.track, 1 / (1 + far * far / spread)};
      voter[i] = found;
    }
  }
}

}  // namespace thermedge

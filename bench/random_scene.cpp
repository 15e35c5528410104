#include "random_scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "optics.hpp"
#include "thermedge/eval/thinning.hpp"

namespace thermedge::bench {
namespace {

using eval::Point;

constexpr int kWidth = 382;
constexpr int kHeight = 288;
constexpr int kSamples = 4;  // along a side of a pixel
constexpr double kPiecePx = 4;
constexpr double kStepPx = 0.25;

// Percentiles of the values: the darkest and the brightest spots don't set the range.
std::pair<double, double> range_of(ImageView<const float> image) {
  std::vector<float> values;
  for (int y = 0; y < image.height(); ++y) {
    values.insert(values.end(), image.row(y), image.row(y) + image.width());
  }
  const auto at = [&](double share) {
    const auto place = values.begin() +
                       static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return double{*place};
  };
  const double low = at(0.005);
  return {low, at(0.995)};
}

// Adds three waves of a few hundredths (times `share`), as long as half the frame and longer.
void add_background(Draws& draws, double share, ImageView<float> image) {
  struct Wave {
    double height, x, y, phase;
  };
  std::vector<Wave> waves;
  for (int i = 0; i < 3; ++i) {
    Wave wave;
    wave.height = share * draws.normal(0.03);
    wave.x = draws.uniform(-4, 4) / image.width();
    wave.y = draws.uniform(-4, 4) / image.height();
    wave.phase = draws.uniform(0, 6);
    waves.push_back(wave);
  }
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (const Wave& wave : waves) {
        // A parabola's arch repeated: as smooth as is needed, and the same on every machine.
        const double phase = wave.x * x + wave.y * y + wave.phase;
        const double saw = phase - 2 * std::floor(phase / 2) - 1;  // -1 .. 1
        image(x, y) += static_cast<float>(wave.height * 4 * saw * (1 - std::abs(saw)));
      }
    }
  }
}

void add(ImageView<const float> image, ImageView<float> sum) {
  for (int y = 0; y < sum.height(); ++y) {
    for (int x = 0; x < sum.width(); ++x) {
      sum(x, y) += image(x, y);
    }
  }
}

// A step as a share of the range; most are small.
double random_step(const SceneVariation& variation, Draws& draws) {
  const double share = draws.uniform(0, 1);
  const double size = variation.faint_steps ? 0.001 + 0.699 * share * share * share * share * share
                                            : 0.05 + 0.65 * share * share;
  return size * (draws.coin() ? 1 : -1);
}

void add_hot_things(std::uint64_t seed, double range, Painting& painting) {
  Draws draws(seed, 0x407);
  const int things = draws.integer(1, 3);
  for (int i = 0; i < things; ++i) {
    Polygon outline = random_small_shape(kWidth, kHeight, draws);
    painting.add(std::move(outline), range * draws.uniform(8, 46), 0, 0);
  }
}

}  // namespace

Image<std::uint8_t> truth_map(const eval::CurveFrame& edges, double least) {
  Image<std::uint8_t> map;
  eval::draw_curves(edges, least, map);
  eval::thin(map.view());
  for (int y = 0; y < map.height(); ++y) {
    for (int x = 0; x < map.width(); ++x) {
      if (x == 0 || y == 0 || x == map.width() - 1 || y == map.height() - 1) {
        map(x, y) = 0;
      }
    }
  }
  return map;
}

void Painting::add(Polygon outline, double step, double slope_x, double slope_y) {
  const auto& corners = outline.corners();
  const auto inside = std::find_if(corners.begin(), corners.end(), [&](Point corner) {
    return corner.x >= 0 && corner.y >= 0 && corner.x < width_ && corner.y < height_;
  });
  const std::size_t under = inside == corners.end() ? 0 : seen_at(*inside);
  surfaces_.push_back({surfaces_[under].level + step, slope_x, slope_y});
  outlines_.push_back(std::move(outline));
}

std::size_t Painting::seen_at(Point point) const {
  std::size_t surface = outlines_.size();
  while (surface > 0 && !outlines_[surface - 1].contains(point)) {
    --surface;
  }
  return surface;
}

double Painting::value(std::size_t surface, Point point) const {
  const Surface& s = surfaces_[surface];
  return s.level + s.slope_x * (point.x / width_ - 0.5) + s.slope_y * (point.y / height_ - 0.5);
}

// Samples of one line, `row` from -margin_px - .5 on.
void Painting::render_row(double y, int margin_px, std::vector<double>& crossings,
                          std::vector<float>& row) const {
  const auto position = [&](std::size_t i) {
    return (static_cast<double>(i) + 0.5) / kSamples - 0.5 - margin_px;
  };
  const auto first_behind = [&](double x) {
    const double index = std::ceil((x + 0.5 + margin_px) * kSamples - 0.5);
    return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(row.size())));
  };
  const auto paint = [&](std::size_t surface, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      row[i] = static_cast<float>(value(surface, {position(i), y}));
    }
  };
  paint(0, 0, row.size());
  for (std::size_t surface = 1; surface < surfaces_.size(); ++surface) {
    outlines_[surface - 1].crossings(y, crossings);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      paint(surface, first_behind(crossings[i]), first_behind(crossings[i + 1]));
    }
  }
}

Image<float> Painting::render(ParallelRunner& runner) const {
  constexpr int kPerFine = kSamples / sim::kSubpixels;
  sim::Optics optics(kOpticsPx, 0);
  const int margin = optics.margin_px();
  Image<float> fine((width_ + 2 * margin) * sim::kSubpixels,
                    (height_ + 2 * margin) * sim::kSubpixels);
  std::vector<float> row(static_cast<std::size_t>(fine.width() * kPerFine));
  std::vector<double> crossings;
  for (int y = 0; y < fine.height(); ++y) {
    std::fill_n(fine.row(y), fine.width(), 0.0F);
    for (int k = 0; k < kPerFine; ++k) {
      render_row((y * kPerFine + k + 0.5) / kSamples - 0.5 - margin, margin, crossings, row);
      for (std::size_t i = 0; i < row.size(); ++i) {
        fine.row(y)[i / kPerFine] += row[i] / (kPerFine * kPerFine);
      }
    }
  }
  Image<float> pixels(width_, height_);
  optics.run(fine, pixels, runner);
  return pixels;
}

std::vector<Painting::Sample> Painting::sample_outline(std::size_t surface) const {
  constexpr double kAside = 1e-3;  // px: far less than any of the things is wide
  const auto& corners = outlines_[surface - 1].corners();
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point from = corners[i];
    const Point to = corners[(i + 1) % corners.size()];
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const double length = std::sqrt(dx * dx + dy * dy);
    const int count = std::max(1, static_cast<int>(std::ceil(length / kStepPx)));
    for (int k = 0; k < count; ++k) {
      const double t = (k + 0.5) / count;
      const Point at{from.x + t * dx, from.y + t * dy};
      const Point aside{-dy / length * kAside, dx / length * kAside};
      const std::size_t one = seen_at({at.x + aside.x, at.y + aside.y});
      const std::size_t other = seen_at({at.x - aside.x, at.y - aside.y});
      if (one != other && std::max(one, other) == surface) {
        const std::size_t beside = std::min(one, other);
        samples.push_back({at, beside, std::abs(value(surface, at) - value(beside, at))});
      } else {
        samples.push_back({at, surface, 0});
      }
    }
  }
  return samples;
}

void Painting::add_outline(std::size_t surface, eval::CurveFrame& frame) const {
  const std::vector<Sample> samples = sample_outline(surface);
  constexpr auto kMost = static_cast<std::size_t>(kPiecePx / kStepPx);
  for (std::size_t begin = 0; begin < samples.size();) {
    const std::size_t beside = samples[begin].beside;
    std::size_t end = begin;
    eval::Curve piece;
    double steps = 0;
    for (; end < samples.size() && end - begin < kMost && samples[end].beside == beside; ++end) {
      piece.points.push_back(samples[end].at);
      steps += samples[end].step;
    }
    piece.contrast_counts = steps / static_cast<double>(end - begin);
    if (end < samples.size() && samples[end].beside == beside) {
      piece.points.push_back(samples[end].at);  // no gap to the next piece
    }
    if (beside != surface && piece.points.size() > 1) {
      frame.curves.push_back(std::move(piece));
    }
    begin = end;
  }
}

eval::CurveFrame Painting::edges() const {
  eval::CurveFrame frame;
  frame.width = width_;
  frame.height = height_;
  for (std::size_t surface = 1; surface < surfaces_.size(); ++surface) {
    add_outline(surface, frame);
  }
  return frame;
}

CleanScene random_scene(std::uint64_t seed, const SceneVariation& variation) {
  const double softness = variation.faint_steps ? 0.08 : 1;  // of slopes and background
  Draws draws(seed, 0xBE7C);
  const double ground_x = softness * draws.normal(0.08);
  Painting painting(kWidth, kHeight, {0, ground_x, softness * draws.normal(0.08)});
  const int things = draws.integer(14, 23);
  for (int i = 0; i < things; ++i) {
    Polygon outline = i < 2 && draws.coin() ? random_wall(kWidth, kHeight, draws)
                                            : random_shape(kWidth, kHeight, draws);
    const double step = random_step(variation, draws);
    const double slope_x = softness * draws.normal(0.06);
    painting.add(std::move(outline), step, slope_x, softness * draws.normal(0.06));
  }
  CleanScene scene;
  scene.shares = painting.render(*make_runner(1));
  Image<float> background(kWidth, kHeight);
  fill_pixels(background.view(), 0.0F);
  add_background(draws, softness, background);
  add(background, scene.shares);
  const auto [low, high] = range_of(scene.shares);
  if (variation.hot_things) {
    add_hot_things(seed, high - low, painting);
    scene.shares = painting.render(*make_runner(1));
    add(background, scene.shares);
  }
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      scene.shares(x, y) = static_cast<float>((scene.shares(x, y) - low) / (high - low));
    }
  }
  scene.edges = painting.edges();
  for (eval::Curve& curve : scene.edges.curves) {
    curve.contrast_counts /= high - low;
  }
  scene.truth.annotators.push_back(truth_map(scene.edges, kLeastAskedShare));
  scene.truth.accepted.push_back(truth_map(scene.edges, kLeastAcceptedShare));
  return scene;
}

}  // namespace thermedge::bench

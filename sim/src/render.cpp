#include "render.hpp"

#include <algorithm>
#include <cmath>

namespace thermedge::sim {
namespace {

// exp(-x) for x >= 0 from + * / alone: a series for x / 2^10, squared ten times.
double exact_exp_negative(double x) {
  constexpr int kSquarings = 10;
  const double small = x / (1 << kSquarings);
  double value = 1;
  for (int k = 8; k >= 1; --k) {
    value = 1 - value * small / k;
  }
  for (int i = 0; i < kSquarings; ++i) {
    value *= value;
  }
  return value;
}

std::vector<double> gaussian_kernel(double sigma_px) {
  const int radius = static_cast<int>(std::ceil(4 * sigma_px));
  std::vector<double> kernel;
  double sum = 0;
  for (int i = -radius; i <= radius; ++i) {
    kernel.push_back(exact_exp_negative(i * i / (2 * sigma_px * sigma_px)));
    sum += kernel.back();
  }
  for (double& weight : kernel) {
    weight /= sum;
  }
  return kernel;
}

// A part of a side that stays within one row: from xa to xb, `height` of the row high (signed).
// `row` holds differences: the sum up to x is the coverage of pixel x.
void add_side(double xa, double xb, double height, double* row, int width) {
  const double low = std::min(xa, xb);
  const double high = std::max(xa, xb);
  if (low >= width) {
    return;
  }
  if (high <= 0) {
    row[0] += height;
    return;
  }
  const double per_px = high > low ? height / (high - low) : 0;
  if (low < 0) {
    row[0] += -low * per_px;
  }
  for (int x = std::max(0, static_cast<int>(low)); x <= std::min(width - 1, static_cast<int>(high));
       ++x) {
    const double from = std::max(low, static_cast<double>(x));
    const double to = std::min(high, x + 1.0);
    const double part = high > low ? (to - from) * per_px : height;
    const double right = x + 1 - (from + to) / 2;  // how much of this cell lies to the right
    row[x] += part * right;
    if (x + 1 < width) {
      row[x + 1] += part * (1 - right);
    }
  }
}

void add_line(Point a, Point b, ImageView<double> coverage) {
  const double sign = a.y < b.y ? 1 : -1;
  if (a.y > b.y) {
    std::swap(a, b);
  }
  const double slope = (b.x - a.x) / (b.y - a.y);
  const int first = std::max(0, static_cast<int>(std::floor(a.y)));
  const int last = std::min(coverage.height() - 1, static_cast<int>(std::floor(b.y)));
  for (int y = first; y <= last; ++y) {
    const double top = std::max(a.y, static_cast<double>(y));
    const double bottom = std::min(b.y, y + 1.0);
    if (bottom > top) {
      add_side(a.x + (top - a.y) * slope, a.x + (bottom - a.y) * slope, sign * (bottom - top),
               coverage.row(y), coverage.width());
    }
  }
}

void paint(const Scene& scene, std::size_t index, Point origin, ImageView<double> coverage,
           ImageView<double> image) {
  const Object& object = scene.objects()[index];
  cover(object.outline, origin, coverage);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (const double share = coverage(x, y); share > 0) {
        const double counts = scene.object_at(index, {x + origin.x, y + origin.y});
        image(x, y) += share * (counts - image(x, y));
      }
    }
  }
}

}  // namespace

void cover(const Outline& outline, Point origin, ImageView<double> coverage) {
  fill_pixels(coverage, 0.0);
  // Pixel squares begin half a pixel before their centres.
  const auto to_cells = [&](Point p) { return Point{p.x - origin.x + 0.5, p.y - origin.y + 0.5}; };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Point a = to_cells(outline[i]);
    const Point b = to_cells(outline[(i + 1) % outline.size()]);
    if (a.y != b.y) {
      add_line(a, b, coverage);
    }
  }
  for (int y = 0; y < coverage.height(); ++y) {
    double sum = 0;
    for (int x = 0; x < coverage.width(); ++x) {
      sum += coverage(x, y);
      coverage(x, y) = std::min(1.0, std::abs(sum) < 1e-12 ? 0.0 : std::abs(sum));
    }
  }
}

void blur(ImageView<double> image, double sigma_px) {
  if (sigma_px <= 0) {
    return;
  }
  const std::vector<double> kernel = gaussian_kernel(sigma_px);
  const int radius = static_cast<int>(kernel.size() / 2);
  Image<double> across(image.width(), image.height());
  const auto clamped = [](int i, int size) { return std::clamp(i, 0, size - 1); };
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      double sum = 0;
      for (int k = -radius; k <= radius; ++k) {
        sum +=
            kernel[static_cast<std::size_t>(k + radius)] * image(clamped(x + k, image.width()), y);
      }
      across(x, y) = sum;
    }
  }
  for (int y = 0; y < image.height(); ++y) {
    std::fill_n(image.row(y), image.width(), 0.0);
    for (int k = -radius; k <= radius; ++k) {
      const double weight = kernel[static_cast<std::size_t>(k + radius)];
      const double* row = across.row(clamped(y + k, image.height()));
      for (int x = 0; x < image.width(); ++x) {
        image(x, y) += weight * row[x];
      }
    }
  }
}

Image<float> render_clean(const Scene& scene, int width, int height, double blur_px) {
  const int margin = static_cast<int>(std::ceil(4 * blur_px));
  const Point origin{-static_cast<double>(margin), -static_cast<double>(margin)};
  Image<double> image(width + 2 * margin, height + 2 * margin);
  Image<double> coverage(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      image(x, y) = scene.background_at({x + origin.x, y + origin.y});
    }
  }
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    paint(scene, i, origin, coverage, image);
  }
  blur(image, blur_px);
  Image<float> clean(width, height);
  copy_pixels(image.view().crop(margin, margin, width, height), clean.view());
  return clean;
}

}  // namespace thermedge::sim

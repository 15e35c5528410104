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

int kernel_radius(double sigma_px) { return static_cast<int>(std::ceil(4 * sigma_px)); }

std::vector<double> gaussian_kernel(double sigma_px) {
  const int radius = kernel_radius(sigma_px);
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
  cover(scene.objects()[index].outline, origin, coverage);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (const double share = coverage(x, y); share > 0) {
        const double counts = scene.object_at(index, {x + origin.x, y + origin.y});
        image(x, y) += share * (counts - image(x, y));
      }
    }
  }
}

// The blur works on samples: at blur 1 px a step lies within 0.01 px of its truth with two of them
// a pixel, within 0.04 px with one.
constexpr int kSubpixels = 2;
// A frame is rendered in bands of rows, to bound the memory and to skip objects far from the band.
constexpr int kBandRows = 64;

// Average over the sub-pixels of each pixel.
void shrink(ImageView<const double> fine, ImageView<float> pixels) {
  for (int y = 0; y < pixels.height(); ++y) {
    for (int x = 0; x < pixels.width(); ++x) {
      double sum = 0;
      for (int i = 0; i < kSubpixels * kSubpixels; ++i) {
        sum += fine(x * kSubpixels + i % kSubpixels, y * kSubpixels + i / kSubpixels);
      }
      pixels(x, y) = static_cast<float>(sum / (kSubpixels * kSubpixels));
    }
  }
}

// Renders the rows from first_row on; `fine` is the scene in sub-pixels.
void render_band(const Scene& fine, int first_row, double blur_px, ImageView<float> band) {
  const int margin = kernel_radius(blur_px * kSubpixels);
  const Point origin{-static_cast<double>(margin),
                     static_cast<double>(first_row * kSubpixels - margin)};
  Image<double> image(band.width() * kSubpixels + 2 * margin,
                      band.height() * kSubpixels + 2 * margin);
  Image<double> coverage(image.width(), image.height());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      image(x, y) = fine.background_at({x + origin.x, y + origin.y});
    }
  }
  for (std::size_t i = 0; i < fine.objects().size(); ++i) {
    const Box& box = fine.box(i);
    if (box.y_max > origin.y - 1 && box.y_min < origin.y + image.height()) {
      paint(fine, i, origin, coverage, image);
    }
  }
  blur(image, blur_px * kSubpixels);
  shrink(image.view().crop(margin, margin, band.width() * kSubpixels, band.height() * kSubpixels),
         band);
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
  Scene fine = scene;
  constexpr double kFirstCentre = (kSubpixels - 1) / 2.0;
  fine.transform(kSubpixels, kSubpixels, {kFirstCentre, kFirstCentre});
  Image<float> clean(width, height);
  for (int y = 0; y < height; y += kBandRows) {
    render_band(fine, y, blur_px, clean.view().crop(0, y, width, std::min(kBandRows, height - y)));
  }
  return clean;
}

}  // namespace thermedge::sim

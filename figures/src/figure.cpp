#include "thermedge/figures/figure.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <new>

#include "canvas.hpp"
#include "thermedge/io/files.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::figures {
namespace {

// A page as wide as one of A3 for the widest sheets.
constexpr double kPdfPointsPerPoint = 0.25;

// The surface has one owner. Cairo 1.16's SVG output forgets a reference to what it has painted,
// which would be lost memory.
struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const {
    cairo_surface_finish(surface);
    while (cairo_surface_get_reference_count(surface) > 1) {
      cairo_surface_destroy(surface);
    }
    cairo_surface_destroy(surface);
  }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
  return CAIRO_STATUS_SUCCESS;
}

// Draws the recording on `target`, enlarged by `scale`.
cairo_status_t replay(cairo_surface_t* recording, cairo_surface_t* target, double scale) {
  cairo_t* cairo = cairo_create(target);
  cairo_scale(cairo, scale, scale);
  cairo_set_source_surface(cairo, recording, 0, 0);
  cairo_paint(cairo);
  const cairo_status_t status = cairo_status(cairo);
  cairo_destroy(cairo);
  return status;
}

Status check(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) {
    return {};
  }
  return failure(
      status == CAIRO_STATUS_NO_MEMORY ? ErrorCode::kOutOfMemory : ErrorCode::kLimitExceeded,
      std::string("the figure cannot be drawn: ") + cairo_status_to_string(status));
}

Image<Rgb> to_picture(cairo_surface_t* surface) {
  Image<Rgb> picture(cairo_image_surface_get_width(surface),
                     cairo_image_surface_get_height(surface));
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      std::uint32_t packed = 0;
      std::memcpy(&packed, data + std::ptrdiff_t{y} * stride + std::ptrdiff_t{4} * x, 4);
      picture(x, y) = {static_cast<std::uint8_t>(packed >> 16 & 255U),
                       static_cast<std::uint8_t>(packed >> 8 & 255U),
                       static_cast<std::uint8_t>(packed & 255U)};
    }
  }
  return picture;
}

Result<std::string> encode_vectors(cairo_surface_t* recording, double width, double height,
                                   bool pdf) {
  std::string bytes;
  const double scale = pdf ? kPdfPointsPerPoint : 1;
  const Surface target(
      pdf ? cairo_pdf_surface_create_for_stream(append, &bytes, width * scale, height * scale)
          : cairo_svg_surface_create_for_stream(append, &bytes, width, height));
  if (pdf) {
    // A fixed date: equal figures are equal files.
    cairo_pdf_surface_set_metadata(target.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                   "2000-01-01T00:00:00Z");
  }
  cairo_status_t status = replay(recording, target.get(), scale);
  cairo_surface_finish(target.get());
  if (status == CAIRO_STATUS_SUCCESS) {
    status = cairo_surface_status(target.get());
  }
  return check(status).map([&] { return bytes; });
}

}  // namespace

struct Figure::Recording {
  Surface surface;
};

Figure::Figure(double width, double height, const std::function<void(Canvas&)>& draw)
    : recording_(std::make_unique<Recording>()),
      width_(std::ceil(width)),
      height_(std::ceil(height)) {
  const cairo_rectangle_t extents = {0, 0, width_, height_};
  recording_->surface.reset(cairo_recording_surface_create(CAIRO_CONTENT_COLOR, &extents));
  Canvas canvas(recording_->surface.get());
  canvas.fill({0, 0, width_, height_}, kPaper);
  draw(canvas);
}

Figure::Figure(Figure&&) noexcept = default;
Figure& Figure::operator=(Figure&&) noexcept = default;
Figure::~Figure() = default;

Result<Image<io::Rgb>> Figure::rasterise() const {
  const Surface target(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width_),
                                                  static_cast<int>(height_)));
  return check(replay(recording_->surface.get(), target.get(), 1)).map([&] {
    cairo_surface_flush(target.get());
    return to_picture(target.get());
  });
}

Status Figure::write(const std::string& path) const {
  if (!is_figure_path(path)) {
    return failure(ErrorCode::kInvalidArgument,
                   path + ": the name should end in .png, .svg or .pdf");
  }
  const auto with_path = [&](Error error) {
    error.message = path + ": " + error.message;
    return error;
  };
  if (io::ending_of(std::string(path)) == ".png") {
    return rasterise().map_error(with_path).and_then(
        [&](const Image<io::Rgb>& picture) { return io::write_picture(path, picture.view()); });
  }
  return encode_vectors(recording_->surface.get(), width_, height_,
                        io::ending_of(std::string(path)) == ".pdf")
      .map_error(with_path)
      .and_then([&](const std::string& bytes) { return io::write_file(path, bytes); });
}

bool is_figure_path(std::string_view path) {
  const std::string ending = io::ending_of(std::string(path));
  return ending == ".png" || ending == ".svg" || ending == ".pdf";
}

}  // namespace thermedge::figures

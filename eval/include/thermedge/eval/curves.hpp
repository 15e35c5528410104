// Sub-pixel edges of a frame, found or true, and what they say about each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/result.hpp"

namespace thermedge::eval {

struct Point {
  double x = 0, y = 0;  // px, pixel centres at integers
};

struct Curve {
  std::vector<Point> points;  // in walking order; a closed curve does not repeat its first point
  bool closed = false;
  double contrast_counts = std::numeric_limits<double>::quiet_NaN();  // NaN: not known
  std::int64_t id = -1;  // which edge of the world it is a piece of, over a sequence; -1: not known
};

struct CurveFrame {
  int width = 0;                                                   // px
  int height = 0;                                                  // px
  double sigma_counts = std::numeric_limits<double>::quiet_NaN();  // noise; NaN: not known
  std::vector<Curve> curves;
};

// A frame from one JSON object: {"width", "height", "edges": [{"points": [[x, y], ...], "closed",
// "contrast_counts", "id"}, ...], "sigma_counts"}; all but width, height, edges and points may be
// absent or null, other keys are passed over. `name` is for messages. Errors name the key.
// Thread-safe.
// So is an error: curves that are longer in all than four times the pixels of the frame.
[[nodiscard]] Result<CurveFrame> parse_curves(std::string_view json, const std::string& name);

// Paints the points of the curves (nearest pixel, 255), and the pixels between points that lie
// farther apart than neighbouring pixels, into a map of the frame's size, which is overwritten;
// parts outside are left out. Curves of less contrast are left out.
void draw_curves(const CurveFrame& frame, double least_contrast_counts, Image<std::uint8_t>& map);

// Finds the place on a set of curves that is nearest to a point. Immutable; thread-safe.
class NearestOnCurves {
 public:
  // reach_px > 0: how far away a curve is found.
  NearestOnCurves(std::span<const Curve> curves, double reach_px);

  struct Place {
    double distance_px = std::numeric_limits<double>::infinity();  // infinity: nothing within reach
    // Offset from the curve: positive to the right of its walking direction as the frame is seen
    // (x right, y down).
    double offset_px = 0;
    bool beside = false;  // not beyond an open end of the curve
  };
  [[nodiscard]] Place nearest(Point point) const;
  [[nodiscard]] bool is_near(Point point) const { return nearest(point).distance_px <= reach_px_; }

  // The place on one straight part of a curve that is nearest to a point.
  struct PartPlace {
    std::size_t curve = 0;  // index of the curve
    std::size_t part = 0;   // index of the point that the part begins at
    double share = 0;       // of the part that lies before the place, 0..1
    Point foot;             // the place itself
    Point along;            // unit vector in walking direction; 0 on a lone point
    Place place;
  };
  // Calls visit for each part within reach; a part may come more than once.
  void visit_near(Point point, const std::function<void(const PartPlace&)>& visit) const;

 private:
  struct Segment {
    Point from, to;
    std::size_t curve = 0, part = 0;
    bool open_from = false, open_to = false;  // nothing follows there
  };
  [[nodiscard]] PartPlace place_on(const Segment& segment, Point point) const;
  void add_to_cells(std::uint32_t index);
  template <class F>
  void for_each_cell(Point low, Point high, F&& visit) const;

  double reach_px_;
  double cell_px_;
  Point low_{0, 0};
  int columns_ = 0, rows_ = 0;
  std::vector<Segment> segments_;
  std::vector<std::vector<std::uint32_t>> cells_;
};

// How far found points lie from the true edge next to them, along its normal. Sums, so that frames
// can be added up; points beyond an open end or out of reach don't count.
struct Localisation {
  std::int64_t points = 0;
  double offset_sum_px = 0;
  double squared_sum_px2 = 0;

  [[nodiscard]] double mean_px() const;  // signed, see NearestOnCurves; NaN without points
  [[nodiscard]] double rms_px() const;   // NaN without points
  Localisation& operator+=(const Localisation& other);
};
[[nodiscard]] Localisation localise(const CurveFrame& found, const CurveFrame& truth,
                                    double reach_px);

// Length of true edges and how much of it was found, by contrast. Bin i holds contrasts from
// limits[i] up to limits[i + 1] (the last one: and above).
struct ContrastRecall {
  std::vector<double> limits;
  std::vector<double> true_px;
  std::vector<double> found_px;

  ContrastRecall() = default;
  explicit ContrastRecall(std::vector<double> bin_limits);
  // Adds the true curves of a frame, in pieces of at most half a pixel; a piece is found where a
  // found curve passes within reach_px. Contrasts are divided by `unit_counts` (1: counts; sigma:
  // in units of the noise). Curves of unknown contrast or below the first limit are passed over.
  void add(const CurveFrame& found, const CurveFrame& truth, double reach_px, double unit_counts);
  ContrastRecall& operator+=(const ContrastRecall& other);
};

// Points of `from` that are found again: of those that `motion` takes into the frame of `to`, how
// many lie within reach_px of a curve there.
struct Repeatability {
  std::int64_t points = 0;
  std::int64_t repeated = 0;

  [[nodiscard]] double share() const;  // NaN without points
};
[[nodiscard]] Repeatability repeatability(const CurveFrame& from, const CurveFrame& to,
                                          const std::function<Point(Point)>& motion,
                                          double reach_px = 1);

// The same under the whole-pixel shift within +-most_px that repeats the most points (ties: the
// shortest, then the uppermost, then the leftmost).
struct ShiftedRepeatability {
  int dx = 0, dy = 0;  // px, added to the points of `from`
  Repeatability repeatability;
};
[[nodiscard]] ShiftedRepeatability best_shift(const CurveFrame& from, const CurveFrame& to,
                                              int most_px, double reach_px = 1);

// How much of a true edge was found in a frame, over all its pieces.
struct EdgeShare {
  std::int64_t id = 0;
  double true_px = 0;
  double found_px = 0;  // within reach of a found curve
};
// Rising ids; curves without one are passed over.
[[nodiscard]] std::vector<EdgeShare> found_by_id(const CurveFrame& found, const CurveFrame& truth,
                                                 double reach_px);

// Repeatability where truth knows which edge is which, so that no motion need be known: of the true
// edges of which at least half was found in a frame and that the next one shows as well, those of
// which half was found there again. Lengths in the first frame, so that frames can be added up.
struct EdgeRepeatability {
  double found_px = 0;
  double again_px = 0;

  [[nodiscard]] double share() const;  // NaN where nothing was found
  EdgeRepeatability& operator+=(const EdgeRepeatability& other);
};
[[nodiscard]] EdgeRepeatability repeatability_by_id(std::span<const EdgeShare> from,
                                                    std::span<const EdgeShare> to);

// Each set pixel of a map as a curve of one point, so that maps can be compared as curves are.
[[nodiscard]] CurveFrame pixels_as_curves(ImageView<const std::uint8_t> map);

}  // namespace thermedge::eval

// Pixels of a frame that are no measurement, found by the frame itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "thermedge/geometry.hpp"
#include "thermedge/image.hpp"
#include "thermedge/memory.hpp"
#include "thermedge/option_list.hpp"
#include "thermedge/result.hpp"

namespace thermedge {

struct ValidityOptions {
  bool find = true;  // find black corners and bars, dead lines and blocks, telemetry lines

  // Fails with one line that names the option: out of its range, or at odds with another one.
  [[nodiscard]] Status check() const;
};

template <OptionsOf<ValidityOptions> O, class V>
void visit_options(O& o, V&& v) {
  v("find", o.find, Bounds{0, 1},
    "find pixels that are no measurement: black corners, bars, dead lines, telemetry");
}

// Chosen so that frames of noise of every kind, recordings and simulated scenes, which have none,
// lose nothing.
struct ValidityTuning {
  // Neighbours that are equal, of all: above the first the picture is drawn, not measured, and
  // nothing is looked for; above the second chance and compression make constant blocks. White
  // noise of 1/4 and of 1/2 count has about these shares.
  double most_equal_share = 0.8;
  double most_equal_share_of_blocks = 0.5;
  // Border areas: the least size, that of a wedge 8 px high and 16 px wide, smaller ones reach no
  // farther than the border of kernels; the most of the frame, as a picture that is smaller than
  // its frame is rather an object before a clipped background.
  int least_area_px = 64;
  double most_area_share = 0.45;
  double rough_outline_share = 0.05;  // of the outline, that may bend back
  // A difference of this many times the usual one between neighbours is none of noise, and the
  // share of an outline (or of a line) where it must be as large.
  int jump_factor = 8;
  int least_jump_counts = 4;
  double jump_share = 0.75;
  // How far a line may stand out of its neighbours, in units of how far these stand out of the
  // next ones: what optics of 0.7 px and more allow (bad_pixels.hpp). The largest difference of a
  // step is at most 2.3 times the next one, that of the flank of a step outside of the frame 14
  // times where it is a quarter of the step.
  int optics_ratio = 2;
  int step_ratio = 4;
  int flank_ratio = 16;
  int most_dead_lines = 4;       // side by side: more of them are an object
  int most_telemetry_lines = 4;  // at one side
  int least_block_px = 4;        // side; smaller ones are BadPixelOptions' business
  int most_block_px = 64;
  int most_blocks = 8;      // more of them are made by compression, and none is dead
  int sample_step_px = 16;  // rows and columns whose differences of neighbours are looked at
  int smallest_side_px = 16;
};

// What is no measurement, by where it is known from.
struct InvalidPixels {
  std::int64_t given = 0;  // pixels: by Frame::valid, or not finite
  std::int64_t found = 0;  // pixels of border areas, bars, blocks, telemetry
  int dead_rows = 0;       // replaced, and no hole: edges go on over them
  int dead_columns = 0;
};

// Finds pixels that are no measurement:
//  - Border areas: pixels of the frame's smallest value that are connected (4 neighbours), at least
//    64 of them, and hold a corner of the frame or half of one of its sides: the black corners of
//    undistorted frames. A row or column crosses their outline twice at most, and most of the
//    outline is a jump that no noise makes. Noise that is clipped at the floor has neither: its
//    areas are full of holes. With them goes 1 px around, where resampling mixes both.
//  - Bars: rows (or columns) of one value each, whichever, from the border on.
//  - Telemetry: the first or last 1 to 4 rows (columns), where these have nothing to do with what
//    follows: farther off than a step of the scene through optics, and smoother or rougher along
//    the row than the picture.
//  - Dead blocks: rectangles of one value, 4 to 64 px a side, among pixels that differ.
//  - Dead rows and columns, up to 4 side by side: those of one value, over half of the length or
//    more, among lines that have none; single lines that are far off both neighbours over all of
//    their length. They are replaced by what lies on either side and count as measured then, so
//    that edges go on over them; those at the border, which have one side only, are holes.
//
// An area at the largest value inside the picture, or one at the smallest that does not fill a
// corner, stays: a saturated hot object is no measurement, but its outline is an edge of the scene
// that people want. Its inside has no noise, so estimators that take the quieter half of a frame
// should leave constant areas out. A clear sky cut off at the smallest value, with a smooth skyline
// over all of the frame, cannot be told from a black corner and is taken for one: find = false.
//
// Pixels that compare differences with noise need some: in drawn pictures nothing is found. Whole
// numbers throughout: the same everywhere, mirrored and transposed frames alike. One object per
// thread; allocates on the first frame of a size only. Cost: about 0.15 ms for 382x288.
class InvalidFinder {
 public:
  explicit InvalidFinder(const ValidityTuning& tuning = {}) : tuning_(tuning) {}

  // Makes room for frames of this size.
  void prepare(int width, int height);

  // Sets `valid` to 0 where pixels are found and replaces dead lines in `counts`, whose numbers it
  // writes into `invalid`. Pixels that were known before are filled (HoleFiller) or take part in
  // all comparisons. Frames under smallest_side_px a side are left as they are.
  void run(ImageView<std::uint16_t> counts, ImageView<std::uint8_t> valid, InvalidPixels& invalid);

  // Memory held, bytes.
  [[nodiscard]] std::size_t memory_bytes() const {
    return detail::memory_of(before_, area_, marks_, area_rows_, area_columns_, row_sums_,
                             column_sums_, row_equals_, column_equals_, sample_, blocks_, row_runs_,
                             column_runs_);
  }

 private:
  // The frame seen by rows, or by columns; defined in the source.
  struct Lines;
  // Dead pixels `first` .. `last` of a line, and the lines alive on either side.
  struct Run {
    int line, first, last;
    int before, after;
  };
  struct Block {
    int left, top, right, bottom;  // all inside
    [[nodiscard]] int width() const { return right - left + 1; }
    [[nodiscard]] int height() const { return bottom - top + 1; }
    friend bool operator==(const Block&, const Block&) = default;
  };

  void measure(ImageView<const std::uint16_t> counts);
  void measure_differences(ImageView<const std::uint16_t> counts);
  void find_border_areas(ImageView<const std::uint16_t> counts, ImageView<std::uint8_t> valid);
  bool grow_area(ImageView<const std::uint16_t> counts, Pixel seed);
  void forget_area(std::size_t from);
  [[nodiscard]] bool fills_border(std::span<const Pixel> area) const;
  void find_blocks(ImageView<const std::uint16_t> counts, ImageView<std::uint8_t> valid);
  [[nodiscard]] bool is_dead_block(ImageView<const std::uint16_t> counts, const Block& block) const;
  void find_dead_lines(const Lines& lines, std::vector<Run>& runs) const;
  void add_constant_run(const Lines& lines, Run run, std::vector<Run>& runs) const;
  [[nodiscard]] bool is_far_off(const Lines& lines, int line) const;
  [[nodiscard]] bool is_steep(int value, int near, int next) const;
  static int replace(const Lines& lines, const Lines& old, std::span<const Run> runs,
                     ImageView<std::uint8_t> valid);
  void replace_crossings(ImageView<std::uint16_t> counts) const;
  void find_border_lines(const Lines& lines, ImageView<std::uint8_t> valid);
  [[nodiscard]] int bar_lines(const Lines& lines, bool from_end) const;
  [[nodiscard]] int telemetry_lines(const Lines& lines, bool from_end);

  ValidityTuning tuning_;
  int low_ = 0, high_ = 0;                     // smallest and largest count
  double equal_share_ = 0;                     // of neighbours, those at low_ and high_ left out
  int usual_jump_counts_ = 0;                  // median difference of neighbours
  int far_counts_ = 0;                         // what no noise makes of it
  std::vector<Pixel> area_;                    // border areas, one after the other
  Image<std::uint8_t> marks_;                  // of their pixels
  std::vector<int> area_rows_, area_columns_;  // how often each crosses the outline
  std::vector<std::uint32_t> row_sums_, column_sums_;
  std::vector<std::uint32_t> row_equals_, column_equals_;  // neighbours that are equal, along each
  std::vector<int> sample_;
  std::vector<Block> blocks_;
  std::vector<Run> row_runs_, column_runs_;
  Image<std::uint16_t> before_;  // lines were replaced
};

}  // namespace thermedge

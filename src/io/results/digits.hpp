// Numbers of text files with the digits that they deserve, so that a score reads 2.8668 and not
// 2.866765877271155. Private.
#pragma once

namespace thermedge::io {

// The nearest number with `digits` digits after the point, 0 to 9. Not finite: as it is.
[[nodiscard]] double to_decimals(double value, int digits);

// The nearest number with `digits` digits in all, 1 to 17, for what spans many decades. Not finite:
// as it is.
[[nodiscard]] double to_significant(double value, int digits);

// Of edges and their points, in every kind of file.
inline constexpr int kPositionDecimals = 3;  // far below what any position is known to
inline constexpr int kNormalDecimals = 4;
inline constexpr int kStrengthDigits = 4;
inline constexpr int kPositionSigmaDigits = 3;
inline constexpr int kScoreDigits = 5;
inline constexpr int kContrastDigits = 4;

}  // namespace thermedge::io

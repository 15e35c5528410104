% Edge maps of GNU Octave's `edge` (image package) for the test of the classical detectors.
% usage: octave make_golden.m, in the directory of the levels that make_golden.sh writes
pkg load image
names = {"desk_6", "desk_20", "corridor_6", "corridor_20"};
for n = names
  levels = double (imread ([n{1} ".pgm"])) / 255;
  for method = {"prewitt", "roberts", "sobel", "log"}
    imwrite (edge (levels, method{1}), [n{1} "_" method{1} ".png"]);
  endfor
endfor

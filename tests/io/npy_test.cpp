// The header of .npy is a Python dictionary: what is understood of it, and what is not.
#include <gtest/gtest.h>

#include "support/decoding.hpp"
#include "support/encoded_pictures.hpp"

namespace thermedge::io {
namespace {

using namespace std::string_literals;
using test::decoded;
using test::error_of;
using test::npy_file;
using test::pixels_of;

TEST(NpyHeader, MayBeSpacedAndOrderedOtherwise) {
  for (const char* header : {
           "{'descr': '<u2', 'fortran_order': False, 'shape': (1, 2), }          \n",
           "{'descr':'<u2','fortran_order':False,'shape':(1,2)}",
           "{ 'shape' : ( 1 , 2 , ) , 'fortran_order' : False , 'descr' : '<u2' }\n",
       }) {
    EXPECT_EQ(pixels_of(decoded(npy_file(header, "\x01\x02\x03\x04"))),
              (std::vector{0x0201, 0x0403}))
        << header;
  }
}

TEST(NpyHeader, MayBeOfBooleans) {
  EXPECT_EQ(pixels_of(decoded(npy_file("{'descr': '|b1', 'fortran_order': False, 'shape': (1, 2)}",
                                       "\x01\x00"s))),
            (std::vector{1, 0}));
}

TEST(NpyHeader, MayBeOfVersions1To3) {
  const std::string header = "{'descr': '>u2', 'fortran_order': False, 'shape': (1, 1), }\n";
  for (const char version : {'\1', '\2', '\3'}) {
    EXPECT_EQ(pixels_of(decoded(npy_file(header, "\x01\x02", version))), std::vector{0x0102});
  }
  EXPECT_EQ(error_of(decoded(npy_file(header, "\x01\x02", 4))),
            "file: an NPY of version 4; versions 1 to 3 are read");
}

TEST(NpyHeader, FortranOrderOfWidePixelsInStacks) {
  // Element (frame, y, x) of shape (2, 3, 2) lies at frame + 2 * (y + 3 * x) and holds that number.
  for (const bool big : {false, true}) {
    std::string data;
    for (unsigned i = 0; i < 12; ++i) {
      data += test::number(i * 257 + 1, 2, big);
    }
    const std::string header = std::string("{'descr': '") + (big ? ">" : "<") +
                               "u2', 'fortran_order': True, 'shape': (2, 3, 2), }";
    for (int frame = 0; frame < 2; ++frame) {
      std::vector<int> expected;
      for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 2; ++x) {
          expected.push_back((frame + 2 * (y + 3 * x)) * 257 + 1);
        }
      }
      EXPECT_EQ(pixels_of(decoded(npy_file(header, data), static_cast<std::size_t>(frame))),
                expected);
    }
  }
}

TEST(NpyHeader, OtherThingsAreErrors) {
  const std::string plain = "file: damaged NPY: its header does not describe an array of numbers";
  const std::string shape = "file: damaged NPY: its shape is not a list of sizes";
  const std::string lacking = "file: damaged NPY: its header lacks descr, fortran_order or shape";
  for (const auto& [header, error] : std::vector<std::pair<std::string, std::string>>{
           {"", plain},
           {"{", plain},
           {"{}", lacking},
           {"{'descr': '<u2', 'shape': (1, 2)}", lacking},
           {"{'descr': '<u2' 'shape': (1, 2)}", plain},
           {"{'descr': '<u2, 'fortran_order': False}", plain},
           {"{'descr': [('a', '<u2')], 'fortran_order': False, 'shape': (1, 2)}", plain},
           {"{'descr': '<u2', 'fortran_order': 0, 'shape': (1, 2)}", plain},
           {"{'descr': '<u2', 'fortran_order': False, 'other': (1, 2)}", plain},
           {"{'descr': '<u2', 'fortran_order': False, 'shape': (1 2)}", shape},
           {"{'descr': '<u2', 'fortran_order': False, 'shape': (1, 2}", shape},
           {"{'descr': '<u2', 'fortran_order': False, 'shape': (1, 2", shape},
           {"{'descr': '<u2', 'fortran_order': False, 'shape': (1, 2.0)}", shape},
           {"{'descr': '<u2', 'fortran_order': False, 'shape': (1, 99999999999999999999)}", shape},
           {"{'descr': '<u2', 'fortran_order': False, 'shape': (0, 2)}",
            "file: the picture has no pixels (2x0)"},
           {"{'descr': '<u2', 'fortran_order': False, 'shape': (0, 1, 2)}",
            "file: damaged NPY: a stack without frames"},
           {"{'descr': '<f1', 'fortran_order': False, 'shape': (1, 2)}",
            "file: an NPY of '<f1'; frames are whole numbers or floats of 8 to 64 bits"},
           {"{'descr': '\x1b[2J\n', 'fortran_order': False, 'shape': (1, 2)}",
            "file: an NPY of '?[2J?'; frames are whole numbers or floats of 8 to 64 bits"},
           {"{'descr': '<u2', 'fortran_order': False, 'shape': ()}",
            "file: an NPY of 0 dimensions; frames have 2, stacks of frames 3"},
           {"{'descr': '|u1', 'fortran_order': False, 'shape': (48, 64, 3)}",
            "file: an NPY of shape (48, 64, 3), which looks like (height, width, frames or "
            "channels); a stack is (frames, height, width): numpy.save(FILE, numpy.moveaxis(a, -1, "
            "0)) makes it (3, 48, 64)"},
       }) {
    EXPECT_EQ(error_of(decoded(npy_file(header, "\x01\x02\x03\x04"))), error) << header;
  }
}

TEST(NpyPages, BeyondTheLastAreErrors) {
  const std::string file =
      npy_file("{'descr': '|u1', 'fortran_order': False, 'shape': (2, 1, 1)}", "ab");
  EXPECT_EQ(pixels_of(decoded(file, 1)), std::vector<int>{'b'});
  EXPECT_EQ(error_of(decoded(file, 2)), "file: has no page 2 (the first is 0)");
}

}  // namespace
}  // namespace thermedge::io

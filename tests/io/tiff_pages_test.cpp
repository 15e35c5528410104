// The chain of TIFF directories, for files of both byte orders and both widths of offsets.
#include "codecs/tiff_pages.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "support/encoded_pictures.hpp"

namespace thermedge::io {
namespace {

using Link = TiffPageChain::Link;
using test::number;

// A file of directories without pictures, that lie behind one another in `order` and are linked in
// the order of their numbers; each has as many entries as its number.
class Directories {
 public:
  Directories(bool big_endian, bool big_tiff, const std::vector<std::size_t>& order)
      : big_endian_(big_endian),
        offset_bytes_(big_tiff ? 8 : 4),
        offsets_(order.size()),
        links_(order.size()) {
    file_ = (big_endian ? "MM" : "II") + number(big_tiff ? 43 : 42, 2, big_endian) +
            (big_tiff ? number(8, 2, big_endian) + number(0, 2, big_endian) : "");
    first_link_ = file_.size();
    file_ += number(0, offset_bytes_, big_endian);
    for (const std::size_t i : order) {
      offsets_[i] = file_.size();
      file_ += number(i, big_tiff ? 8 : 2, big_endian) + std::string((big_tiff ? 20 : 12) * i, 'x');
      links_[i] = file_.size();
      file_ += number(0, offset_bytes_, big_endian);
    }
    if (!order.empty()) {
      write_link(first_link_, offsets_[0]);
    }
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
      write_link(links_[i], offsets_[i + 1]);
    }
  }

  void link_last_to(std::uint64_t offset) { write_link(links_.back(), offset); }
  [[nodiscard]] std::uint64_t offset(std::size_t i) const { return offsets_[i]; }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  void write_link(std::size_t at, std::uint64_t offset) {
    file_.replace(at, static_cast<std::size_t>(offset_bytes_),
                  number(offset, offset_bytes_, big_endian_));
  }

  bool big_endian_;
  int offset_bytes_;
  std::string file_;
  std::size_t first_link_ = 0;
  std::vector<std::uint64_t> offsets_;
  std::vector<std::size_t> links_;
};

struct Walk {
  std::vector<std::uint64_t> pages;
  Link end = Link::kPage;
};

Walk walk(const std::string& file, std::size_t most = 1000) {
  TiffPageChain chain(std::as_bytes(std::span(file)));
  Walk walk;
  while (walk.pages.size() < most && (walk.end = chain.next()) == Link::kPage) {
    walk.pages.push_back(chain.offset());
  }
  return walk;
}

template <class Check>
void for_each_kind(Check&& check) {
  for (const bool big_endian : {false, true}) {
    for (const bool big_tiff : {false, true}) {
      SCOPED_TRACE(std::string(big_endian ? "MM" : "II") + (big_tiff ? ", BigTIFF" : ""));
      check(big_endian, big_tiff);
    }
  }
}

TEST(TiffPageChain, FollowsTheLinksWhereverTheDirectoriesLie) {
  for_each_kind([](bool big_endian, bool big_tiff) {
    const Directories directories(big_endian, big_tiff, {3, 0, 4, 1, 2});
    const Walk found = walk(directories.file());
    EXPECT_EQ(found.end, Link::kEnd);
    ASSERT_EQ(found.pages.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(found.pages[i], directories.offset(i));
    }
    EXPECT_EQ(walk(Directories(big_endian, big_tiff, {}).file()).end, Link::kEnd);
  });
}

// Every circle is seen after at most a few times its pages, and no chain is taken for one.
TEST(TiffPageChain, SeesCirclesOfAnyLengthBehindAnyNumberOfPages) {
  for_each_kind([](bool big_endian, bool big_tiff) {
    for (std::size_t count = 1; count <= 20; ++count) {
      std::vector<std::size_t> order(count);
      for (std::size_t i = 0; i < count; ++i) {
        order[i] = i;
      }
      Directories directories(big_endian, big_tiff, order);
      EXPECT_EQ(walk(directories.file()).pages.size(), count);
      for (std::size_t back = 0; back < count; ++back) {
        directories.link_last_to(directories.offset(back));
        const Walk found = walk(directories.file());
        EXPECT_EQ(found.end, Link::kCircle) << count << " back to " << back;
        EXPECT_GE(found.pages.size(), count);
        EXPECT_LE(found.pages.size(), 4 * count);
      }
    }
  });
}

TEST(TiffPageChain, PointsOutsideWhereAFileWasCut) {
  for_each_kind([](bool big_endian, bool big_tiff) {
    const Directories directories(big_endian, big_tiff, {0, 1, 2});
    const std::size_t count_bytes = big_tiff ? 8 : 2;
    for (std::size_t length = 0; length < directories.file().size(); ++length) {
      const Walk found = walk(directories.file().substr(0, length));
      EXPECT_EQ(found.end, Link::kOutside) << length;
      // A page is there as soon as its number of entries is.
      std::size_t whole = 0;
      while (whole < 3 && directories.offset(whole) + count_bytes <= length) {
        ++whole;
      }
      EXPECT_EQ(found.pages.size(), whole) << length;
    }
  });
}

TEST(TiffPageChain, PointsOutsideWhereAnOffsetIsAbsurd) {
  for_each_kind([](bool big_endian, bool big_tiff) {
    Directories directories(big_endian, big_tiff, {0, 1});
    for (const std::uint64_t offset : {directories.file().size() - 1, directories.file().size(),
                                       std::size_t{0x7FFFFFFF}, std::size_t{0xFFFFFFFF}}) {
      directories.link_last_to(offset);
      EXPECT_EQ(walk(directories.file()).end, Link::kOutside) << offset;
    }
  });
  Directories wide(false, true, {0, 1});
  wide.link_last_to(~std::uint64_t{0});
  EXPECT_EQ(walk(wide.file()).end, Link::kOutside);
}

// 20 bytes times this number of entries are 0 bytes modulo 2^64.
TEST(TiffPageChain, PointsOutsideBehindMoreEntriesThanAFileCanHold) {
  const Directories directories(false, true, {0, 1});
  std::string file = directories.file();
  file.replace(directories.offset(0), 8, number(std::uint64_t{1} << 62, 8, false));
  EXPECT_EQ(walk(file).pages.size(), 1U);
  EXPECT_EQ(walk(file).end, Link::kOutside);
}

// Bytes of which many are offsets within the file, so that all ends are met, circles too.
TEST(TiffPageChain, EndsForAnyBytes) {
  std::mt19937 random(101);
  std::map<Link, int> ends;
  for (int i = 0; i < 3000; ++i) {
    const bool big_endian = i % 2 != 0;
    std::string bytes = big_endian ? "MM" : "II";
    bytes += number(i % 3 == 0 ? 43 : 42, 2, big_endian);
    const std::size_t size = 16 + random() % 100;
    while (bytes.size() < size) {
      const bool offset = bytes.size() == 4 || random() % 3 != 0;
      bytes += number(offset ? random() % size / 4 * 4 + 2 : 0, 4, big_endian);
    }
    constexpr std::size_t kMost = 1000;
    const Walk found = walk(bytes, kMost);
    ASSERT_LT(found.pages.size(), kMost);
    ++ends[found.end];
  }
  EXPECT_EQ(ends.size(), 3U);
  for (const auto& [end, count] : ends) {
    EXPECT_GT(count, 30) << static_cast<int>(end);
  }
}

}  // namespace
}  // namespace thermedge::io

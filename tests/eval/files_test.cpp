// Truth and results on file: what is read, and what is wrong with the rest.
#include <gtest/gtest.h>
#include <matio.h>
#include <zip.h>

#include <algorithm>
#include <filesystem>

#include "support/encoded_pictures.hpp"
#include "support/files.hpp"
#include "thermedge/eval/files.hpp"
#include "thermedge/io/write.hpp"

namespace thermedge::eval {
namespace {

using test::npy_file;
using test::TemporaryDirectory;
using Entries = std::vector<std::pair<std::string, std::string>>;

void write_npz(const std::string& path, const Entries& entries, bool compressed) {
  int error = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &error);
  ASSERT_NE(archive, nullptr);
  for (const auto& [name, data] : entries) {
    const auto index = zip_file_add(archive, name.c_str(),
                                    zip_source_buffer(archive, data.data(), data.size(), 0), 0);
    ASSERT_GE(index, 0);
    zip_set_file_compression(archive, static_cast<zip_uint64_t>(index),
                             compressed ? ZIP_CM_DEFLATE : ZIP_CM_STORE, 0);
  }
  ASSERT_EQ(zip_close(archive), 0);
}

std::string header(const std::string& type, const std::string& shape) {
  return "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }\n";
}

// Two maps of 3x2.
std::string two_maps() {
  return npy_file(header("|u1", "(2, 2, 3)"), std::string("\0\1\0\0\2\0\1\0\0\0\0\xFF", 12));
}
std::string one_map() {
  return npy_file(header("|u1", "(1, 2, 3)"), std::string("\1\1\1\1\1\1", 6));
}

std::vector<int> pixels(const Image<std::uint8_t>& map) {
  std::vector<int> values;
  for (int y = 0; y < map.height(); ++y) {
    values.insert(values.end(), map.row(y), map.row(y) + map.width());
  }
  return values;
}

TEST(EvaluateNpz, HoldsAnnotatorsAndAccepted) {
  const TemporaryDirectory directory;
  for (const bool compressed : {true, false}) {
    write_npz(directory / "a.npz", {{"maps.npy", two_maps()}, {"all.npy", one_map()}}, compressed);
    const auto truth = read_npz_truth(directory / "a.npz");
    ASSERT_TRUE(truth) << truth.error().message;
    ASSERT_EQ(truth->annotators.size(), 2U);
    EXPECT_EQ(pixels(truth->annotators[0]), (std::vector{0, 1, 0, 0, 1, 0}));
    EXPECT_EQ(pixels(truth->annotators[1]), (std::vector{1, 0, 0, 0, 0, 1}));
    ASSERT_EQ(truth->accepted.size(), 1U);
    EXPECT_EQ(pixels(truth->accepted[0]), (std::vector{1, 1, 1, 1, 1, 1}));
  }
  write_npz(directory / "bool.npz",
            {{"maps.npy", npy_file(header("|b1", "(1, 1, 2)"), std::string("\0\1", 2))}}, true);
  const auto truth = read_npz_truth(directory / "bool.npz");
  ASSERT_TRUE(truth) << truth.error().message;
  EXPECT_EQ(pixels(truth->annotators[0]), (std::vector{0, 1}));
  EXPECT_TRUE(truth->accepted.empty());
}

TEST(EvaluateNpz, SaysWhatIsWrong) {
  const TemporaryDirectory directory;
  const std::string path = directory / "x.npz";
  struct Case {
    Entries entries;
    std::string message;
  };
  for (const Case& bad : {
           Case{{{"other.npy", one_map()}},
                ": should hold an array 'maps' of (annotators, height, width)"},
           Case{{{"maps.npy", npy_file(header("<c16", "(1, 1, 1)"), std::string(16, '\0'))}},
                ": maps.npy: an NPY of '<c16'"},
           Case{{{"maps.npy", npy_file(header("|u1", "(4,)"), "abcd")}}, ": maps.npy: an NPY of 1"},
           Case{{{"maps.npy", npy_file(header("|u1", "(1, 2, 3)"), "abc")}},
                ": maps.npy: damaged NPY: the file ends early"},
           Case{{{"maps.npy", "rubbish"}}, ": maps.npy: "},
           Case{{{"maps.npy", npy_file(header("|u1", "(1, 99999, 99999)"), "abc")}},
                ": maps.npy: "},
           Case{
               {{"maps.npy", two_maps()}, {"all.npy", npy_file(header("|u1", "(1, 1, 3)"), "abc")}},
               ": maps of different sizes, 3x2 and 3x1"},
       }) {
    write_npz(path, bad.entries, true);
    const auto truth = read_npz_truth(path);
    ASSERT_FALSE(truth) << bad.message;
    EXPECT_TRUE(truth.error().message.starts_with(path + bad.message)) << truth.error().message;
  }
  write_npz(path, {{"maps.npy", two_maps()}}, true);
  Limits limits;
  limits.max_bytes = 40;
  EXPECT_EQ(read_npz_truth(path, limits).error().code, ErrorCode::kLimitExceeded);
  limits.max_bytes = std::filesystem::file_size(path);
  EXPECT_FALSE(read_npz_truth(directory / "missing.npz"));
}

// Every beginning of a file is an error; a file with a byte changed is an error or was read with
// the checks of the archive passed.
TEST(EvaluateNpz, SurvivesDamage) {
  const TemporaryDirectory directory;
  const std::string path = directory / "x.npz";
  write_npz(path, {{"maps.npy", two_maps()}, {"all.npy", one_map()}}, true);
  const std::string whole = test::file_text(path);
  for (std::size_t length = 0; length < whole.size(); ++length) {
    test::write_text(path, whole.substr(0, length));
    const auto truth = read_npz_truth(path);
    ASSERT_FALSE(truth) << length;
    EXPECT_TRUE(truth.error().message.starts_with(path)) << truth.error().message;
    EXPECT_EQ(std::count(truth.error().message.begin(), truth.error().message.end(), '\n'), 0);
  }
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x41);
    test::write_text(path, damaged);
    const auto truth = read_npz_truth(path);
    refused += truth ? 0 : 1;
    if (truth) {
      EXPECT_EQ(pixels(truth->annotators[0]), (std::vector{0, 1, 0, 0, 1, 0})) << at;
    }
  }
  EXPECT_GT(refused, 100);
}

matvar_t* matrix(const char* name, std::vector<std::uint8_t> by_column, std::size_t height,
                 int flags = 0) {
  std::size_t dims[2] = {height, by_column.size() / height};
  return Mat_VarCreate(name, MAT_C_UINT8, MAT_T_UINT8, 2, dims, by_column.data(), flags);
}

matvar_t* annotator(const std::vector<std::uint8_t>& boundaries, std::size_t height) {
  const char* fields[] = {"Segmentation", "Boundaries"};
  std::size_t one[2] = {1, 1};
  matvar_t* entry = Mat_VarCreateStruct(nullptr, 2, one, fields, 2);
  Mat_VarSetStructFieldByName(entry, "Segmentation", 0, matrix("Segmentation", boundaries, height));
  Mat_VarSetStructFieldByName(entry, "Boundaries", 0,
                              matrix("Boundaries", boundaries, height, MAT_F_LOGICAL));
  return entry;
}

void write_mat(const std::string& path, const std::vector<matvar_t*>& variables,
               matio_compression compression) {
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5);
  ASSERT_NE(file, nullptr);
  for (matvar_t* variable : variables) {
    ASSERT_EQ(Mat_VarWrite(file, variable, compression), 0);
    Mat_VarFree(variable);
  }
  Mat_Close(file);
}

matvar_t* ground_truth(std::vector<matvar_t*> cells) {
  std::size_t dims[2] = {1, cells.size()};
  matvar_t* truth = Mat_VarCreate("groundTruth", MAT_C_CELL, MAT_T_CELL, 2, dims, nullptr, 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    Mat_VarSetCell(truth, static_cast<int>(i), cells[i]);
  }
  return truth;
}

TEST(EvaluateMat, HoldsAnnotatorsColumnByColumn) {
  const TemporaryDirectory directory;
  const std::string path = directory / "b.mat";
  for (const auto compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    write_mat(path,
              {ground_truth({annotator({0, 1, 0, 0, 1, 0}, 2), annotator({1, 1, 1, 0, 0, 0}, 2)})},
              compression);
    const auto truth = read_mat_truth(path);
    ASSERT_TRUE(truth) << truth.error().message;
    ASSERT_EQ(truth->annotators.size(), 2U);
    EXPECT_EQ(truth->annotators[0].width(), 3);
    EXPECT_EQ(pixels(truth->annotators[0]), (std::vector{0, 0, 1, 1, 0, 0}));
    EXPECT_EQ(pixels(truth->annotators[1]), (std::vector{1, 1, 0, 1, 0, 0}));
  }
  write_mat(path, {matrix("a", {1, 2, 0, 0}, 2), matrix("b", {0, 0, 0, 9}, 2)},
            MAT_COMPRESSION_ZLIB);
  const auto plain = read_mat_truth(path);
  ASSERT_TRUE(plain) << plain.error().message;
  ASSERT_EQ(plain->annotators.size(), 2U);
  EXPECT_EQ(pixels(plain->annotators[0]), (std::vector{1, 0, 1, 0}));
}

TEST(EvaluateMat, SaysWhatIsWrong) {
  const TemporaryDirectory directory;
  const std::string path = directory / "b.mat";
  const auto message = [&] { return read_mat_truth(path).error().message; };
  test::write_text(path, "rubbish");
  EXPECT_EQ(message(), path + ": no MAT file, or a damaged one");
  write_mat(path, {ground_truth({matrix("x", {1, 2}, 1)})}, MAT_COMPRESSION_NONE);
  EXPECT_EQ(message(), path + ": groundTruth should be a cell array of structs with Boundaries");
  write_mat(path, {matrix("groundTruth", {1, 2}, 1)}, MAT_COMPRESSION_NONE);
  EXPECT_EQ(message(), path + ": groundTruth should be a cell array of structs with Boundaries");
  write_mat(path, {matrix("a", {1, 2}, 1), matrix("b", {1, 2}, 2)}, MAT_COMPRESSION_NONE);
  EXPECT_EQ(message(), path + ": maps of different sizes, 2x1 and 1x2");
  write_mat(path, {}, MAT_COMPRESSION_NONE);
  EXPECT_EQ(message(), path +
                           ": should hold a cell array groundTruth with Boundaries, or matrices "
                           "of numbers");
  write_mat(path, {matrix("a", std::vector<std::uint8_t>(5000, 1), 50)}, MAT_COMPRESSION_ZLIB);
  Limits limits;
  limits.max_bytes = 4000;
  EXPECT_EQ(read_mat_truth(path, limits).error().code, ErrorCode::kLimitExceeded);
  EXPECT_FALSE(read_mat_truth(directory / "missing.mat"));
}

TEST(EvaluateMat, CutOffIsAnErrorOrFewerAnnotators) {
  const TemporaryDirectory directory;
  const std::string path = directory / "b.mat";
  for (const auto compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    write_mat(path, {ground_truth({annotator({0, 1, 0, 0, 1, 0}, 2)})}, compression);
    const std::string whole = test::file_text(path);
    for (std::size_t length = 0; length < whole.size(); length += 3) {
      test::write_text(path, whole.substr(0, length));
      const auto truth = read_mat_truth(path);
      if (!truth) {
        EXPECT_TRUE(truth.error().message.starts_with(path)) << truth.error().message;
      } else {
        EXPECT_EQ(truth->annotators.front().width(), 3) << length;
      }
    }
  }
}

void write_map(const std::string& path, int width, int height, std::uint8_t value) {
  Image<std::uint8_t> map(width, height);
  fill_pixels(map.view(), value);
  const Status status = io::write_picture(path, ImageView<const std::uint8_t>(map.view()));
  ASSERT_TRUE(status) << status.error().message;
}

constexpr const char* kOneEdge =
    R"({"width": 5, "height": 4, "edges": [{"points": [[0, 1], [4, 1]], "contrast_counts": 8},
{"points": [[0, 3], [4, 3]], "contrast_counts": 80}]})";

std::string on_one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text + "\n";
}

TEST(EvaluateSets, AreFoundByName) {
  const TemporaryDirectory directory;
  for (const char* name : {"found", "truth", "truth/c"}) {
    std::filesystem::create_directories(directory / name);
  }
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    write_map(directory / ("found/" + std::string(name) + ".png"), 5, 4, 200);
  }
  write_map(directory / "truth/a.png", 5, 4, 128);
  write_map(directory / "truth/b_1.png", 5, 4, 127);
  write_map(directory / "truth/b_2.png", 5, 4, 255);
  write_map(directory / "truth/c/x.png", 5, 4, 255);
  test::write_text(directory / "truth/d.json", kOneEdge);
  const auto found = PredictionSet::open(directory / "found");
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(found->names(), (std::vector<std::string>{"a", "b", "c", "d", "e"}));
  EXPECT_FALSE(found->has_curves());
  EXPECT_EQ(found->read(0)->map(0, 0), 200);

  const auto truth = GroundTruthSet::open(directory / "truth", {10, {}});
  ASSERT_TRUE(truth) << truth.error().message;
  EXPECT_TRUE(truth->check_frames(5));
  EXPECT_EQ(truth->read("a", 0)->maps.annotators[0](0, 0), 1);
  const auto b = truth->read("b", 1);
  ASSERT_EQ(b->maps.annotators.size(), 2U);
  EXPECT_EQ(b->maps.annotators[0](0, 0), 0);
  EXPECT_EQ(b->maps.annotators[1](0, 0), 1);
  EXPECT_EQ(truth->read("c", 2)->maps.annotators.size(), 1U);
  const auto d = truth->read("d", 3);
  ASSERT_TRUE(d) << d.error().message;
  EXPECT_EQ(d->curves->curves.size(), 2U);
  // The weak edge is accepted only.
  EXPECT_EQ(d->maps.annotators[0](2, 1), 0);
  EXPECT_EQ(d->maps.annotators[0](2, 3), 1);
  EXPECT_EQ(d->maps.accepted[0](2, 1), 1);
  EXPECT_EQ(truth->read("e", 4).error().message,
            directory / "truth/e: no truth there (.npz, .mat, .png, _*.png, .json)");
}

TEST(EvaluateSets, TrueMapsOfTwoValuesHaveEdgesWhereTheyAreNotZero) {
  const TemporaryDirectory directory;
  const auto edges_of = [&](std::vector<std::uint8_t> values) {
    Image<std::uint8_t> map(static_cast<int>(values.size()), 1);
    std::copy(values.begin(), values.end(), map.row(0));
    EXPECT_TRUE(io::write_picture(directory / "a.png", ImageView<const std::uint8_t>(map)));
    const auto set = GroundTruthSet::open(directory / "a.png", {});
    EXPECT_TRUE(set);
    const auto truth = set->read("a", 0);
    EXPECT_TRUE(truth);
    const std::uint8_t* row = truth->maps.annotators[0].row(0);
    return std::vector<int>(row, row + values.size());
  };
  EXPECT_EQ(edges_of({0, 1, 0}), (std::vector<int>{0, 1, 0}));
  EXPECT_EQ(edges_of({100, 0, 0}), (std::vector<int>{1, 0, 0}));
  EXPECT_EQ(edges_of({255, 0, 255}), (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(edges_of({0, 0}), (std::vector<int>{0, 0}));
  EXPECT_EQ(edges_of({1, 1}), (std::vector<int>{1, 1}));
  EXPECT_EQ(edges_of({0, 127, 128}), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(edges_of({127, 127}), (std::vector<int>{0, 0}));
  EXPECT_EQ(edges_of({254, 255}), (std::vector<int>{1, 1}));
}

// Neighbouring pixels of a diagonal have nothing painted beside them.
TEST(EvaluateSets, CurvesOfAMaskArePaintedAsTheMask) {
  CurveFrame frame;
  frame.width = 8;
  frame.height = 6;
  frame.curves.push_back({.points = {{1.4, 1.4}, {1.6, 2.4}, {2.6, 2.6}, {6, 2.6}}});
  Image<std::uint8_t> map;
  draw_curves(frame, 0, map);
  std::vector<std::pair<int, int>> painted;
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 8; ++x) {
      if (map(x, y) != 0) {
        painted.emplace_back(x, y);
      }
    }
  }
  EXPECT_EQ(painted,
            (std::vector<std::pair<int, int>>{{1, 1}, {2, 2}, {3, 3}, {4, 3}, {5, 3}, {6, 3}}));
}

TEST(EvaluateSets, AreInNaturalOrder) {
  const TemporaryDirectory directory;
  for (const std::string name : {"f10.png", "f9.png", "f1.png", ".f0.png"}) {
    write_map(directory / name, 2, 2, 0);
  }
  EXPECT_EQ(PredictionSet::open(directory.path().string())->names(),
            (std::vector<std::string>{"f1", "f9", "f10"}));
}

TEST(EvaluateSets, JsonLinesHoldFramesInOrder) {
  const TemporaryDirectory directory;
  test::write_text(directory / "t.jsonl",
                   on_one_line(kOneEdge) + "\n" + R"({"width": 7, "height": 3, "edges": []})");
  const auto truth = GroundTruthSet::open(directory / "t.jsonl", {});
  ASSERT_TRUE(truth) << truth.error().message;
  EXPECT_TRUE(truth->check_frames(2));
  EXPECT_EQ(truth->check_frames(3).error().message,
            directory / "t.jsonl: truth of 2 frames, but there are results of 3");
  EXPECT_EQ(truth->read("any", 1)->curves->width, 7);
  const auto found = PredictionSet::open(directory / "t.jsonl");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->names().size(), 2U);
  EXPECT_EQ(found->read(0)->map(0, 1), 255);
  // A directory that holds nothing but such a file.
  EXPECT_EQ(GroundTruthSet::open(directory.path().string(), {})->read("any", 1)->curves->width, 7);

  test::write_text(directory / "bad.jsonl", on_one_line(kOneEdge) + "\nrubbish\n");
  EXPECT_EQ(PredictionSet::open(directory / "bad.jsonl")->read(1).error().message,
            directory / "bad.jsonl:3: should be a JSON object with width, height and edges");
  test::write_text(directory / "empty.jsonl", "\n \n");
  EXPECT_FALSE(PredictionSet::open(directory / "empty.jsonl"));
}

TEST(EvaluateSets, RefuseWhatIsNoSet) {
  const TemporaryDirectory directory;
  EXPECT_EQ(PredictionSet::open(directory / "missing").error().message,
            directory / "missing: no such file or directory");
  EXPECT_FALSE(GroundTruthSet::open(directory / "missing", {}));
  EXPECT_EQ(PredictionSet::open(directory.path().string()).error().message,
            directory.path().string() + ": no edge maps (PNG) or results (JSON) in it");
  write_map(directory / "a.png", 2, 2, 0);
  test::write_text(directory / "a.json", "{}");
  EXPECT_EQ(PredictionSet::open(directory.path().string()).error().message,
            directory.path().string() +
                ": holds PNG and JSON files; name a directory that holds one kind");
  Image<std::uint16_t> deep(2, 2);
  ASSERT_TRUE(
      io::write_picture(directory / "deep.png", ImageView<const std::uint16_t>(deep.view())));
  EXPECT_EQ(read_edge_map(directory / "deep.png").error().message,
            directory / "deep.png: 16 bits a pixel; edge maps have 8 (255: strongest, 0: none)");
}

}  // namespace
}  // namespace thermedge::eval

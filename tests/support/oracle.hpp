// What the public He & Yung code, run in GNU Octave, makes of a binary edge map.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "thermedge/image.hpp"
#include "thermedge/io/source.hpp"
#include "thermedge/stages/contours.hpp"

namespace thermedge::test {

struct OracleCurve {
  bool closed = false;
  std::vector<Pixel> pixels;
  std::vector<std::uint32_t> corners;  // without end points
};

struct OracleMap {
  std::string name;
  Image<std::uint8_t> edges;
  int gap_px = 1;
  std::vector<OracleCurve> curves;
  std::vector<Pixel> corners;  // with end points
};

// All maps in `directory`, drawn shapes ("s_...") or the others, by name.
inline std::vector<std::filesystem::path> oracle_files(const std::filesystem::path& directory,
                                                       bool drawn) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    const auto& path = entry.path();
    if (path.extension() == ".json" && path.filename().string().starts_with("s_") == drawn) {
      files.push_back(path);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The files count from 1 and name the row first.
inline Pixel oracle_pixel(const nlohmann::json& pair) {
  return {pair.at(1).get<std::int32_t>() - 1, pair.at(0).get<std::int32_t>() - 1};
}

inline Image<std::uint8_t> read_edge_map(const std::filesystem::path& path) {
  const auto frame = io::read_picture(path.string());
  if (!frame) {
    throw std::runtime_error(frame.error().message);
  }
  Image<std::uint8_t> edges(frame->counts.width(), frame->counts.height());
  for (int y = 0; y < edges.height(); ++y) {
    for (int x = 0; x < edges.width(); ++x) {
      edges(x, y) = frame->counts(x, y) != 0 ? 1 : 0;
    }
  }
  return edges;
}

inline OracleMap read_oracle(const std::filesystem::path& file) {
  const auto json = nlohmann::json::parse(std::ifstream(file));
  OracleMap map;
  map.name = json.at("name");
  map.edges = read_edge_map(file.parent_path() / json.at("edge_map_file").get<std::string>());
  map.gap_px = json.at("gap");
  for (const auto& curve : json.at("curves")) {
    OracleCurve& read = map.curves.emplace_back();
    read.closed = curve.at("mode") == "loop";
    for (const auto& pair : curve.at("pts")) {
      read.pixels.push_back(oracle_pixel(pair));
    }
    for (const auto& index : curve.at("corner_idx")) {
      read.corners.push_back(index.get<std::uint32_t>() - 1);
    }
  }
  for (const auto& pair : json.at("corners")) {
    map.corners.push_back(oracle_pixel(pair));
  }
  return map;
}

}  // namespace thermedge::test

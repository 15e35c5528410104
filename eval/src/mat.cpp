// Truth in MATLAB's .mat, as the Berkeley segmentation data set has it.
#include <matio.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <string_view>
#include <system_error>

#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/eval/files.hpp"
#include "truth_maps.hpp"

namespace thermedge::eval {
namespace {

struct CloseFile {
  void operator()(mat_t* file) const { Mat_Close(file); }
};
struct FreeVariable {
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using Variable = std::unique_ptr<matvar_t, FreeVariable>;

// matio reads newer files by HDF5, which serves one caller at a time.
std::mutex& library_mutex() {
  static std::mutex mutex;
  return mutex;
}

template <class T>
Image<std::uint8_t> positive(const matvar_t& matrix) {
  const auto* values = static_cast<const T*>(matrix.data);
  const auto height = static_cast<int>(matrix.dims[0]);
  const auto width = static_cast<int>(matrix.dims[1]);
  Image<std::uint8_t> map(width, height);
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) {  // column by column
      map(x, y) = *values++ > T{0} ? 1 : 0;
    }
  }
  return map;
}

bool is_matrix(const matvar_t& variable) {
  return variable.rank == 2 && variable.class_type >= MAT_C_DOUBLE &&
         variable.class_type <= MAT_C_UINT64;
}

// A field of the first struct of an array, null where there is none. In damaged files names are
// missing, on which the library's own search would fall over.
const matvar_t* field(const matvar_t& array, std::string_view name) {
  auto* mutable_array = const_cast<matvar_t*>(&array);  // matio's readers don't say const
  const std::size_t count = Mat_VarGetNumberOfFields(mutable_array);
  char* const* names = Mat_VarGetStructFieldnames(&array);
  for (std::size_t i = 0; names != nullptr && i < count; ++i) {
    if (names[i] != nullptr && names[i] == name) {
      return Mat_VarGetStructFieldByIndex(mutable_array, i, 0);
    }
  }
  return nullptr;
}

class MatReader {
 public:
  MatReader(const std::string& path, const Limits& limits) : path_(path), limits_(limits) {}

  Result<TruthMaps> read() {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(path_, error);
    if (error) {
      return failure(ErrorCode::kIo, path_ + ": cannot be read: " + error.message());
    }
    if (bytes > limits_.max_bytes) {
      return failure(ErrorCode::kLimitExceeded, path_ + ": larger than the limit of " +
                                                    std::to_string(limits_.max_bytes) + " bytes");
    }
    const std::lock_guard lock(library_mutex());
    file_.reset(Mat_Open(path_.c_str(), MAT_ACC_RDONLY));
    if (file_ == nullptr) {
      return failure(ErrorCode::kBadData, path_ + ": no MAT file, or a damaged one");
    }
    return read_variables().and_then([&](std::vector<Image<std::uint8_t>> maps) {
      return checked_maps({std::move(maps), {}}, path_,
                          "a cell array groundTruth with Boundaries, or matrices of numbers");
    });
  }

 private:
  using Maps = std::vector<Image<std::uint8_t>>;

  // The annotators of groundTruth; without one, each matrix in the file is an annotator's.
  Result<Maps> read_variables() {
    Maps matrices;
    while (true) {
      const Variable variable(Mat_VarReadNextInfo(file_.get()));
      if (variable == nullptr || variable->name == nullptr) {
        return matrices;
      }
      const bool truth = std::string_view(variable->name) == "groundTruth";
      if (!truth && !is_matrix(*variable)) {
        continue;
      }
      if (Status status = load(*variable); !status) {
        return tl::unexpected(status.error());
      }
      if (truth) {
        return annotators(*variable);
      }
      if (Status status = add_matrix(*variable, matrices); !status) {
        return tl::unexpected(status.error());
      }
    }
  }

  Status load(matvar_t& variable) {
    std::uint64_t bytes = 0;
    if (!add_bytes(variable, 0, bytes)) {
      return failure(ErrorCode::kLimitExceeded, path_ + ": " + variable.name +
                                                    ": nested too deeply, or larger than the limit "
                                                    "of " +
                                                    std::to_string(limits_.max_bytes) + " bytes");
    }
    if (Mat_VarReadDataAll(file_.get(), &variable) != 0) {
      return failure(ErrorCode::kBadData,
                     path_ + ": damaged MAT file: " + variable.name + " cannot be read");
    }
    return {};
  }

  // Sums up what the headers claim. false: beyond the limits.
  bool add_bytes(const matvar_t& variable, int depth, std::uint64_t& bytes) const {
    constexpr int kDeepest = 8;
    std::uint64_t elements = 1;
    for (int i = 0; i < variable.rank; ++i) {
      if (variable.dims[i] > limits_.max_bytes) {
        return false;
      }
      elements *= variable.dims[i];
      if (elements > limits_.max_bytes) {
        return false;
      }
    }
    bytes += elements * static_cast<std::uint64_t>(std::max(variable.data_size, 1));
    if (bytes > limits_.max_bytes || depth > kDeepest) {
      return false;
    }
    const bool nested = variable.class_type == MAT_C_CELL || variable.class_type == MAT_C_STRUCT;
    if (!nested || variable.data == nullptr) {
      return true;
    }
    const std::uint64_t fields = variable.class_type == MAT_C_STRUCT
                                     ? Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable))
                                     : 1;
    const auto* children = static_cast<matvar_t* const*>(variable.data);
    const std::uint64_t count =
        std::min<std::uint64_t>(elements * fields, variable.nbytes / sizeof(matvar_t*));
    for (std::uint64_t i = 0; i < count; ++i) {
      if (children[i] != nullptr && !add_bytes(*children[i], depth + 1, bytes)) {
        return false;
      }
    }
    return true;
  }

  Result<Maps> annotators(matvar_t& truth) {
    Maps maps;
    const auto wrong = [&] {
      return failure(ErrorCode::kBadData,
                     path_ + ": groundTruth should be a cell array of structs with Boundaries");
    };
    if (truth.class_type != MAT_C_CELL || truth.data == nullptr) {
      return wrong();
    }
    std::size_t count = 1;
    for (int i = 0; i < truth.rank; ++i) {
      count *= truth.dims[i];
    }
    for (std::size_t i = 0; i < count; ++i) {
      matvar_t* cell = Mat_VarGetCell(&truth, static_cast<int>(i));
      if (cell == nullptr || cell->class_type != MAT_C_STRUCT || cell->data == nullptr) {
        return wrong();
      }
      const matvar_t* boundaries = field(*cell, "Boundaries");
      if (boundaries == nullptr || !is_matrix(*boundaries)) {
        return wrong();
      }
      if (Status status = add_matrix(*boundaries, maps); !status) {
        return tl::unexpected(status.error());
      }
    }
    return maps;
  }

  Status add_matrix(const matvar_t& matrix, Maps& maps) {
    const std::uint64_t height = matrix.dims[0];
    const std::uint64_t width = matrix.dims[1];
    if (Status status = check_limits(limits_, path_, width, height, 1); !status) {
      return status;
    }
    if (matrix.data == nullptr || matrix.isComplex != 0 ||
        matrix.nbytes / static_cast<std::size_t>(std::max(matrix.data_size, 1)) < width * height) {
      return failure(ErrorCode::kBadData,
                     path_ + ": damaged MAT file: a matrix without its values");
    }
    maps.push_back(map_of(matrix));
    return {};
  }

  static Image<std::uint8_t> map_of(const matvar_t& matrix) {
    switch (matrix.class_type) {
      case MAT_C_DOUBLE:
        return positive<double>(matrix);
      case MAT_C_SINGLE:
        return positive<float>(matrix);
      case MAT_C_INT8:
        return positive<std::int8_t>(matrix);
      case MAT_C_UINT8:
        return positive<std::uint8_t>(matrix);
      case MAT_C_INT16:
        return positive<std::int16_t>(matrix);
      case MAT_C_UINT16:
        return positive<std::uint16_t>(matrix);
      case MAT_C_INT32:
        return positive<std::int32_t>(matrix);
      case MAT_C_UINT32:
        return positive<std::uint32_t>(matrix);
      case MAT_C_INT64:
        return positive<std::int64_t>(matrix);
      default:
        return positive<std::uint64_t>(matrix);
    }
  }

  const std::string& path_;
  const Limits& limits_;
  std::unique_ptr<mat_t, CloseFile> file_;
};

}  // namespace

Result<TruthMaps> read_mat_truth(const std::string& path, const Limits& limits) {
  return io::catch_bad_alloc(path, [&] { return MatReader(path, limits).read(); });
}

}  // namespace thermedge::eval

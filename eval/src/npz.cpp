// Truth in NumPy's .npz: a zip archive of .npy files.
#include <zip.h>

#include <memory>
#include <optional>
#include <span>

#include "thermedge/catch_bad_alloc.hpp"
#include "thermedge/eval/files.hpp"
#include "thermedge/io/files.hpp"
#include "thermedge/io/source.hpp"
#include "truth_maps.hpp"

namespace thermedge::eval {
namespace {

using Bytes = std::vector<std::byte>;

struct CloseArchive {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};

class Archive {
 public:
  // The bytes must outlive the archive.
  static Result<Archive> open(const Bytes& bytes, const std::string& name, const Limits& limits) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    zip_t* archive = source != nullptr ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
    if (archive == nullptr && source != nullptr) {
      zip_source_free(source);
    }
    const std::string reason = archive == nullptr ? zip_error_strerror(&error) : "";
    zip_error_fini(&error);
    if (archive == nullptr) {
      return failure(ErrorCode::kBadData, name + ": no NPZ archive: " + reason);
    }
    return Archive(archive, name, limits);
  }

  // Nothing where there is no such array.
  Result<std::optional<Bytes>> read(const std::string& entry_name) const {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat(archive_.get(), entry_name.c_str(), 0, &stat) != 0) {
      return std::nullopt;
    }
    if ((stat.valid & ZIP_STAT_SIZE) == 0 || stat.size > limits_.max_bytes) {
      return failure(ErrorCode::kLimitExceeded, label(entry_name) + ": larger than the limit of " +
                                                    std::to_string(limits_.max_bytes) + " bytes");
    }
    const std::unique_ptr<zip_file_t, CloseEntry> entry(
        zip_fopen_index(archive_.get(), stat.index, 0));
    Bytes bytes(stat.size);
    // A read past the end is what checks the sum of the archive.
    std::byte behind{};
    if (entry == nullptr ||
        zip_fread(entry.get(), bytes.data(), bytes.size()) !=
            static_cast<zip_int64_t>(bytes.size()) ||
        zip_fread(entry.get(), &behind, 1) != 0) {
      return failure(ErrorCode::kBadData, label(entry_name) + ": damaged or of an unknown kind");
    }
    return bytes;
  }

  [[nodiscard]] std::string label(const std::string& entry_name) const {
    return name_ + ": " + entry_name;
  }

 private:
  Archive(zip_t* archive, const std::string& name, const Limits& limits)
      : archive_(archive), name_(name), limits_(limits) {}

  std::unique_ptr<zip_t, CloseArchive> archive_;
  const std::string& name_;
  const Limits& limits_;
};

// The pages of an array as maps; none where the archive lacks it.
Result<std::vector<Image<std::uint8_t>>> read_maps(const Archive& archive, const std::string& entry,
                                                   const Limits& limits) {
  std::vector<Image<std::uint8_t>> maps;
  const auto bytes = archive.read(entry);
  if (!bytes) {
    return tl::unexpected(bytes.error());
  }
  if (!*bytes) {
    return maps;
  }
  const std::string label = archive.label(entry);
  const auto pages = io::count_pages(**bytes, label, limits);
  if (!pages) {
    return tl::unexpected(pages.error());
  }
  io::SourceFrame frame;
  for (std::size_t page = 0; page < *pages; ++page) {
    if (Status status = io::decode_picture(**bytes, label, limits, page, frame); !status) {
      return tl::unexpected(status.error());
    }
    maps.push_back(map_above(frame.counts.view(), 0));
  }
  return maps;
}

}  // namespace

Result<TruthMaps> read_npz_truth(const std::string& path, const Limits& limits) {
  return io::catch_bad_alloc(path, [&]() -> Result<TruthMaps> {
    const auto bytes = io::read_file(path, limits);
    if (!bytes) {
      return tl::unexpected(bytes.error());
    }
    const auto archive = Archive::open(*bytes, path, limits);
    if (!archive) {
      return tl::unexpected(archive.error());
    }
    TruthMaps maps;
    for (auto [entry, list] :
         {std::pair("maps.npy", &maps.annotators), std::pair("all.npy", &maps.accepted)}) {
      auto read = read_maps(*archive, entry, limits);
      if (!read) {
        return tl::unexpected(read.error());
      }
      *list = std::move(*read);
    }
    return checked_maps(std::move(maps), path, "an array 'maps' of (annotators, height, width)");
  });
}

}  // namespace thermedge::eval

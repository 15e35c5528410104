#include "thermedge/io/source_options.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>

#include "thermedge/similar_names.hpp"

namespace thermedge::io {
namespace {

template <class E>
struct Named {
  std::string_view name;
  E value;
};

constexpr std::array kByteOrders = {Named<SampleOrder>{"format", SampleOrder::kAsFormat},
                                    Named<SampleOrder>{"little", SampleOrder::kLittle},
                                    Named<SampleOrder>{"big", SampleOrder::kBig},
                                    Named<SampleOrder>{"swapped", SampleOrder::kSwapped}};
constexpr std::array kRawFormats = {Named<RawFormat>{"gray16le", RawFormat::kGray16Le},
                                    Named<RawFormat>{"gray16be", RawFormat::kGray16Be},
                                    Named<RawFormat>{"gray8", RawFormat::kGray8},
                                    Named<RawFormat>{"grayf32le", RawFormat::kGrayF32Le},
                                    Named<RawFormat>{"grayf32be", RawFormat::kGrayF32Be}};

// An option of SourceOptions and its text.
struct Option {
  std::string_view key;
  std::string_view help;
  Status (*set)(std::string_view text, SourceOptions& options);
  std::string (*text)(const SourceOptions& options);
  bool is_number = false;
};

tl::unexpected<Error> bad_value(std::string_view right) {
  return failure(ErrorCode::kInvalidArgument, "should be " + std::string(right));
}

template <class E, std::size_t N>
Status set_named(std::string_view text, const std::array<Named<E>, N>& names, E& field) {
  std::string list;
  for (const Named<E>& known : names) {
    if (known.name == text) {
      field = known.value;
      return {};
    }
    list += (list.empty() ? "" : ", ") + std::string(known.name);
  }
  return bad_value("one of " + list);
}

template <class E, std::size_t N>
std::string name_of(E value, const std::array<Named<E>, N>& names) {
  const auto known = std::find_if(names.begin(), names.end(),
                                  [&](const Named<E>& named) { return named.value == value; });
  return std::string(known->name);
}

template <class T>
bool parse_whole(std::string_view text, T& number) {
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stop == end;
}

constexpr std::string_view kCropWords = "X,Y,WIDTH,HEIGHT in pixels, top-half, bottom-half or all";

Status set_bytes(std::string_view text, std::uint64_t& field) {
  return parse_whole(text, field) ? Status() : Status(bad_value("a number of bytes, 0 or more"));
}

Status set_size(std::string_view text, SourceOptions& options) {
  if (text.empty()) {
    options.raw_width = options.raw_height = 0;
    return {};
  }
  const std::size_t x = std::min(text.find('x'), text.size());
  const bool is_size = x < text.size() && parse_whole(text.substr(0, x), options.raw_width) &&
                       parse_whole(text.substr(x + 1), options.raw_height) &&
                       options.raw_width > 0 && options.raw_height > 0;
  return is_size ? Status() : Status(bad_value("WIDTHxHEIGHT, e.g. 382x288"));
}

std::string size_text(const SourceOptions& options) {
  return options.raw_width > 0
             ? std::to_string(options.raw_width) + "x" + std::to_string(options.raw_height)
             : "";
}

const std::array kOptions = {
    Option{"crop", "part of each frame: all, top-half, bottom-half or X,Y,WIDTH,HEIGHT, px",
           [](std::string_view text, SourceOptions& options) {
             const auto crop = parse_crop(text);
             options.crop = crop.value_or(options.crop);
             return crop ? Status() : Status(bad_value(kCropWords));
           },
           [](const SourceOptions& options) { return crop_text(options.crop); }},
    Option{"byte_order",
           "of samples in files: format (as it says), little, big, or swapped (the other one)",
           [](std::string_view text, SourceOptions& options) {
             return set_named(text, kByteOrders, options.byte_order);
           },
           [](const SourceOptions& options) { return name_of(options.byte_order, kByteOrders); }},
    Option{"raw_size", "of frames without a header, WIDTHxHEIGHT; empty: not given",
           [](std::string_view text, SourceOptions& options) { return set_size(text, options); },
           [](const SourceOptions& options) { return size_text(options); }},
    Option{"raw_format", "their pixels: gray16le, gray16be, gray8, grayf32le or grayf32be",
           [](std::string_view text, SourceOptions& options) {
             return set_named(text, kRawFormats, options.raw_format);
           },
           [](const SourceOptions& options) { return name_of(options.raw_format, kRawFormats); }},
    Option{"raw_header_bytes", "passed over at the beginning of a raw file or stream",
           [](std::string_view text, SourceOptions& options) {
             return set_bytes(text, options.raw_header_bytes);
           },
           [](const SourceOptions& options) { return std::to_string(options.raw_header_bytes); },
           true},
    Option{
        "raw_frame_header_bytes", "passed over in front of each raw frame",
        [](std::string_view text, SourceOptions& options) {
          return set_bytes(text, options.raw_frame_header_bytes);
        },
        [](const SourceOptions& options) { return std::to_string(options.raw_frame_header_bytes); },
        true}};

}  // namespace

Status set_source_option(std::string_view key, std::string_view text, SourceOptions& options) {
  for (const Option& option : kOptions) {
    if (option.key == key) {
      SourceOptions changed = options;
      return option.set(text, changed).map([&] { options = changed; });
    }
  }
  const std::vector<std::string> names = source_option_names();
  const std::string meant = did_you_mean(key, names);
  std::string list;
  for (const std::string& name : names) {
    list += (list.empty() ? "; there are source." : ", source.") + name;
  }
  return failure(ErrorCode::kInvalidArgument, "unknown option" + (meant.empty() ? list : meant),
                 "source." + std::string(key));
}

std::vector<std::string> source_option_names() {
  std::vector<std::string> names;
  names.reserve(std::size(kOptions));
  for (const Option& option : kOptions) {
    names.emplace_back(option.key);
  }
  return names;
}

std::string dump_source_options(const SourceOptions& options) {
  std::string toml = "\n[source]\n";
  for (const Option& option : kOptions) {
    const std::string text = option.text(options);
    toml += std::string(option.key) + " = " + (option.is_number ? text : '"' + text + '"') +
            "  # " + std::string(option.help) + "\n";
  }
  return toml;
}

}  // namespace thermedge::io

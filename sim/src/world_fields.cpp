#include "world_fields.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "number_text.hpp"

namespace thermedge::sim {
namespace {

constexpr Range kPlace{-1e5, 1e5};
constexpr Range kExtent{1e-4, 1e5};
constexpr Range kTemperature{-272, 1100};

// Whole numbers count as numbers.
std::optional<double> number_of(const toml::node& node) {
  return node.is_number() ? node.value<double>() : std::nullopt;
}

}  // namespace

void Fields::fault(const std::string& what) {
  if (status_) {
    status_ = failure(ErrorCode::kBadData, where_ + (where_.empty() ? "" : ": ") + what);
  }
}

const toml::node* Fields::take(std::string_view key, bool must) {
  known_.push_back(key);
  const toml::node* node = table_.get(key);
  if (node == nullptr && must) {
    fault("needs " + std::string(key));
  }
  return node;
}

bool Fields::number(std::string_view key, double& value, Range range, bool must) {
  const toml::node* node = take(key, must);
  if (node == nullptr) {
    return false;
  }
  const auto read = number_of(*node);
  if (!read) {
    fault(std::string(key) + " should be a number");
  } else if (!(*read >= range.min && *read <= range.max)) {
    fault(std::string(key) + " = " + number_text(*read) + " should be from " +
          number_text(range.min) + " to " + number_text(range.max) +
          (range.min == kTemperature.min ? " (0 K is -273.15 degC)" : ""));
  } else {
    value = *read;
    return true;
  }
  return false;
}

bool Fields::numbers(std::string_view key, double* values, std::size_t count, Range range,
                     bool must) {
  const toml::node* node = take(key, must);
  if (node == nullptr) {
    return false;
  }
  const toml::array* array = node->as_array();
  const std::string wanted = std::string(key) + " should be " + std::to_string(count) +
                             " numbers from " + number_text(range.min) + " to " +
                             number_text(range.max);
  if (array == nullptr || array->size() != count) {
    fault(wanted);
    return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = number_of((*array)[i]);
    if (!value || !(*value >= range.min && *value <= range.max)) {
      fault(wanted);
      return false;
    }
    values[i] = *value;
  }
  return true;
}

bool Fields::vector(std::string_view key, Vec3& value, bool must) {
  double v[3];
  if (!numbers(key, v, 3, kPlace, must)) {
    return false;
  }
  value = {v[0], v[1], v[2]};
  return true;
}

bool Fields::vectors(std::string_view key, std::vector<Vec3>& values) {
  const toml::node* node = take(key, false);
  if (node == nullptr) {
    return false;
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty()) {
    fault(std::string(key) + " should be a list of points [x, y, z], and not empty");
    return false;
  }
  for (const toml::node& point : *array) {
    toml::table one;
    one.insert("point", point);
    Fields fields(one, where_ + (where_.empty() ? "" : ": ") + std::string(key), status_);
    fields.vector("point", values.emplace_back());
  }
  return true;
}

bool Fields::size(std::string_view key, Vec3& value) {
  double v[3];
  if (!numbers(key, v, 3, kExtent, true)) {
    return false;
  }
  value = {v[0], v[1], v[2]};
  return true;
}

bool Fields::size(std::string_view key, double& width, double& height) {
  double v[2];
  if (!numbers(key, v, 2, kExtent, true)) {
    return false;
  }
  width = v[0];
  height = v[1];
  return true;
}

bool Fields::pair(std::string_view key, double& x, double& y) {
  double v[2];
  if (!numbers(key, v, 2, kPlace, false)) {
    return false;
  }
  x = v[0];
  y = v[1];
  return true;
}

bool Fields::flag(std::string_view key, bool& value) {
  const toml::node* node = take(key, false);
  if (node != nullptr && !node->is_boolean()) {
    fault(std::string(key) + " should be true or false");
  }
  value = node != nullptr ? node->value_or(value) : value;
  return node != nullptr;
}

bool Fields::text(std::string_view key, std::string& value, bool must) {
  const toml::node* node = take(key, must);
  if (node != nullptr && !node->is_string()) {
    fault(std::string(key) + " should be a text");
    return false;
  }
  value = node != nullptr ? node->value_or(value) : value;
  return node != nullptr;
}

const toml::table* Fields::table(std::string_view key) {
  const toml::node* node = take(key, false);
  if (node != nullptr && !node->is_table()) {
    fault(std::string(key) + " should be a table");
  }
  return node != nullptr ? node->as_table() : nullptr;
}

std::vector<const toml::table*> Fields::tables(std::string_view key) {
  const toml::node* node = take(key, false);
  std::vector<const toml::table*> tables;
  const toml::array* array = node != nullptr ? node->as_array() : nullptr;
  const bool good =
      array != nullptr &&
      std::all_of(array->begin(), array->end(), [](const toml::node& n) { return n.is_table(); });
  if (node != nullptr && !good) {
    fault(std::string(key) + " should be written as [[" + std::string(key) + "]]");
  } else if (good) {
    for (const toml::node& one : *array) {
      tables.push_back(one.as_table());
    }
  }
  return tables;
}

void Fields::surface(Surface& surface) {
  number("temperature_degc", surface.temperature_degc, kTemperature);
  number("emissivity", surface.emissivity, {0, 1});
  vector("gradient_degc_per_m", surface.gradient_degc_per_m);
  number("value_noise_degc", surface.value_noise_degc, {0, 50});
  number("value_noise_m", surface.value_noise_m, {0.01, 1000});
}

void Fields::finish() {
  for (const auto& [key, node] : table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) == known_.end()) {
      std::string list;
      for (const std::string_view known : known_) {
        list += (list.empty() ? "" : ", ") + std::string(known);
      }
      fault("unknown key '" + std::string(key.str()) + "'; known are " + list);
    }
  }
}

}  // namespace thermedge::sim

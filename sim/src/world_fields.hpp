// Reads the fields of a TOML table, each with its type and range, and remembers the first fault.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "thermedge/result.hpp"
#include "thermedge/sim/world.hpp"

namespace thermedge::sim {

struct Range {
  double min, max;
};

class Fields {
 public:
  // `where` names the table in messages, e.g. "object 'mug'".
  Fields(const toml::table& table, std::string where, Status& status)
      : table_(table), where_(std::move(where)), status_(status) {}

  // Each sets `value` where the key is there; a key that `must` be and isn't is a fault.
  bool number(std::string_view key, double& value, Range range, bool must = false);
  bool vector(std::string_view key, Vec3& value, bool must = false);
  bool vectors(std::string_view key, std::vector<Vec3>& values);
  // Extents along two or three axes, all above 0.
  bool size(std::string_view key, Vec3& value);
  bool size(std::string_view key, double& width, double& height);
  bool pair(std::string_view key, double& x, double& y);
  bool flag(std::string_view key, bool& value);
  bool text(std::string_view key, std::string& value, bool must = false);
  const toml::table* table(std::string_view key);
  // The tables of an array of tables; empty where there is none.
  std::vector<const toml::table*> tables(std::string_view key);

  // Surface fields, over those that `surface` has.
  void surface(Surface& surface);

  void fault(const std::string& what);
  // Faults the keys that nobody asked for.
  void finish();
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  const toml::node* take(std::string_view key, bool must);
  bool numbers(std::string_view key, double* values, std::size_t count, Range range, bool must);

  const toml::table& table_;
  std::string where_;
  Status& status_;
  std::vector<std::string_view> known_;
};

}  // namespace thermedge::sim

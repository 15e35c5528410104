#include "assignment.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace thermedge::eval {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int32_t kNone = -1;

std::size_t at(std::int32_t index) { return static_cast<std::size_t>(index); }

// Costs are gains with the opposite sign; a row may also stay alone at cost 0.
class Assigner {
 public:
  Assigner(const std::vector<PossiblePair>& pairs, std::size_t rows, std::size_t columns)
      : pairs_(pairs),
        begins_(rows + 1, 0),
        column_of_(rows, kNone),
        row_of_(columns, kNone),
        row_dual_(rows, 0),
        column_dual_(columns, 0),
        distance_(columns, kInfinity),
        from_(columns, kNone),
        done_(columns, 0) {
    for (const PossiblePair& pair : pairs) {
      ++begins_[at(pair.row) + 1];
    }
    for (std::size_t row = 0; row < rows; ++row) {
      begins_[row + 1] += begins_[row];
    }
  }

  std::vector<std::int32_t> run() {
    for (std::size_t row = 0; row < column_of_.size(); ++row) {
      insert(static_cast<std::int32_t>(row));
    }
    return std::move(column_of_);
  }

 private:
  // The cheapest way to give `row` a column, where others may have to change theirs.
  void insert(std::int32_t row) {
    alone_ = {kInfinity, kNone};
    touched_.clear();
    finished_.clear();
    queue_ = {};
    scan(row, 0);
    std::int32_t free_column = kNone;
    double total = alone_.first;
    while (!queue_.empty() && queue_.top().first < alone_.first) {
      const auto [distance, column] = queue_.top();
      queue_.pop();
      if (done_[at(column)] != 0 || distance > distance_[at(column)]) {
        continue;
      }
      if (row_of_[at(column)] == kNone) {
        free_column = column;
        total = distance;
        break;
      }
      done_[at(column)] = 1;
      finished_.push_back(column);
      scan(row_of_[at(column)], distance);
      total = alone_.first;
    }
    update_duals(row, total);
    augment(row, free_column);
    for (const std::int32_t column : touched_) {
      distance_[at(column)] = kInfinity;
      done_[at(column)] = 0;
    }
  }

  void scan(std::int32_t row, double distance) {
    const double base = distance - row_dual_[at(row)];
    alone_ = std::min(alone_, {base, row});
    for (std::size_t i = begins_[at(row)]; i < begins_[at(row) + 1]; ++i) {
      const std::int32_t column = pairs_[i].column;
      const double way = base - pairs_[i].gain - column_dual_[at(column)];
      if (done_[at(column)] == 0 && way < distance_[at(column)]) {
        if (distance_[at(column)] == kInfinity) {
          touched_.push_back(column);
        }
        distance_[at(column)] = way;
        from_[at(column)] = row;
        queue_.emplace(way, column);
      }
    }
  }

  void update_duals(std::int32_t row, double total) {
    row_dual_[at(row)] += total;
    for (const std::int32_t column : finished_) {
      const double change = total - distance_[at(column)];
      row_dual_[at(row_of_[at(column)])] += change;
      column_dual_[at(column)] -= change;
    }
  }

  // Along the way back; it ends at a free column or at a row that stays alone.
  void augment(std::int32_t row, std::int32_t free_column) {
    std::int32_t column = free_column;
    if (column == kNone) {
      const std::int32_t alone = alone_.second;
      column = column_of_[at(alone)];
      column_of_[at(alone)] = kNone;
      if (alone == row) {
        return;
      }
    }
    for (;;) {
      const std::int32_t to = from_[at(column)];
      const std::int32_t next = column_of_[at(to)];
      row_of_[at(column)] = to;
      column_of_[at(to)] = column;
      if (to == row) {
        return;
      }
      column = next;
    }
  }

  using Entry = std::pair<double, std::int32_t>;
  const std::vector<PossiblePair>& pairs_;
  std::vector<std::size_t> begins_;
  std::vector<std::int32_t> column_of_, row_of_;
  std::vector<double> row_dual_, column_dual_;
  std::vector<double> distance_;
  std::vector<std::int32_t> from_;  // row from which a column is reached
  std::vector<std::uint8_t> done_;
  std::vector<std::int32_t> touched_, finished_;
  std::pair<double, std::int32_t> alone_{kInfinity, kNone};  // cheapest row to leave alone
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

std::vector<std::int32_t> best_assignment(const std::vector<PossiblePair>& pairs, std::size_t rows,
                                          std::size_t columns) {
  return Assigner(pairs, rows, columns).run();
}

}  // namespace thermedge::eval

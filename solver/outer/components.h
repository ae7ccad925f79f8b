// Components: columns that rows connect with each other. A column of infinite mass connects nothing; what is
// connected with one, or with a place (rows of one node), is held from outside.
#pragma once

#include <vector>

#include "rows/rows.h"

namespace pbd {

struct Components {
  std::vector<int> of_column;  // -1 for those of infinite mass
  std::vector<bool> held;      // of each component: from outside

  void find(const Rows& rows, const std::vector<double>& inverse_mass);
  std::size_t count() const { return held.size(); }

  /// The component of a constraint with these columns; -1 if none of them can move.
  template <class Nodes>
  int of(const Nodes& columns) const {
    for (const int column : columns)
      if (of_column[column] >= 0) return of_column[column];
    return -1;
  }

 private:
  std::vector<int> parent_;  // of each column: another one of its component, or itself
};

}  // namespace pbd

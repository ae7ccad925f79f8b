#include "studies/robustness/contact_cases.h"

#include <iterator>

namespace pbdcheck {

std::vector<ContactCase> contact_cases(bool full) {
  auto all = cases_at_rest(full);
  auto moving = moving_cases(full);
  std::move(moving.begin(), moving.end(), std::back_inserter(all));
  return all;
}

}  // namespace pbdcheck

// Contacts that are near enough to be told where a step begins, and have no rows: their shapes are apart
// where the step begins and where its free motion ends. They wait until an iterate that solves the step
// brings the shapes together, surfaces by features that are near, so that what flies by at speed costs one
// test a solution.
#pragma once

#include <set>
#include <span>
#include <tuple>

#include "effects/contact_search.h"

namespace pbd {

class WaitingContacts {
 public:
  /// Where a step begins.
  void clear();

  /// Takes from `contacts` those that are apart at each of `places`, and have not been called: they wait.
  void take(std::span<const Configuration> places, ContactLists& contacts);

  /// Takes of `all` contacts what has no rows in `contacts`.
  void renew(const ContactLists& all, const ContactLists& contacts);

  /// True if some have come together at `end`: they wait no more in this step.
  bool call(const Configuration& end);

 private:
  using Name = std::tuple<bool, std::array<int, 2>, std::uint64_t>;  // of surfaces; pair and features
  static Name name_of(const ActiveContact& contact) {
    return {contact.of_surfaces, contact.pair(), contact.features.key};
  }

  std::vector<ActiveContact> waiting_;
  std::set<Name> called_;
};

}  // namespace pbd

#include "effects/waiting_contacts.h"

#include <algorithm>

namespace pbd {

void WaitingContacts::clear() {
  waiting_.clear();
  called_.clear();
}

void WaitingContacts::take(std::span<const Configuration> places, ContactLists& contacts) {
  waiting_.clear();
  const auto waits = [&](const ActiveContact& contact) {
    if (std::isinf(contact.apart) || called_.contains(name_of(contact))) return false;
    return std::all_of(places.begin(), places.end(),
                       [&](const Configuration& at) { return gap_at(contact, at) > contact.apart; });
  };
  for (auto& list : contacts) {
    const auto first = std::stable_partition(list.begin(), list.end(), std::not_fn(waits));
    waiting_.insert(waiting_.end(), first, list.end());
    list.erase(first, list.end());
  }
}

void WaitingContacts::renew(const ContactLists& all, const ContactLists& contacts) {
  std::vector<Name> rows;
  for (const auto& list : contacts)
    for (const ActiveContact& contact : list) rows.push_back(name_of(contact));
  std::sort(rows.begin(), rows.end());
  waiting_.clear();
  for (const auto& list : all)
    for (const ActiveContact& contact : list)
      if (!std::binary_search(rows.begin(), rows.end(), name_of(contact))) waiting_.push_back(contact);
}

bool WaitingContacts::call(const Configuration& end) {
  const std::size_t before = called_.size();
  for (const ActiveContact& contact : waiting_)
    if (std::isinf(contact.apart) || gap_at(contact, end) < 0) called_.insert(name_of(contact));
  return called_.size() > before;
}

}  // namespace pbd

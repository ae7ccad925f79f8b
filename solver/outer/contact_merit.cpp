#include "outer/contact_merit.h"

#include <algorithm>

#include "outer/dual_contacts.h"
#include "rows/laws.h"

namespace pbd {
namespace {

/// max over p from 0 to most of -p u - 1/2 sigma p^2.
double penalty(double u, double sigma, double most) {
  if (u >= 0) return 0;  // what is not a number goes on
  const double p = sigma > 0 ? std::min(-u / sigma, most) : most;
  return -p * u - sigma * p * p / 2;
}

template <class Block>
bool in_cone(const Block& block) {
  return block.frictional() && block.law == Friction::cone;
}

}  // namespace

void ContactMerit::find_sliding(const Rows& rows, const std::vector<bool>& eliminated, const Points& v,
                                Sliding& sliding) {
  sliding.clear();
  each_contact(rows, eliminated, [&]<class Block>(const Block& block, std::size_t i) {
    sliding.push_back(0);
    if constexpr (Block::rows == 3) {
      if (!block.frictional()) return;
      const Eigen::Vector3d u = block.residual(v, i, Eigen::Vector3d::Zero());
      const double speed =
          block.law == Friction::box ? std::abs(u[1]) + std::abs(u[2]) : length_of(u[1], u[2]);
      sliding.back() = block.friction[i] * speed;
    }
  });
}

double ContactMerit::of_contacts(const Rows& rows, const std::vector<bool>& eliminated, const Points& v,
                                 const Sliding& sliding, double share) const {
  double sum = 0;
  std::size_t k = 0;
  each_contact(rows, eliminated, [&]<class Block>(const Block& block, std::size_t i) {
    const double normal = block.residual(v, i, Block::Value::Zero())[0];
    const double slides = sliding_[k] + share * (sliding[k] - sliding_[k]);
    const bool cone = in_cone(block);
    sum += penalty(cone ? normal - slides : normal, block.compliance[i](0, 0), most_);
    if (!cone) sum += normal_[k] * slides;
    ++k;
  });
  return sum;
}

void ContactMerit::begin(const Rows& rows, const std::vector<bool>& eliminated, double potential,
                         const Points& v) {
  normal_.clear();
  most_ = 0;
  each_contact(rows, eliminated, [&](const auto& block, std::size_t i) {
    normal_.push_back(block.impulse[i][0]);
    most_ = std::max(most_, 2 * std::abs(normal_.back()));
  });
  find_sliding(rows, eliminated, v, sliding_);
  begins_at_ = potential + of_contacts(rows, eliminated, v, sliding_, 0);
}

bool ContactMerit::leaps(const Rows& rows, const std::vector<bool>& eliminated, double potential,
                         const Points& v, const Sliding& sliding, double share) const {
  constexpr double most = 2;
  return !(potential + of_contacts(rows, eliminated, v, sliding, share) <= most * begins_at_);
}

}  // namespace pbd

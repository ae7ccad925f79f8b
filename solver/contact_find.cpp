// Which contacts a step has.
#include <algorithm>
#include <cmath>

#include "contact/generate.h"
#include "contact_group.h"
#include "contact_rows.h"

namespace pbd {

void ContactRows::keep_impulses(const Rows& rows) {
  seeds_.clear();
  for (std::size_t index = first_block_; index < rows.blocks.size(); ++index)
    with_contacts(rows, index, first_block_, contacts_, [&](const auto& block, const auto& contacts) {
      for (std::size_t i = 0; i < block.size(); ++i) {
        if (!(block.impulse[i][0] > 0)) continue;
        const auto directions = directions_in<std::decay_t<decltype(block)>>(contacts[i], block.jacobian[i]);
        seeds_.push_back(
            {contacts[i].collider, contacts[i].features.key, directions.transpose() * block.impulse[i]});
      }
    });
  std::sort(seeds_.begin(), seeds_.end(), [](const Seed& a, const Seed& b) { return a.name() < b.name(); });
}

void ContactRows::add_surfaces(const Contact& effect, const Points& x) {
  const auto material = static_cast<std::size_t>(effect.surface_material);
  const ContactLaw& law = effect.law[material * static_cast<std::size_t>(effect.materials) + material];
  surface_contacts_.clear();
  surfaces_->find(x, reach_, effect.thickness, surface_contacts_);
  for (const SurfaceContact& found : surface_contacts_) {
    ActiveContact contact;
    contact.of_surfaces = true;
    contact.carrier = {-1, -1};
    contact.features.point_a = contact.features.point_b = Vec3::Zero();
    contact.surface = found;
    contact.law = law;
    contact.collider = {found.node[0], found.edges ? found.node[2] : found.node[1]};
    const auto rest = static_cast<std::uint64_t>(found.edges ? found.node[3] : found.node[2]);
    contact.features.key = 2 * (rest + static_cast<std::uint64_t>(x.cols()) *
                                           static_cast<std::uint64_t>(found.node[found.edges ? 1 : 3])) +
                           (found.edges ? 1 : 0);
    contacts_[law.friction > 0 ? surfaces_rough : surfaces_smooth].push_back(contact);
  }
}

double ContactRows::displacement(const Motion& motion, const Bodies& bodies, const Configuration& start,
                                 const Points& to) const {
  const auto shift = [&](Eigen::Index column) -> Vec3 { return to.col(column) - start.x.col(column); };
  if (motion.is_node) return shift(motion.carrier).norm();
  const Pose& pose = start.pose[static_cast<std::size_t>(motion.carrier)];
  const double turn = (pose.turning * shift(bodies.column(motion.carrier))).norm();
  return shift(bodies.node(motion.carrier)).norm() + motion.radius * turn;
}

void ContactRows::place_colliders(const Contact& effect, const Bodies& bodies, const Configuration& start,
                                  const std::vector<double>& inverse_mass) {
  motions_.resize(effect.collider.size() + effect.node.size());
  const auto moves = [&](Eigen::Index column) { return inverse_mass[static_cast<std::size_t>(column)] > 0; };
  for (std::size_t k = 0; k < effect.collider.size(); ++k) {
    const Collider& collider = effect.collider[k];
    const Pose& pose = start.pose[static_cast<std::size_t>(collider.body)];
    Motion& motion = motions_[k];
    motion.shape = &collider.shape;
    motion.frame = {pose.x + pose.rotation * collider.frame.origin, pose.rotation * collider.frame.rotation};
    motion.carrier = collider.body;
    motion.moves = moves(bodies.node(collider.body)) || moves(bodies.column(collider.body));
    const double radius = collider.frame.origin.norm() + bounding_radius(collider.shape);
    motion.radius = std::isfinite(radius) ? radius : 0.0;
  }
  for (std::size_t k = 0; k < effect.node.size(); ++k) {
    Motion& motion = motions_[effect.collider.size() + k];
    motion.node_shape = Sphere{effect.radius[k]};
    motion.shape = &motion.node_shape;
    motion.frame = {start.x.col(effect.node[k]), Eigen::Matrix3d::Identity()};
    motion.carrier = effect.node[k];
    motion.is_node = true;
    motion.moves = moves(effect.node[k]);
  }
}

void ContactRows::add_pair(const Contact& effect, int first, int second) {
  const Motion &one = motions_[static_cast<std::size_t>(first)],
               &two = motions_[static_cast<std::size_t>(second)];
  if (!one.is_node && !two.is_node) {
    const std::array<int, 2> bodies{std::min(one.carrier, two.carrier), std::max(one.carrier, two.carrier)};
    if (std::binary_search(ignored_.begin(), ignored_.end(), bodies)) return;
  }
  found_.clear();
  generate(*one.shape, one.frame, *two.shape, two.frame, effect.margin + one.reach + two.reach, found_);
  const auto local = [&](int collider) {
    return motions_[static_cast<std::size_t>(collider)].is_node
               ? Frame{}
               : effect.collider[static_cast<std::size_t>(collider)].frame;
  };
  const ContactLaw& law = effect.between(first, second);
  for (const ContactPoint& point : found_) {
    const std::array<int, 2> sides = point.swapped ? std::array{second, first} : std::array{first, second};
    ActiveContact contact;
    contact.features = placed(point, local(sides[0]), local(sides[1]));
    contact.collider = sides;
    for (const int side : {0, 1}) {
      const Motion& own = motions_[static_cast<std::size_t>(sides[static_cast<std::size_t>(side)])];
      contact.carrier[static_cast<std::size_t>(side)] = own.carrier;
      if (own.is_node) contact.node_side = side;
    }
    contact.law = law;
    const std::size_t group =
        (contact.node_side < 0 ? bodies_rough : nodes_rough) + (law.friction > 0 ? 0 : 1);
    contacts_[group].push_back(contact);
  }
}

void ContactRows::find(const Scene& scene, const Bodies& bodies, const Configuration& start,
                       const Points& start_v, const StepMap& map, bool warm_start,
                       const std::vector<double>& inverse_mass, Rows& rows) {
  const auto& effect = std::get<Contact>(scene.effects[static_cast<std::size_t>(effect_)]);
  start_v_ = start_v;
  relaxed_ = false;
  place_colliders(effect, bodies, start, inverse_mass);
  const Points free = map.x0 + map.d * map.v_free;
  for (Motion& motion : motions_) motion.reach = displacement(motion, bodies, start, free);
  if (surfaces_) {
    reach_.assign(static_cast<std::size_t>(scene.nodes()), 0.0);
    for (const int node : surfaces_->nodes())
      reach_[static_cast<std::size_t>(node)] = (free.col(node) - start.x.col(node)).norm();
  }
  keep_impulses(rows);
  if (!warm_start) seeds_.clear();
  fill(effect, bodies, start, map, rows);
}

bool ContactRows::widen(const Scene& scene, const Bodies& bodies, const Configuration& start, const Points& x,
                        const StepMap& map, Rows& rows) {
  bool farther = false;
  const auto extend = [&](double& reach, double reached) {
    constexpr double rounding = 1e-9, room = 2;
    if (!(reached > (1 + rounding) * reach)) return;
    reach = room * reached;
    farther = true;
  };
  for (Motion& motion : motions_) extend(motion.reach, displacement(motion, bodies, start, x));
  if (surfaces_)
    for (const int node : surfaces_->nodes())
      extend(reach_[static_cast<std::size_t>(node)], (x.col(node) - start.x.col(node)).norm());
  if (!farther) return false;
  keep_impulses(rows);
  fill(std::get<Contact>(scene.effects[static_cast<std::size_t>(effect_)]), bodies, start, map, rows);
  return true;
}

/// What a contact asks for in this step, and the impulse it begins with.
template <class Block>
void ContactRows::begin_contact(const Begin& begin, ActiveContact& contact, Block& block,
                                std::size_t i) const {
  auto& jacobian = block.jacobian[i];
  contact.reference = reference_for(evaluate<Block>(contact, begin.at, jacobian).normal);
  const double gap = evaluate<Block>(contact, begin.at, jacobian).gap;
  contact.target = std::min(0.0, gap + begin.effect.recovery * begin.map.h);

  const double closing = (jacobian * block.gather(start_v_, i))[0];
  const double ahead = gap + (jacobian * block.gather(begin.free_shift, i))[0];
  contact.closing = closing < 0;
  contact.restitution = closing < 0 && ahead < 0 ? contact.law.restitution : 0.0;
  const double share = 1 / (1 + contact.law.damping / begin.map.d);
  contact.compliance = share * contact.law.compliance;
  contact.offset = (1 - share) * (gap - contact.target + (jacobian * block.gather(begin.own_shift, i))[0]);

  const Seed wanted{contact.collider, contact.features.key, {}};
  const auto seed = std::lower_bound(seeds_.begin(), seeds_.end(), wanted,
                                     [](const Seed& x, const Seed& y) { return x.name() < y.name(); });
  if (seed == seeds_.end() || seed->name() != wanted.name()) return;
  block.impulse[i] = directions_in<Block>(contact, jacobian) * seed->impulse;
  block.impulse[i] += block.allowed(i, block.impulse[i], Block::Value::Zero());
}

void ContactRows::fill(const Contact& effect, const Bodies& bodies, const Configuration& start,
                       const StepMap& map, Rows& rows) {
  for (auto& contacts : contacts_) contacts.clear();
  boxes_.clear();
  for (const Motion& motion : motions_) {
    const Eigen::AlignedBox3d box = bounds_of(*motion.shape, motion.frame);
    const Vec3 slack = Vec3::Constant(motion.reach + effect.margin);
    const int group = motion.is_node ? -1 : motion.carrier;  // nodes touch no nodes, bodies not themselves
    boxes_.push_back({{box.min() - slack, box.max() + slack}, motion.moves, group});
  }
  for (const auto& [first, second] : broad_phase_.pairs(boxes_)) add_pair(effect, first, second);
  if (surfaces_) add_surfaces(effect, start.x);

  const Begin begin{effect, start, map, map.x0 + map.d * map.v_free - start.x, map.x0 - start.x};
  for (std::size_t index = first_block_; index < rows.blocks.size(); ++index)
    with_contacts(rows, index, first_block_, contacts_, [&]<class Block>(Block& block, auto& contacts) {
      std::vector<typename Block::Shape::Nodes> before;
      before.swap(block.node);
      block.resize_contacts(contacts.size());
      for (std::size_t i = 0; i < block.size(); ++i) {
        block.node[i] = columns_of_contact<Block>(contacts[i], bodies);
        if (block.frictional()) block.friction[i] = contacts[i].law.friction;
        begin_contact(begin, contacts[i], block, i);
      }
      if (block.node != before) ++rows.generation;
    });
}

}  // namespace pbd

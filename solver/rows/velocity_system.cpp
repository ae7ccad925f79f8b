#include "rows/velocity_system.h"

namespace pbd {

template <class Block>
void VelocitySystem::add(const Block& block, std::size_t i, const typename Block::Square& stiffness) {
  const Eigen::Matrix<double, 3 * Block::nodes, 3 * Block::nodes> full =
      block.jacobian[i].transpose() * stiffness * block.jacobian[i];
  each_node(block, i, [&](int row, int a) {
    each_node(block, i, [&](int col, int b) {
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l) entries.emplace_back(row + k, col + l, full(3 * a + k, 3 * b + l));
    });
  });
}

template <class Block>
void VelocitySystem::push(const Block& block, std::size_t i, const typename Block::Value& p,
                          Eigen::VectorXd& to) const {
  const typename Block::Velocities push = block.jacobian[i].transpose() * p;
  each_node(block, i, [&](int first, int a) { to.segment<3>(first) += push.template segment<3>(3 * a); });
}

template <class Block>
typename Block::Value VelocitySystem::along(const Block& block, std::size_t i,
                                            const Eigen::VectorXd& solution) const {
  typename Block::Velocities local = Block::Velocities::Zero();
  each_node(block, i,
            [&](int first, int a) { local.template segment<3>(3 * a) = solution.segment<3>(first); });
  return block.jacobian[i] * local;
}

template void VelocitySystem::add(const RowBlock<3, 1>&, std::size_t, const RowBlock<3, 1>::Square&);
template void VelocitySystem::push(const RowBlock<3, 1>&, std::size_t, const RowBlock<3, 1>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<3, 1>::Value VelocitySystem::along(const RowBlock<3, 1>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<1, 2>&, std::size_t, const RowBlock<1, 2>::Square&);
template void VelocitySystem::push(const RowBlock<1, 2>&, std::size_t, const RowBlock<1, 2>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<1, 2>::Value VelocitySystem::along(const RowBlock<1, 2>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<1, 4>&, std::size_t, const RowBlock<1, 4>::Square&);
template void VelocitySystem::push(const RowBlock<1, 4>&, std::size_t, const RowBlock<1, 4>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<1, 4>::Value VelocitySystem::along(const RowBlock<1, 4>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<3, 3>&, std::size_t, const RowBlock<3, 3>::Square&);
template void VelocitySystem::push(const RowBlock<3, 3>&, std::size_t, const RowBlock<3, 3>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<3, 3>::Value VelocitySystem::along(const RowBlock<3, 3>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<6, 4>&, std::size_t, const RowBlock<6, 4>::Square&);
template void VelocitySystem::push(const RowBlock<6, 4>&, std::size_t, const RowBlock<6, 4>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<6, 4>::Value VelocitySystem::along(const RowBlock<6, 4>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<2, 4>&, std::size_t, const RowBlock<2, 4>::Square&);
template void VelocitySystem::push(const RowBlock<2, 4>&, std::size_t, const RowBlock<2, 4>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<2, 4>::Value VelocitySystem::along(const RowBlock<2, 4>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<3, 4>&, std::size_t, const RowBlock<3, 4>::Square&);
template void VelocitySystem::push(const RowBlock<3, 4>&, std::size_t, const RowBlock<3, 4>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<3, 4>::Value VelocitySystem::along(const RowBlock<3, 4>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<1, 3>&, std::size_t, const RowBlock<1, 3>::Square&);
template void VelocitySystem::push(const RowBlock<1, 3>&, std::size_t, const RowBlock<1, 3>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<1, 3>::Value VelocitySystem::along(const RowBlock<1, 3>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<3, 5>&, std::size_t, const RowBlock<3, 5>::Square&);
template void VelocitySystem::push(const RowBlock<3, 5>&, std::size_t, const RowBlock<3, 5>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<3, 5>::Value VelocitySystem::along(const RowBlock<3, 5>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const RowBlock<1, 5>&, std::size_t, const RowBlock<1, 5>::Square&);
template void VelocitySystem::push(const RowBlock<1, 5>&, std::size_t, const RowBlock<1, 5>::Value&,
                                   Eigen::VectorXd&) const;
template RowBlock<1, 5>::Value VelocitySystem::along(const RowBlock<1, 5>&, std::size_t,
                                                     const Eigen::VectorXd&) const;
template void VelocitySystem::add(const LocalContacts&, std::size_t, const LocalContacts::Square&);
template void VelocitySystem::push(const LocalContacts&, std::size_t, const LocalContacts::Value&,
                                   Eigen::VectorXd&) const;
template LocalContacts::Value VelocitySystem::along(const LocalContacts&, std::size_t,
                                                    const Eigen::VectorXd&) const;

}  // namespace pbd

// What does the list of effects cost a scene that uses one of them? A sweep of Gauss-Seidel by the solver
// over links, ball joints, or contacts of bodies, beside the least loop that does the same: it knows these
// rows alone and how their gradients are made, sums no residual, and cannot know bounds, other laws of
// friction, or rows of other sizes. The law of one contact is the solver's own in both.
#include <fmt/format.h>

#include "harness/rows_of_step.h"
#include "linear/linear_solver.h"
#include "rows/laws.h"
#include "scenes/contacts.h"
#include "scenes/mechanisms.h"
#include "scenes/standard.h"
#include "studies/cost/effects_absent.h"
#include "studies/cost/repeated_seconds.h"

namespace pbdcheck {
namespace {

using namespace pbd;
using Eigen::Matrix3d;

/// f(block, i) of every constraint of blocks with so many rows and nodes.
template <int R, int K, class F>
void each_constraint(const Rows& rows, F&& f) {
  for_each_block(rows.blocks, [&]<class Block>(const Block& block) {
    if constexpr (std::is_same_v<Block, RowBlock<R, K>>)
      for (std::size_t i = 0; i < block.size(); ++i) f(block, i);
  });
}

struct Links {
  static constexpr std::string_view name = "links";
  struct Link {
    int a, b;
    Vec3 n;  // the gradient by b; by a its negative
    double bias, compliance, inverse_diagonal, impulse;
  };
  std::vector<Link> all;

  explicit Links(const Rows& rows) {
    each_constraint<1, 2>(rows, [&](const RowBlock<1, 2>& block, std::size_t i) {
      all.push_back({block.node[i][0], block.node[i][1], block.jacobian[i].tail<3>().transpose(),
                     block.bias[i][0], block.compliance[i](0, 0), block.inverse_diagonal[i](0, 0), 0});
    });
  }
  void sweep(const std::vector<double>& inverse_mass, Points& v) {
    for (Link& link : all) {
      const double residual =
          link.n.dot(v.col(link.b) - v.col(link.a)) + link.bias + link.compliance * link.impulse;
      const double change = -link.inverse_diagonal * residual;
      link.impulse += change;
      v.col(link.a) -= inverse_mass[link.a] * change * link.n;
      v.col(link.b) += inverse_mass[link.b] * change * link.n;
    }
  }
};

/// Two bodies as columns: their centres, of which one gradient is the other's negative, and their rotations.
struct BodyPair {
  int a, turn_a, b, turn_b;
  Matrix3d by_turn_a, by_turn_b;

  template <class Block>
  BodyPair(const Block& block, std::size_t i)
      : a(block.node[i][0]),
        turn_a(block.node[i][1]),
        b(block.node[i][2]),
        turn_b(block.node[i][3]),
        by_turn_a(block.jacobian[i].template middleCols<3>(3)),
        by_turn_b(block.jacobian[i].template middleCols<3>(9)) {}

  Vec3 rate_of_turns(const Points& v) const { return by_turn_a * v.col(turn_a) + by_turn_b * v.col(turn_b); }
  /// `push` moves the centres, `impulse` turns the bodies.
  void apply(const std::vector<double>& inverse_mass, const Vec3& push, const Vec3& impulse,
             Points& v) const {
    v.col(a) -= inverse_mass[a] * push;
    v.col(b) += inverse_mass[b] * push;
    v.col(turn_a) += inverse_mass[turn_a] * (by_turn_a.transpose() * impulse);
    v.col(turn_b) += inverse_mass[turn_b] * (by_turn_b.transpose() * impulse);
  }
};

struct BallJoints {
  static constexpr std::string_view name = "joints";
  struct Ball {
    BodyPair bodies;
    Matrix3d inverse_diagonal;
    Vec3 bias, impulse;
    double compliance;
  };
  std::vector<Ball> all;

  explicit BallJoints(const Rows& rows) {
    each_constraint<3, 4>(rows, [&](const RowBlock<3, 4>& block, std::size_t i) {
      all.push_back({BodyPair(block, i), block.inverse_diagonal[i], block.bias[i], Vec3::Zero(),
                     block.compliance[i](0, 0)});
    });
  }
  void sweep(const std::vector<double>& inverse_mass, Points& v) {
    for (Ball& ball : all) {
      const Vec3 residual = v.col(ball.bodies.b) - v.col(ball.bodies.a) + ball.bodies.rate_of_turns(v) +
                            ball.bias + ball.compliance * ball.impulse;
      const Vec3 change = -ball.inverse_diagonal * residual;
      ball.impulse += change;
      ball.bodies.apply(inverse_mass, change, change, v);
    }
  }
};

struct BodyContacts {
  static constexpr std::string_view name = "contacts";
  struct Touch {
    BodyPair bodies;
    Matrix3d directions, delassus;
    Vec3 bias, impulse;
    double compliance, friction;  // compliance along the normal
  };
  std::vector<Touch> all;

  explicit BodyContacts(const Rows& rows) {
    each_constraint<3, 4>(rows, [&](const RowBlock<3, 4>& block, std::size_t i) {
      all.push_back({BodyPair(block, i), block.jacobian[i].middleCols<3>(6), block.delassus[i], block.bias[i],
                     Vec3::Zero(), block.compliance[i](0, 0), block.friction[i]});
    });
  }
  void sweep(const std::vector<double>& inverse_mass, Points& v) {
    for (Touch& touch : all) {
      Vec3 residual = touch.directions * (v.col(touch.bodies.b) - v.col(touch.bodies.a)) +
                      touch.bodies.rate_of_turns(v) + touch.bias;
      residual[0] += touch.compliance * touch.impulse[0];
      const Vec3 impulse = solve_contact(Friction::coulomb, touch.friction, touch.delassus,
                                         residual - touch.delassus * touch.impulse, touch.impulse);
      const Vec3 change = impulse - touch.impulse;
      touch.impulse = impulse;
      touch.bodies.apply(inverse_mass, touch.directions.transpose() * change, change, v);
    }
  }
};

/// Hung and at rest it would need no impulses.
Scene stirred(Scene scene) {
  stir(scene);
  return scene;
}

template <class Loop>
void compare(Context& context, Table& table, const Scene& scene) {
  LinearStep own = linear_step(scene, scene.initial, 1.0 / 240);
  Loop loop(own.rows);
  Points v = own.v_free;
  GaussSeidel solver;
  constexpr int sweeps = 3;  // until both are compared
  for (int k = 0; k < sweeps; ++k) {
    solver.sweep(own.rows, own.v_free, nullptr);
    loop.sweep(own.rows.inverse_mass, v);
  }
  const double difference = (v - own.v_free).norm() / v.norm();
  const std::size_t size = loop.all.size();
  const int times = 1 + static_cast<int>(1000000 / size);  // that take a clock's ticks to nothing
  const auto all = repeated_seconds([&] {
    for (int k = 0; k < times; ++k) solver.sweep(own.rows, own.v_free, nullptr);
  });
  const auto least = repeated_seconds([&] {
    for (int k = 0; k < times; ++k) loop.sweep(own.rows.inverse_mass, v);
  });
  std::vector<double> ratios;
  for (std::size_t k = 0; k < all.size(); ++k) ratios.push_back(all[k] / least[k]);
  const Measured ratio(ratios);
  const std::string name = fmt::format("{} {}", size, Loop::name);
  const std::string id = fmt::format("{}.{}", Loop::name, size);
  table.row({name, row_count(own.rows), Measured(all).value / times, Measured(least).value / times,
             ratio.value, ratio.low, ratio.high, difference});
  context.verdict(Basis::code, "effects.stripped.same." + id,
                  name + ": the least loop ends where the solver's does", "relative distance", difference,
                  1e-12);
  // A tenth more may be the machine's.
  context.verdict(Basis::goal, "effects.stripped.time." + id,
                  name + ": a sweep takes no longer than the least loop", "time of a sweep / of the loop",
                  ratio, 1.1);
  context.advance(name);
}

}  // namespace

void effects_stripped(Context& context) {
  Table table = context.table("stripped", {"scene", "rows", "wall_s_per_sweep", "stripped_s_per_sweep",
                                           "ratio", "ratio_low", "ratio_high", "difference"});
  for (const int size : {100, 100000}) compare<Links>(context, table, stirred(chain(size)));
  for (const int size : {100, 30000}) compare<BallJoints>(context, table, stirred(rod_chain(size)));
  for (const int base : {4, 60}) compare<BodyContacts>(context, table, pyramid(base));
  table.close();
}

}  // namespace pbdcheck

#include "rigid_nonlinear.h"

#include <Eigen/Dense>
#include <IpSolveStatistics.hpp>
#include <IpTNLP.hpp>
#include <chrono>
#include <cmath>

#include "ipopt_settings.h"
#include "joint_values.h"
#include "rigid_step.h"

namespace pbd::reference {
namespace {

using Matrix4 = Eigen::Matrix4d;
using Half = Eigen::Matrix<double, 3, 4>;

/// Im(a* b) as a matrix on b's components (w, x, y, z).
Half conjugate_product(const Eigen::Vector4d& a) {
  return Half{{-a[1], a[0], a[3], -a[2]}, {-a[2], -a[3], a[0], a[1]}, {-a[3], a[2], -a[1], a[0]}};
}

/// q_l (cos(h |w|/2), h w/2 sinc) with derivatives by w.
std::array<Jet<3, 1>, 4> turned_quaternion(const Eigen::Quaterniond& from, const Vec3& w, double h) {
  using T = Jet<3, 1>;
  Triple<T> half;
  for (int i = 0; i < 3; ++i) half[static_cast<std::size_t>(i)] = 0.5 * h * T::variable(w[i], i);
  // cos(s) and sin(s)/s are functions of s^2; their derivatives by it are -sin(s)/(2 s) and
  // (cos(s) - sin(s)/s)/(2 s^2).
  const T square = dot(half, half);
  const double s = std::sqrt(square.value);
  constexpr double small = 1e-4;
  const double sinc = s > small ? std::sin(s) / s : 1 - s * s / 6;
  const double slope = s > small ? (std::cos(s) - sinc) / (2 * s * s) : -1.0 / 6 + s * s / 60;
  const T ratio = T::chain(square, sinc, slope, 0);
  const Quaternion<T> turn{T::chain(square, std::cos(s), -sinc / 2, 0),
                           {ratio * half[0], ratio * half[1], ratio * half[2]}};
  const Quaternion<T> q = product(constant<T>(from), turn);
  return {q.w, q.v[0], q.v[1], q.v[2]};
}

/// Layout of the unknowns and equations: velocities, quaternions of turning bodies, multipliers.
struct Layout {
  const RigidModel& model;
  std::vector<int> quaternion;  // of each rotor, or -1
  int multipliers = 0, size = 0;

  explicit Layout(const RigidModel& m) : model(m) {
    int next = m.unknowns;
    for (const Rotor& rotor : m.rotors) {
      quaternion.push_back(rotor.unknown < 0 ? -1 : next);
      if (rotor.unknown >= 0) next += 4;
    }
    multipliers = next;
    size = next + m.rows();
  }
};

/// Residuals and Jacobian of the equations at z.
struct Equations {
  Vector residual;
  std::vector<Eigen::Triplet<double>> jacobian;
};

class Builder {
 public:
  Builder(const RigidStep& step, const Layout& layout, const Vector& z)
      : s_(step), layout_(layout), z_(z), out_{Vector::Zero(layout.size), {}} {}

  Equations build() {
    Placement at = s_.placement(z_.head(layout_.model.unknowns));
    translations();
    for (std::size_t b = 0; b < layout_.model.rotors.size(); ++b)
      if (layout_.quaternion[b] >= 0) {
        const Eigen::Vector4d q = z_.segment<4>(layout_.quaternion[b]);
        at.orientation[b] = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
        rotation(b);
      }
    const Vector gamma = z_.tail(layout_.model.rows());
    for (const Block& block : blocks_at(layout_.model, at, Coordinates::quaternions)) add(block, gamma);
    return std::move(out_);
  }

 private:
  template <class Square>
  void put(int row, int column, const Square& part) {
    for (int i = 0; i < part.rows(); ++i)
      for (int j = 0; j < part.cols(); ++j) out_.jacobian.emplace_back(row + i, column + j, part(i, j));
  }

  void translations() {
    const Model& nodes = s_.model.nodes;
    const int n = nodes.unknowns;
    out_.residual.head(n) =
        nodes.mass.cwiseProduct(z_.head(n) - gather(nodes, s_.start.v)) / s_.h - nodes.force;
    for (int i = 0; i < n; ++i) out_.jacobian.emplace_back(i, i, nodes.mass(i) / s_.h);
  }

  void rotation(std::size_t b) {
    const Rotor& rotor = s_.model.rotors[b];
    const int first = rotor.unknown, at = layout_.quaternion[b];
    const Vec3 w = z_.segment<3>(first), before = s_.start.spin.col(static_cast<int>(b));
    // Euler's equations: I2 w2' - (I3 - I1) w3 w1 = ..., by jets.
    Triple<Jet<3, 1>> now;
    for (int i = 0; i < 3; ++i) now[static_cast<std::size_t>(i)] = Jet<3, 1>::variable(w[i], i);
    const bool implicit = s_.model.gyroscopic == GyroscopicTorque::implicit;
    const bool none = s_.model.gyroscopic == GyroscopicTorque::none;
    const Vec3 torque = s_.start.orientation[b].toRotationMatrix().transpose() * rotor.torque;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      const auto turn = [&](int l) {
        return implicit ? now[static_cast<std::size_t>(l)] : Jet<3, 1>(before[l]);
      };
      Jet<3, 1> equation =
          rotor.inertia[i] / s_.h * (now[static_cast<std::size_t>(i)] - Jet<3, 1>(before[i])) -
          Jet<3, 1>(torque[i]);
      if (!none) equation += (rotor.inertia[k] - rotor.inertia[j]) * (turn(j) * turn(k));
      out_.residual(first + i) = equation.value;
      put(first + i, first, equation.gradient.transpose());
    }
    const auto turned = turned_quaternion(s_.start.orientation[b], w, s_.h);
    for (int i = 0; i < 4; ++i) {
      const auto& component = turned[static_cast<std::size_t>(i)];
      out_.residual(at + i) = z_(at + i) - component.value;
      out_.jacobian.emplace_back(at + i, at + i, 1.0);
      put(at + i, first, -component.gradient.transpose());
    }
  }

  /// A part's equations, as a matrix on dc/d(its coordinates), and the unknowns these depend on.
  struct Share {
    int equation, offset, size, unknown;
    double per_unknown;  // of the coordinates: h for velocities
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 4> balance;
  };

  std::vector<Share> shares(const Block& block) const {
    std::vector<Share> list;
    for (const auto& [node, body, offset] : block.parts) {
      if (const int i = s_.model.nodes.first[static_cast<std::size_t>(node)]; i >= 0)
        list.push_back({i, offset, 3, i, s_.h, Eigen::Matrix3d::Identity()});
      if (body >= 0 && layout_.quaternion[static_cast<std::size_t>(body)] >= 0) {
        const int at = layout_.quaternion[static_cast<std::size_t>(body)];
        list.push_back({s_.model.rotors[static_cast<std::size_t>(body)].unknown, offset + 3, 4, at, 1,
                        conjugate_product(z_.segment<4>(at)) / 2});
      }
    }
    return list;
  }

  void add(const Block& block, const Vector& gamma) {
    const int row = layout_.multipliers + block.row, rows = block.rows();
    const RowVector own = gamma.segment(block.row, rows);
    const Block::Square geometric = block.geometric(own, Coordinates::quaternions);
    out_.residual.segment(row, rows) = block.value;
    if (!block.hard) {
      out_.residual.segment(row, rows) += block.compliance * own;
      put(row, row, block.compliance);
    }
    const Vector force = block.jacobian.transpose() * own;
    const std::vector<Share> list = shares(block);
    for (const Share& a : list) {
      const auto slope = block.jacobian.middleCols(a.offset, a.size);
      put(row, a.unknown, a.per_unknown * slope);
      out_.residual.segment<3>(a.equation) -= a.balance * force.segment(a.offset, a.size);
      put(a.equation, row, -a.balance * slope.transpose());
      for (const Share& b : list)
        put(a.equation, b.unknown,
            -b.per_unknown * a.balance * geometric.block(a.offset, b.offset, a.size, b.size));
      // Im(q* g)/2 changes with q, too: Im(q* g) = -Im(g* q).
      if (a.size == 4) put(a.equation, a.unknown, conjugate_product(force.segment<4>(a.offset)) / 2);
    }
  }

  const RigidStep& s_;
  const Layout& layout_;
  const Vector& z_;
  Equations out_;
};

/// The scaled equations as constraints of a program without objective: velocities in units that make
/// momenta, multipliers in units that make impulses alike.
class Feasibility : public Ipopt::TNLP {
 public:
  explicit Feasibility(const RigidStep& step) : step_(step), layout_(step_.model), scale_(layout_.size) {
    const RigidModel& model = step_.model;
    const double h = step_.h;
    const Vector velocity = step_.start_velocity();
    const RigidSystem system = system_at(step_, velocity, Vector::Zero(model.rows()));
    const Vector root = model.inertia.cwiseSqrt();
    // Speed of the free motion, and the mass it is meant for: the unit of impulses over root inertia.
    const Vector gained = h * system.load.cwiseQuotient(model.inertia);
    const double speed = std::max(displacement_of(step_, velocity) / h,
                                  gained.cwiseProduct(model.radius).cwiseAbs().maxCoeff());
    const double mass = model.inertia.cwiseQuotient(model.radius.cwiseAbs2()).mean();
    const double unit = std::sqrt(mass) * speed;
    start_ = Vector::Zero(layout_.size);
    start_.head(model.unknowns) = velocity;
    row_scale_ = Vector::Ones(layout_.size);
    scale_.head(model.unknowns) = unit * root.cwiseInverse();
    row_scale_.head(model.unknowns) = h / unit * root.cwiseInverse();
    const State free = step_.end(velocity);
    for (std::size_t b = 0; b < model.rotors.size(); ++b)
      if (const int at = layout_.quaternion[b]; at >= 0) {
        start_.segment<4>(at) << free.orientation[b].w(), free.orientation[b].vec();
        const double angle = h * scale_.segment<3>(model.rotors[b].unknown).maxCoeff();
        scale_.segment<4>(at).setConstant(angle);
        row_scale_.segment<4>(at).setConstant(1 / angle);
      }
    const SparseMatrix own = system.jacobian * root.cwiseInverse().asDiagonal();
    const Vector lengths = (SparseMatrix(own.cwiseProduct(own)) * Vector::Ones(model.unknowns) +
                            Vector(system.compliance.diagonal()) / (h * h))
                               .unaryExpr([](double n) { return n > 0 ? std::sqrt(n) : 1.0; });
    scale_.tail(model.rows()) = unit / h * lengths.cwiseInverse();
    row_scale_.tail(model.rows()) = lengths.cwiseInverse() / (h * unit);
    z = start_;
    entries_ = static_cast<int>(equations(Vector::Zero(layout_.size)).jacobian.size());
    const Vector reach = system.jacobian.cwiseAbs() * model.radius * free.x.cwiseAbs().maxCoeff();
    // Of quaternions, of order one, and of lengths.
    const int quaternions = layout_.multipliers - model.unknowns;
    const double turns = quaternions > 0 ? row_scale_.segment(model.unknowns, quaternions).maxCoeff() : 0;
    const double gaps = model.rows() > 0 ? reach.cwiseProduct(row_scale_.tail(model.rows())).maxCoeff() : 0;
    rounding_ = std::numeric_limits<double>::epsilon() * std::max(turns, gaps);
  }

  /// Rounding errors of the scaled equations, at least 1e-12.
  double tolerance() const { return std::max(1e-12, 8 * rounding_); }

  Vector z;
  Vector velocity() const { return z.head(step_.model.unknowns); }
  Vector gamma() const { return z.tail(step_.model.rows()); }

  bool get_nlp_info(int& n, int& m, int& jacobian_entries, int& hessian_entries,
                    IndexStyleEnum& style) override {
    n = m = layout_.size;
    jacobian_entries = entries_;
    hessian_entries = 0;
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(int n, double* lower, double* upper, int m, double* row_lower,
                       double* row_upper) override {
    std::fill_n(lower, n, -1e20), std::fill_n(upper, n, 1e20);
    std::fill_n(row_lower, m, 0), std::fill_n(row_upper, m, 0);
    return true;
  }
  bool get_starting_point(int n, bool, double* x, bool, double*, double*, int m, bool needed,
                          double* y) override {
    std::fill_n(x, n, 0);
    if (needed) std::fill_n(y, m, 0);
    return true;
  }
  bool eval_f(int, const double*, bool, double& value) override {
    value = 0;
    return true;
  }
  bool eval_grad_f(int n, const double*, bool, double* gradient) override {
    std::fill_n(gradient, n, 0);
    return true;
  }
  bool eval_g(int n, const double* x, bool, int m, double* rows) override {
    Eigen::Map<Vector>(rows, m) = equations(Eigen::Map<const Vector>(x, n)).residual.cwiseProduct(row_scale_);
    return Eigen::Map<Vector>(rows, m).allFinite();
  }
  bool eval_jac_g(int n, const double* x, bool, int, int, int* row, int* column, double* values) override {
    const Equations at = equations(x ? Vector(Eigen::Map<const Vector>(x, n)) : Vector(Vector::Zero(n)));
    int entry = 0;
    for (const auto& t : at.jacobian) {
      if (values)
        values[entry] = row_scale_(t.row()) * t.value() * scale_(t.col());
      else
        row[entry] = t.row(), column[entry] = t.col();
      ++entry;
    }
    return true;
  }
  /// Zero: with as many equations as unknowns it decides nothing.
  bool eval_h(int, const double*, bool, double, int, const double*, bool, int, int*, int*, double*) override {
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, int n, const double* x, const double*, const double*, int,
                         const double*, const double*, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    z = start_ + scale_.cwiseProduct(Eigen::Map<const Vector>(x, n));
  }

 private:
  Equations equations(const Vector& x) const {
    const Vector at = start_ + scale_.cwiseProduct(x);
    return Builder(step_, layout_, at).build();
  }

  const RigidStep& step_;
  Layout layout_;
  Vector scale_, row_scale_, start_;
  int entries_ = 0;
  double rounding_ = 0;
};

}  // namespace

Judgement rigid_ipopt(const Scene& scene, const State& state, double h) {
  const auto begin = std::chrono::steady_clock::now();
  const RigidStep step{make_rigid_model(scene), state, h};
  const Ipopt::SmartPtr<Feasibility> program = new Feasibility(step);
  const auto app = ipopt_application(program->tolerance());
  Judgement j;
  if (app->Initialize() != Ipopt::Solve_Succeeded) {
    j.reason = "Ipopt refused its options";
    return j;
  }
  const auto status = app->OptimizeTNLP(GetRawPtr(program));
  j.outcome = status == Ipopt::Solve_Succeeded || status == Ipopt::Feasible_Point_Found ? Outcome::ok
              : status == Ipopt::Infeasible_Problem_Detected                            ? Outcome::infeasible
                                                             : Outcome::not_converged;
  if (j.outcome != Outcome::ok) j.reason = "Ipopt ended with status " + std::to_string(status);
  if (IsValid(app->Statistics())) j.iterations = app->Statistics()->IterationCount();
  report(step, program->velocity(), program->gamma(), j);
  j.rank = -1;
  j.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return j;
}

}  // namespace pbd::reference

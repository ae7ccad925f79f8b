// Linear simplices, energy densities times rest volume; see elements.h for what an element is.
//
// F = sum_a x_a w_a^T, w_a the constant shape gradients. With lambda, mu the Lame constants times rest volume
// (J):
//
//   green         lambda/2 (tr E)^2 + mu E:E,  E = (F^T F - I)/2          stress S = lambda tr(E) I + 2 mu E
//                 K_ab = lambda f_a f_b^T + mu (f_b f_a^T + w_a.w_b F F^T) + w_a^T S w_b I,  f_a = F w_a
//   corotational  lambda/2 (tr Sigma - 3)^2 + mu |F - R|^2,  F = R V Sigma V^T
//                 K_ab = lambda r_a r_b^T + 2 mu w_a.w_b I + sum_k t_k z_ka z_kb^T
//                 r_a = R w_a,  z_ka = R (n_k x w_a) with n_k column k of V: the twist about n_k,
//                 t_k = (lambda (tr Sigma - 3) - 2 mu)/(sigma_i + sigma_j)
//   linear        green with F = I and S = 0 in K; constant
//
// Positive semidefinite in closed form: green with S replaced by its positive part (the rest is J^T C J);
// corotational with t_k >= -mu, as the twists are eigenvectors of eigenvalue 2 mu + 2 t_k and those of the
// rest are positive (smith2019analytic). A triangle is green in two dimensions, with the constants of plane
// stress.
#pragma once

#include "rivals/elements.h"

namespace pbd::rivals {

template <int D>
struct Simplex {
  static constexpr int nodes = D + 1;
  using Positions = Nodes<D + 1>;
  using Gradient = Eigen::Matrix<double, 3, D>;  // F
  using Small = Eigen::Matrix<double, D, D>;
  using Pairs = Eigen::Matrix<double, D + 1, D + 1>;

  Eigen::Matrix<double, D, D + 1> shape;  // w_a, 1/m
  double lambda, mu;                      // times rest volume, J
};

/// F = R axes diag(stretch) axes^T, R a rotation, axes orthogonal; stretch(0), the smallest in magnitude, is
/// negative if F is inverted.
struct Polar {
  Mat3 rotation, axes;
  Vec3 stretch;
};
Polar polar(const Mat3& F);

/// S with its negative eigenvalues set to zero.
Eigen::Matrix2d positive_part(const Eigen::Matrix2d& S);
Mat3 positive_part(const Mat3& S);

template <int D>
struct GreenElement : Simplex<D> {
  using typename Simplex<D>::Positions, typename Simplex<D>::Gradient, typename Simplex<D>::Small;
  using typename Simplex<D>::Pairs;
  using Simplex<D>::shape, Simplex<D>::lambda, Simplex<D>::mu;

  Small stress(const Small& E) const { return lambda * E.trace() * Small::Identity() + 2 * mu * E; }

  double energy(const Positions& x, Positions& gradient) const {
    const Gradient F = x * shape.transpose();
    const Small E = (F.transpose() * F - Small::Identity()) / 2, S = stress(E);
    gradient.noalias() = F * S * shape;
    return S.cwiseProduct(E).sum() / 2;
  }
  auto stiffness(const Positions& x, bool projected) const {
    const Gradient F = x * shape.transpose();
    Small S = stress((F.transpose() * F - Small::Identity()) / 2);
    if (projected) S = positive_part(S);
    const Positions f = F * shape;
    const Mat3 left = mu * F * F.transpose();
    const Pairs across = shape.transpose() * shape, geometric = shape.transpose() * S * shape;
    return [=, l = lambda, m = mu](int a, int b) -> Mat3 {
      Mat3 block =
          across(a, b) * left + l * f.col(a) * f.col(b).transpose() + m * f.col(b) * f.col(a).transpose();
      block.diagonal().array() += geometric(a, b);
      return block;
    };
  }
};

struct CorotationalElement : Simplex<3> {
  double energy(const Positions& x, Positions& gradient) const {
    const Mat3 F = x * shape.transpose();
    const Polar p = polar(F);
    gradient.noalias() = stress(F, p) * shape;
    return mu * (p.stretch.array() - 1).square().sum() + pressure(p) * (p.stretch.sum() - 3) / 2;
  }
  /// t_k; where sigma_i + sigma_j = 0 the energy has a kink, and the sum is bounded from below.
  Vec3 twists(const Vec3& stretch, bool projected) const {
    constexpr double smallest_sum = 1e-9;
    const Vec3 sums = (stretch.sum() - stretch.array()).max(smallest_sum);
    const Vec3 t = (lambda * (stretch.sum() - 3) - 2 * mu) * sums.cwiseInverse();
    return projected ? Vec3(t.cwiseMax(-mu)) : t;
  }

 private:
  double pressure(const Polar& p) const { return lambda * (p.stretch.sum() - 3); }
  Mat3 stress(const Mat3& F, const Polar& p) const {
    return 2 * mu * (F - p.rotation) + pressure(p) * p.rotation;
  }
  auto stiffness(const Polar& p, bool projected) const {
    const Positions r = p.rotation * shape;
    const Mat3 turned = p.rotation * p.axes;  // R n_k
    const Mat3 twist = turned * twists(p.stretch, projected).asDiagonal() * turned.transpose();
    const Pairs across = shape.transpose() * shape;
    return [=, l = lambda, m = mu](int a, int b) -> Mat3 {
      // z_ka = (R n_k) x r_a, so that sum_k t_k z_ka z_kb^T = [r_a]x twist [r_b]x^T
      Mat3 block = l * r.col(a) * r.col(b).transpose() +
                   cross_columns(r.col(a), cross_columns(r.col(b), twist).transpose());
      block.diagonal().array() += 2 * m * across(a, b);
      return block;
    };
  }

  /// Columns u x m_j.
  static Mat3 cross_columns(const Vec3& u, const Mat3& m) {
    Mat3 result;
    for (int j = 0; j < 3; ++j) result.col(j) = u.cross(m.col(j));
    return result;
  }

 public:
  auto stiffness(const Positions& x, bool projected) const {
    return stiffness(polar(x * shape.transpose()), projected);
  }
  /// Adds the gradient and the block of node a, by one polar decomposition.
  void add_at(const Positions& x, int a, Vec3& gradient, Mat3& block) const {
    const Mat3 F = x * shape.transpose();
    const Polar p = polar(F);
    gradient += stress(F, p) * shape.col(a);
    block += stiffness(p, false)(a, a);
  }
};

struct LinearElement : Simplex<3> {
  double energy(const Positions& x, Positions& gradient) const {
    const Mat3 F = x * shape.transpose(), strain = (F + F.transpose()) / 2 - Mat3::Identity();
    const Mat3 stress = lambda * strain.trace() * Mat3::Identity() + 2 * mu * strain;
    gradient.noalias() = stress * shape;
    return stress.cwiseProduct(strain).sum() / 2;
  }
  auto stiffness(const Positions&, bool) const {
    return [w = shape, l = lambda, m = mu](int a, int b) -> Mat3 {
      Mat3 block = l * w.col(a) * w.col(b).transpose() + m * w.col(b) * w.col(a).transpose();
      block.diagonal().array() += m * w.col(a).dot(w.col(b));
      return block;
    };
  }
};

}  // namespace pbd::rivals

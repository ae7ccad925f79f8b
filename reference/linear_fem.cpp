#include "linear_fem.h"

#include <gsl/gsl_integration.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly.h"
#include "dense.h"

namespace pbd::reference {
namespace {

using std::numbers::pi;
constexpr double amplitude = 0.1;

struct FemSystem {
  Scene scene;
  Model model;
  SparseMatrix stiffness;
};

FemSystem assemble(const LinearSolid& solid) {
  FemSystem s;
  add_solid(s.scene, solid.mesh, solid.density, solid.material, Strain::linear);
  for (std::size_t a = 0; a < solid.fixed.size(); ++a)
    if (solid.fixed[a]) s.scene.mass[a] = infinity;
  s.model = make_model(s.scene);
  s.stiffness = Assembly(s.model).at(s.scene.initial.x, {}).hessian;
  return s;
}

Points tet_corners(const TetMesh& mesh, const std::array<int, 4>& tet) {
  Points x(3, 4);
  for (int a = 0; a < 4; ++a) x.col(a) = mesh.x.col(tet[a]);
  return x;
}

/// Volume of a tetrahedron, m^3, as a sixth of the determinant of its homogeneous corners.
double volume_of(const Points& x) {
  Eigen::Matrix4d homogeneous;
  homogeneous << x, Eigen::RowVector4d::Ones();
  return std::abs(homogeneous.determinant()) / 6;
}

SparseMatrix mass_matrix(const FemSystem& s, const LinearSolid& solid, MassMatrix kind) {
  Triplets entries;
  for (const auto& tet : solid.mesh.tets) {
    const double weight = solid.density * volume_of(tet_corners(solid.mesh, tet));
    for (const int a : tet)
      for (const int b : tet) {
        const int i = s.model.first[a], j = s.model.first[b];
        const double share = kind == MassMatrix::consistent ? (a == b ? 0.1 : 0.05) : (a == b ? 0.25 : 0);
        for (int d = 0; d < 3 && i >= 0 && j >= 0 && share > 0; ++d)
          entries.emplace_back(i + d, j + d, weight * share);
      }
  }
  return from_triplets(s.model.unknowns, s.model.unknowns, entries);
}

/// u, its gradient and the body force of the manufactured solution at x.
struct Manufactured {
  Vec3 u;
  Eigen::Matrix3d gradient;
  Vec3 force;
};
Manufactured manufactured(const Vec3& x, const Material& m) {
  const double mu = m.young / (2 * (1 + m.poisson));
  const double lambda = m.young * m.poisson / ((1 + m.poisson) * (1 - 2 * m.poisson));
  const Vec3 s = (pi * x.array()).sin(), c = (pi * x.array()).cos();
  const double sss = s.prod();
  const Vec3 slope(c(0) * s(1) * s(2), s(0) * c(1) * s(2), s(0) * s(1) * c(2));
  const Vec3 mixed(s(0) * c(1) * c(2), c(0) * s(1) * c(2), c(0) * c(1) * s(2));  // without the letter d
  Manufactured at;
  at.u.setConstant(amplitude * sss);
  at.gradient.rowwise() = amplitude * pi * slope.transpose();
  for (int d = 0; d < 3; ++d) {
    const double grad_div = amplitude * pi * pi * (mixed.sum() - mixed(d) - sss);
    at.force(d) = -(lambda + mu) * grad_div + 3 * pi * pi * mu * at.u(d);
  }
  return at;
}

/// Gauss points of the unit tetrahedron in barycentric coordinates (collapsed cube), weights summing to 1.
struct Quadrature {
  std::vector<Eigen::Vector4d> point;
  std::vector<double> weight;
};
Quadrature collapsed_gauss(std::size_t n) {
  Quadrature q;
  gsl_integration_glfixed_table* table = gsl_integration_glfixed_table_alloc(n);
  const auto at = [&](std::size_t i) {
    std::pair<double, double> node;
    gsl_integration_glfixed_point(0, 1, i, &node.first, &node.second, table);
    return node;
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k) {
        const auto [r, wr] = at(i);
        const auto [s, ws] = at(j);
        const auto [t, wt] = at(k);
        const Vec3 b(r, (1 - r) * s, (1 - r) * (1 - s) * t);
        q.point.emplace_back(1 - b.sum(), b(0), b(1), b(2));
        q.weight.push_back(6 * wr * ws * wt * (1 - r) * (1 - r) * (1 - s));
      }
  gsl_integration_glfixed_table_free(table);
  return q;
}

/// Calls use(tet, corners, volume, barycentric, point, weight * volume) for every Gauss point of the mesh.
template <class Use>
void integrate(const TetMesh& mesh, const Use& use) {
  const Quadrature q = collapsed_gauss(6);
  for (const auto& tet : mesh.tets) {
    const Points x = tet_corners(mesh, tet);
    const double volume = volume_of(x);
    for (std::size_t p = 0; p < q.point.size(); ++p)
      use(tet, x, q.point[p], Vec3(x * q.point[p]), q.weight[p] * volume);
  }
}

}  // namespace

LinearSolid clamped_beam(const std::array<int, 3>& cells, const Vec3& size, const Material& material,
                         double density) {
  LinearSolid solid{kuhn_grid(cells, size), material, density, {}};
  for (int a = 0; a < solid.mesh.x.cols(); ++a) solid.fixed.push_back(solid.mesh.x(0, a) == 0);
  return solid;
}

Points face_loads(const TetMesh& mesh, const std::function<bool(const Vec3&)>& on_face,
                  const Vec3& traction) {
  Points loads = Points::Zero(3, mesh.x.cols());
  for (const auto& tet : mesh.tets)
    for (std::size_t apex = 0; apex < 4; ++apex) {
      const std::array<int, 3> face{tet[(apex + 1) % 4], tet[(apex + 2) % 4], tet[(apex + 3) % 4]};
      Eigen::Matrix3d x;
      for (int a = 0; a < 3; ++a) x.col(a) = mesh.x.col(face[a]);
      if (!on_face(x.col(0)) || !on_face(x.col(1)) || !on_face(x.col(2))) continue;
      const double area = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).norm() / 2;
      for (const int a : face) loads.col(a) += area / 3 * traction;
    }
  return loads;
}

Points linear_static(const LinearSolid& solid, const Points& loads) {
  const FemSystem s = assemble(solid);
  SparseCholesky factor;
  factor.compute(s.stiffness);
  const Vector u = factor.solve(gather(s.model, loads));
  return scatter(s.model, Points::Zero(3, loads.cols()), u);
}

std::vector<double> linear_modes(const LinearSolid& solid, int count, MassMatrix kind) {
  constexpr int guard = 6, most = 200;
  constexpr double converged = 1e-12;
  const FemSystem s = assemble(solid);
  const SparseMatrix mass = mass_matrix(s, solid, kind);
  SparseCholesky factor;
  factor.compute(s.stiffness);
  // A fixed, irregular start: no mode is orthogonal to all of these columns.
  Eigen::MatrixXd x(s.model.unknowns, std::min(count + guard, s.model.unknowns));
  for (int j = 0; j < x.cols(); ++j)
    for (int i = 0; i < x.rows(); ++i) x(i, j) = std::sin(1.0 + i * (j + 1) * 0.7548776662466927);
  Vector values = Vector::Zero(count);
  for (int it = 0; it < most; ++it) {
    const Eigen::MatrixXd y = factor.solve(Eigen::MatrixXd(mass * x));
    const auto [ritz, combination] =
        generalised_eigen(transposed_product(y, s.stiffness * y), transposed_product(y, mass * y));
    x = product(y, combination);
    const Vector next = ritz.head(count);
    const double change = ((next - values).array() / next.array()).abs().maxCoeff();
    values = next;
    if (change < converged) break;
  }
  std::vector<double> hertz;
  for (const double value : values) hertz.push_back(std::sqrt(value) / (2 * pi));
  return hertz;
}

ManufacturedError manufactured_cube(int n, const Material& material) {
  LinearSolid solid{kuhn_grid({n, n, n}, Vec3::Ones()), material, 1, {}};
  const TetMesh& mesh = solid.mesh;
  for (int a = 0; a < mesh.x.cols(); ++a)
    solid.fixed.push_back(mesh.x.col(a).minCoeff() == 0 || mesh.x.col(a).maxCoeff() == 1);
  Points loads = Points::Zero(3, mesh.x.cols());
  integrate(mesh,
            [&](const auto& tet, const Points&, const Eigen::Vector4d& b, const Vec3& at, double weight) {
              const Vec3 force = manufactured(at, material).force;
              for (int a = 0; a < 4; ++a) loads.col(tet[a]) += weight * b(a) * force;
            });
  const Points u = linear_static(solid, loads);
  double l2 = 0, h1 = 0;
  integrate(mesh,
            [&](const auto& tet, const Points& x, const Eigen::Vector4d& b, const Vec3& at, double weight) {
              const Manufactured exact = manufactured(at, material);
              Eigen::Matrix<double, 3, 4> nodal;
              for (int a = 0; a < 4; ++a) nodal.col(a) = u.col(tet[a]);
              const Eigen::Matrix3d edges = x.rightCols<3>().colwise() - x.col(0);
              const Eigen::Matrix3d difference = nodal.rightCols<3>().colwise() - nodal.col(0);
              l2 += weight * (nodal * b - exact.u).squaredNorm();
              h1 += weight * (difference * edges.inverse() - exact.gradient).squaredNorm();
            });
  return {std::sqrt(l2), std::sqrt(h1)};
}

double manufactured_energy(const Material& m) {
  const double mu = m.young / (2 * (1 + m.poisson));
  const double lambda = m.young * m.poisson / ((1 + m.poisson) * (1 - 2 * m.poisson));
  return pi * pi * amplitude * amplitude / 16 * (3 * (lambda + mu) + 9 * mu);
}

}  // namespace pbd::reference

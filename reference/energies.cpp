#include "energies.h"

#include <cmath>
#include <numbers>

#include "constraint_values.h"
#include "polar.h"

namespace pbd::reference {
namespace {

template <class T, int Q>
std::array<Triple<T>, Q> columns_of(const Eigen::Matrix3d& f) {
  std::array<Triple<T>, Q> columns;
  for (int j = 0; j < Q; ++j)
    for (int i = 0; i < 3; ++i) {
      T& entry = columns[j][i];
      if constexpr (std::is_same_v<T, double>)
        entry = f(i, j);
      else
        entry = T::variable(f(i, j), 3 * j + i);
    }
  return columns;
}

/// theta - rest in (-pi, pi].
double wrapped(double angle) {
  angle = std::remainder(angle, 2 * std::numbers::pi);
  return angle <= -std::numbers::pi ? angle + 2 * std::numbers::pi : angle;
}
template <int D, int Order>
Jet<D, Order> wrapped(Jet<D, Order> angle) {
  angle.value = wrapped(angle.value);
  return angle;
}

/// c of an element as an array of T; calls `use` with it.
template <template <int> class Number, class Use>
void with_value(const Element& element, const Eigen::Matrix3d& f, const Use& use) {
  switch (element.kind) {
    case Kind::anchor: {
      auto columns = columns_of<typename Number<3>::Type, 1>(f);
      for (std::size_t i = 0; i < 3; ++i) columns[0][i] -= element.rest(i);
      return use(columns[0]);
    }
    case Kind::distance: {
      using T = typename Number<3>::Type;
      return use(std::array<T, 1>{length(columns_of<T, 1>(f)[0]) - T(element.rest(0))});
    }
    case Kind::bending: {
      using T = typename Number<9>::Type;
      const auto d = columns_of<T, 3>(f);
      return use(std::array<T, 1>{wrapped(hinge_angle(d[0], d[1], d[2]) - T(element.rest(0)))});
    }
    case Kind::triangle:
      return use(green_strain(columns_of<typename Number<6>::Type, 2>(f)));
    case Kind::green:
      return use(green_strain(columns_of<typename Number<9>::Type, 3>(f)));
    case Kind::linear:
      return use(linear_strain(columns_of<typename Number<9>::Type, 3>(f)));
    case Kind::corotational:
      return;  // polar.h
  }
}

template <int D>
struct Plain {
  using Type = double;
};
template <int D>
struct DifferentiatedOnce {
  using Type = Jet<D, 1>;
};
template <int D>
struct Differentiated {
  using Type = Jet<D>;
};

/// Value and derivatives to the order of Number; `use` gets the index of each row and its jet.
template <template <int> class Number, class Use>
void differentiate_rows(const Element& element, const Eigen::Matrix3d& f, Local& local, const Use& use) {
  local.value.resize(element.rows);
  local.jacobian.resize(element.rows, element.variables());
  with_value<Number>(element, f, [&](const auto& value) {
    for (std::size_t k = 0; k < value.size(); ++k) {
      const int i = static_cast<int>(k);
      local.value(i) = value[k].value;
      local.jacobian.row(i) = value[k].gradient;
      use(k, value[k]);
    }
  });
}

}  // namespace

Eigen::Matrix3d local_matrix(const Element& e, const Points& x) {
  Eigen::Matrix3d f = Eigen::Matrix3d::Zero();
  for (int a = 0; a < e.nodes; ++a) f += x.col(e.node[a]) * e.weight.row(a);
  return f;
}

RowVector constraint_value(const Element& element, const Points& x) {
  const Eigen::Matrix3d f = local_matrix(element, x);
  if (element.kind == Kind::corotational) return corotational_strain(f);
  RowVector c(element.rows);
  with_value<Plain>(element, f, [&](const auto& value) {
    for (std::size_t i = 0; i < value.size(); ++i) c(i) = value[i];
  });
  return c;
}

void differentiate(const Element& element, const Points& x, Local& local) {
  const Eigen::Matrix3d f = local_matrix(element, x);
  if (element.kind == Kind::corotational) {
    const StrainDerivatives d = corotational_derivatives(f);
    local.value = d.value;
    local.jacobian = d.jacobian;
    for (std::size_t k = 0; k < 6; ++k) local.hessian[k] = d.hessian[k];
    return;
  }
  differentiate_rows<Differentiated>(element, f, local,
                                     [&](std::size_t k, const auto& row) { local.hessian[k] = row.hessian; });
}

void differentiate_once(const Element& element, const Points& x, Local& local) {
  const Eigen::Matrix3d f = local_matrix(element, x);
  if (element.kind == Kind::corotational) {
    const StrainSlope d = corotational_slope(f);
    local.value = d.value;
    local.jacobian = d.jacobian;
    return;
  }
  differentiate_rows<DifferentiatedOnce>(element, f, local, [](std::size_t, const auto&) {});
}

RowVector stress(const Element& e, const RowVector& c, const Multipliers& m) {
  if (!e.hard()) return e.stiffness * c;
  RowVector s = RowVector::Zero(e.rows);
  if (m.rho.size()) s += m.rho.segment(e.first_row, e.rows).cwiseProduct(c);
  if (m.gamma.size()) s -= m.gamma.segment(e.first_row, e.rows);
  return s;
}

double energy(const Element& e, const RowVector& c, const Multipliers& m) {
  double value = stress(e, c, m).dot(c) / 2;
  if (e.hard() && m.gamma.size()) value -= m.gamma.segment(e.first_row, e.rows).dot(c) / 2;
  return value;
}

double lagrangian(const Model& model, const Points& x, const Multipliers& multipliers) {
  double sum = 0;
  for (const Element& e : model.elements) sum += energy(e, constraint_value(e, x), multipliers);
  return sum;
}

}  // namespace pbd::reference

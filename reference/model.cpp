// Rest quantities of every effect of nodes, from the rest positions in the scene.
//   tetrahedron  Dm = [X1-X0, X2-X0, X3-X0], F = Ds Dm^-1, so w_1..3 = rows of Dm^-1 and w_0 = -(w_1 + w_2 +
//                w_3); V = det Dm / 6
//   triangle     likewise in the plane of the rest triangle with u along X0 X1; area = det Dm / 2
//   A^-1         V C of a tetrahedron, area C of a triangle; 1/compliance otherwise
#include <Eigen/Dense>
#include <cmath>

#include "energies.h"
#include "error.h"
#include "judged_effects.h"
#include "validate.h"

namespace pbd::reference {

Eigen::Matrix<double, 6, 6> elasticity(const Material& material) {
  const double shear = material.young / (2 * (1 + material.poisson));
  const double lame =
      material.young * material.poisson / ((1 + material.poisson) * (1 - 2 * material.poisson));
  Eigen::Matrix<double, 6, 6> c = Eigen::Matrix<double, 6, 6>::Zero();
  c.topLeftCorner<3, 3>().setConstant(lame);
  c.diagonal().head<3>().array() += 2 * shear;
  c.diagonal().tail<3>().setConstant(shear);
  return c;
}

Eigen::Matrix3d membrane(const Material& material, double thickness) {
  const double nu = material.poisson;
  Eigen::Matrix3d c;
  c << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  return thickness * material.young / (1 - nu * nu) * c;
}

namespace {

template <std::size_t K>
Element element_of(Kind kind, const std::array<int, K>& node, int columns, int rows) {
  Element element;
  element.kind = kind;
  element.nodes = static_cast<int>(K);
  element.columns = columns;
  element.rows = rows;
  std::copy(node.begin(), node.end(), element.node.begin());
  element.weight.setZero();
  element.stiffness.setZero(rows, rows);
  // Differences to the first node, unless the element has shape gradients of its own.
  for (int q = 0; q < columns && K > 1; ++q) element.weight(0, q) = -1, element.weight(q + 1, q) = 1;
  if (K == 1) element.weight(0, 0) = 1;
  return element;
}

Kind kind_of(Strain strain) {
  switch (strain) {
    case Strain::green:
      return Kind::green;
    case Strain::corotational:
      return Kind::corotational;
    case Strain::linear:
      return Kind::linear;
  }
  throw SetupError("tet_strain strain", std::to_string(int(strain)), "green, corotational, linear");
}

/// Numbers the element's rows if it is hard, else stores its stiffness.
struct Builder {
  Model& model;
  int effect = 0;

  void add(Element element, std::size_t entry, bool hard) {
    element.effect = effect;
    element.entry = static_cast<int>(entry);
    if (hard) {
      element.first_row = model.hard_rows;
      model.hard_rows += element.rows;
    }
    model.elements.push_back(element);
  }

  void add_scalar(Element element, std::size_t entry, double compliance) {
    if (compliance > 0) element.stiffness.diagonal().setConstant(1 / compliance);
    add(element, entry, compliance == 0);
  }

  void operator()(const Gravity& gravity) {
    for (const int i : model.first)
      if (i >= 0) model.force.segment<3>(i) += model.mass(i) * gravity.acceleration;
  }
  void operator()(const ExternalForce& external) {
    for (std::size_t i = 0; i < external.node.size(); ++i) {
      const int unknown = model.first[external.node[i]];
      if (unknown >= 0) model.force.segment<3>(unknown) += external.force[i];
    }
  }
  void operator()(const Contact&) {
    throw SetupError(
        "effects[" + std::to_string(effect) + "] contact", "contact",
        "none: this judge knows equations only; the judges of contact are cone_interior_point and "
        "cone_ipopt");
  }
  /// Stated by rigid_model.cpp.
  template <Among<BodyEffects> E>
  void operator()(const E&) {}
  void operator()(const Anchor& anchor) {
    for (std::size_t i = 0; i < anchor.node.size(); ++i) {
      Element element = element_of(Kind::anchor, std::array{anchor.node[i]}, 1, 3);
      element.rest = anchor.target[i];
      add_scalar(element, i, anchor.compliance[i]);
    }
  }
  void operator()(const Distance& distance) {
    for (std::size_t i = 0; i < distance.node.size(); ++i) {
      Element element = element_of(Kind::distance, distance.node[i], 1, 1);
      element.rest(0) = distance.rest_length[i];
      add_scalar(element, i, distance.compliance[i]);
    }
  }
  void operator()(const Bending& bending) {
    for (std::size_t i = 0; i < bending.node.size(); ++i) {
      Element element = element_of(Kind::bending, bending.node[i], 3, 1);
      element.rest(0) = bending.rest_angle[i];
      add_scalar(element, i, bending.compliance[i]);
    }
  }
  void operator()(const TriangleStrain& strain) {
    const bool hard = std::isinf(strain.material.young);
    for (std::size_t i = 0; i < strain.node.size(); ++i) {
      Element element = element_of(Kind::triangle, strain.node[i], 2, 3);
      const Vec3 edge = strain.rest[i].col(1) - strain.rest[i].col(0);
      const Vec3 other = strain.rest[i].col(2) - strain.rest[i].col(0);
      Eigen::Matrix2d dm;
      dm << edge.norm(), edge.dot(other) / edge.norm(), 0, edge.cross(other).norm() / edge.norm();
      const Eigen::Matrix2d inverse = dm.inverse();
      element.weight.block<2, 2>(1, 0) = inverse;
      element.weight.block<1, 2>(0, 0) = -inverse.colwise().sum();
      if (!hard) element.stiffness = dm.determinant() / 2 * membrane(strain.material, strain.thickness);
      add(element, i, hard);
    }
  }
  void operator()(const TetStrain& strain) {
    const Kind kind = kind_of(strain.strain);
    for (std::size_t i = 0; i < strain.node.size(); ++i) {
      Element element = element_of(kind, strain.node[i], 3, 6);
      const Eigen::Matrix3d dm = strain.rest[i].rightCols<3>().colwise() - strain.rest[i].col(0);
      const Eigen::Matrix3d inverse = dm.inverse();
      element.weight.bottomRows<3>() = inverse;
      element.weight.row(0) = -inverse.colwise().sum();
      element.stiffness = dm.determinant() / 6 * elasticity(strain.material);
      add(element, i, false);
    }
  }
};

static_assert(AllJudged<Effect>::value);
static_assert(states<Builder>(NodeEffects{}), "an effect of nodes without its statement");
static_assert(states<Builder>(RefusedEffects{}), "a refused effect without its refusal");

}  // namespace

Model make_model(const Scene& scene) {
  if (!scene.bodies.empty())
    throw SetupError("bodies", std::to_string(scene.bodies.size()) + " rigid bodies",
                     "none: this judge knows nodes only");
  Model model = make_node_model(scene);
  if (model.unknowns == 0) throw SetupError("scene mass", "infinite masses only", "at least one finite mass");
  return model;
}

Model make_node_model(const Scene& scene) {
  validate(scene);
  Model model;
  for (const double mass : scene.mass) {
    const bool fixed = std::isinf(mass);
    model.first.push_back(fixed ? -1 : model.unknowns);
    if (!fixed) model.unknowns += 3;
  }
  model.mass.resize(model.unknowns);
  model.force.setZero(model.unknowns);
  for (std::size_t a = 0; a < scene.mass.size(); ++a)
    if (model.first[a] >= 0) model.mass.segment<3>(model.first[a]).setConstant(scene.mass[a]);

  Builder builder{model};
  for (const Effect& effect : scene.effects) {
    if (damped(effect))
      throw SetupError("effects[" + std::to_string(builder.effect) + "] damping", "damping",
                       "none: this judge knows elastic forces only");
    std::visit(builder, effect);
    ++builder.effect;
  }
  return model;
}

Vector gather(const Model& model, const Points& x) {
  Vector unknowns(model.unknowns);
  for (std::size_t a = 0; a < model.first.size(); ++a)
    if (model.first[a] >= 0) unknowns.segment<3>(model.first[a]) = x.col(a);
  return unknowns;
}

Points scatter(const Model& model, const Points& x, const Vector& unknowns) {
  Points result = x;
  for (std::size_t a = 0; a < model.first.size(); ++a)
    if (model.first[a] >= 0) result.col(a) = unknowns.segment<3>(model.first[a]);
  return result;
}

}  // namespace pbd::reference

#include "rivals/vbd.h"

#include <Eigen/LU>
#include <limits>

#include "rivals/sweeping.h"

namespace pbd::rivals {
namespace {

class Vbd final : public Sweeping {
 public:
  Vbd(const Scene& scene, double h) : Sweeping("vbd", scene, h) { potential_.attach_nodes(scene.nodes()); }

 private:
  void begin() override { diagonal_ = Points::Zero(3, step_.mass.size()); }

  void sweep(Points& x) override {
    for (int node = 0; node < step_.mass.size(); ++node) {
      const double inertia = step_.mass(node) / (step_.h * step_.h);
      if (!(inertia > 0)) continue;
      Vec3 gradient = inertia * (x.col(node) - step_.target.col(node));
      Mat3 stiffness = inertia * Mat3::Identity();
      potential_.add_at(node, x, gradient, stiffness);
      diagonal_.col(node) = stiffness.diagonal();
      Mat3 inverse;
      bool regular = false;
      stiffness.computeInverseWithCheck(inverse, regular, 0);
      if (regular) x.col(node) -= inverse * gradient;
    }
  }

  double rounding(const Points& x) const override {
    return std::numeric_limits<double>::epsilon() * step_.h * step_.dual_norm(diagonal_.cwiseProduct(x));
  }

  Points diagonal_;  // of the H_i of the last sweep, N/m
};

}  // namespace

std::unique_ptr<Rival> vbd(const Scene& scene, double h) {
  return std::make_unique<Vbd>(scene, h);
}

}  // namespace pbd::rivals

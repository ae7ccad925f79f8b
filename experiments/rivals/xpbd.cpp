#include "rivals/xpbd.h"

#include "rivals/sweeping.h"

namespace pbd::rivals {
namespace {

class Xpbd final : public Sweeping {
 public:
  Xpbd(const Scene& scene, double h) : Sweeping("xpbd", scene, h) {}

 private:
  void begin() override { multiplier_.assign(potential_.elements(), 0.0); }
  void sweep(Points& x) override { potential_.sweep(step_.inverse_mass, step_.h, multiplier_, x); }
  double rounding(const Points&) const override { return 0; }

  std::vector<double> multiplier_;  // of the elements, sqrt(J) s^2
};

}  // namespace

std::unique_ptr<Rival> xpbd(const Scene& scene, double h) {
  return std::make_unique<Xpbd>(scene, h);
}

}  // namespace pbd::rivals

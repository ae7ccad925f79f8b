// The experiments, in the order of the report: one row each.
#include "experiment.h"

namespace pbdcheck {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> list;
  return list;
}

}  // namespace pbdcheck

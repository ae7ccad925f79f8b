#include "judges.h"

#include "choices.h"
#include "error.h"

namespace pbdcheck {

std::vector<std::string> reference_names() {
  return {};
}

std::vector<std::string> case_names() {
  return {};
}

Judged judge_step(const std::string& name, const pbd::Scene&, const pbd::State&, double) {
  throw pbd::SetupError("--reference", "`" + name + "`", allowed_names(name, reference_names()));
}

}  // namespace pbdcheck

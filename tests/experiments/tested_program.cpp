#include "program.h"

namespace pbdcheck::test {

std::string tested_program() {
  return PBDCHECK_PROGRAM;
}

}  // namespace pbdcheck::test

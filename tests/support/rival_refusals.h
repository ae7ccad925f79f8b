// What rivals refuse, in words.
#pragma once

#include <string>

#include "error.h"
#include "rivals/rival.h"

namespace pbd::test {

/// The error's text; empty if the rival takes the scene.
inline std::string refusal(rivals::MakeRival make, const Scene& scene, double h) {
  try {
    make(scene, h);
  } catch (const SetupError& error) {
    return error.what();
  }
  return "";
}

}  // namespace pbd::test

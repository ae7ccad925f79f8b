// Which BLAS the factorisations call: it decides how fast they are.
#pragma once

#include <string>

namespace pbd::rivals {

/// Path of the library, links resolved; `unknown` if there is none.
std::string blas_library();

}  // namespace pbd::rivals

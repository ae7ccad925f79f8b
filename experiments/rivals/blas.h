// Which BLAS the factorisations call: it decides how fast they are.
#pragma once

#include <string>

namespace pbd::rivals {

/// Path of the library, links resolved; `unknown` if there is none.
std::string blas_library();

/// OpenBLAS shall not use threads of its own: results repeat, and the experiments have theirs.
void use_one_blas_thread();

/// False for Debian's serial OpenBLAS: it keeps buffers without locks, and what two threads compute at a time
/// is wrong now and then.
bool blas_is_thread_safe();

}  // namespace pbd::rivals

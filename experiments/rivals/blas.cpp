#include "rivals/blas.h"

#include <dlfcn.h>

#include <filesystem>

namespace pbd::rivals {

std::string blas_library() {
  Dl_info library{};
  void* const function = dlsym(RTLD_DEFAULT, "dgemm_");
  if (function == nullptr || dladdr(function, &library) == 0) return "unknown";
  std::error_code failure;
  const auto path = std::filesystem::canonical(library.dli_fname, failure);
  return failure ? "unknown" : path.string();
}

}  // namespace pbd::rivals

#include "rivals/blas.h"

#include <dlfcn.h>

#include <filesystem>
#include <string_view>

namespace pbd::rivals {

std::string blas_library() {
  Dl_info library{};
  void* const function = dlsym(RTLD_DEFAULT, "dgemm_");
  if (function == nullptr || dladdr(function, &library) == 0) return "unknown";
  std::error_code failure;
  const auto path = std::filesystem::canonical(library.dli_fname, failure);
  return failure ? "unknown" : path.string();
}

void use_one_blas_thread() {
  if (void* const found = dlsym(RTLD_DEFAULT, "openblas_set_num_threads"))
    reinterpret_cast<void (*)(int)>(found)(1);
}

bool blas_is_thread_safe() {
  void* const found = dlsym(RTLD_DEFAULT, "openblas_get_config");
  if (found == nullptr) return true;
  const std::string_view built = reinterpret_cast<const char* (*)()>(found)();
  return built.find("SINGLE_THREADED") == built.npos || built.find("USE_LOCKING") != built.npos;
}

}  // namespace pbd::rivals

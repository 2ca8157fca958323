#include "app/study/Blas.h"

#include <dlfcn.h>

namespace palp {

std::optional<std::string> slowBlas() {
  void* gemm = dlsym(RTLD_DEFAULT, "dgemm_");
  Dl_info where{};
  const std::string file = gemm && dladdr(gemm, &where) && where.dli_fname ? where.dli_fname : "no shared library";
  if (file.find("openblas") != std::string::npos) return {};
  return "BLAS comes from " + file +
         ", not from OpenBLAS: solves will be several times slower; install libopenblas0-pthread and choose it with "
         "update-alternatives --config libblas.so.3-x86_64-linux-gnu";
}

} // namespace palp

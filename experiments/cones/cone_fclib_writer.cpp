// Problems as FCLIB's local ones, W by columns (cone_fclib.cpp has the layout).
#include "cones/cone_file.h"
#include "cones/hdf5_handle.h"
#include "harness/files.h"

namespace pbdcheck {
namespace {

using Eigen::VectorXd;

/// Writes into a file that lives in memory.
class Writer {
 public:
  Writer() : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), file_(created(access_), H5Fclose) {}

  void group(const char* name) {
    const Hdf5Handle made(H5Gcreate2(file_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  }
  void integers(const std::string& name, const std::vector<int>& values) {
    write(name, values.size(), values.data(), H5T_STD_I32LE, H5T_NATIVE_INT);
  }
  void numbers(const std::string& name, const VectorXd& values) {
    write(name, static_cast<std::size_t>(values.size()), values.data(), H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE);
  }
  std::string image() {
    H5Fflush(file_, H5F_SCOPE_GLOBAL);
    std::string bytes(static_cast<std::size_t>(H5Fget_file_image(file_, nullptr, 0)), '\0');
    H5Fget_file_image(file_, bytes.data(), bytes.size());
    return bytes;
  }

 private:
  static hid_t created(hid_t access) {
    constexpr std::size_t growth = 1U << 20U;
    H5Pset_fapl_core(access, growth, false);
    return H5Fcreate("problem", H5F_ACC_TRUNC, H5P_DEFAULT, access);
  }
  void write(const std::string& name, std::size_t count, const void* values, hid_t stored, hid_t native) {
    const hsize_t size = count;
    const Hdf5Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Hdf5Handle set(
        H5Dcreate2(file_, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    if (H5Dwrite(set, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      throw std::runtime_error("HDF5 cannot write " + name);
  }

  Hdf5Handle access_, file_;
};

}  // namespace

void write_cone_file(const std::filesystem::path& path, const pbd::reference::ConeProblem& problem,
                     const pbd::reference::ConeSolution& solution) {
  PartialFile file(path);
  Sparse w = problem.delassus;
  w.makeCompressed();
  Writer writer;
  for (const char* name : {"/fclib_local", "/fclib_local/W", "/fclib_local/vectors", "/solution"})
    writer.group(name);
  const int rows = static_cast<int>(w.rows()), entries = static_cast<int>(w.nonZeros());
  writer.integers("/fclib_local/spacedim", {3});
  for (const auto& [name, value] :
       {std::pair("m", rows), std::pair("n", rows), std::pair("nz", -1), std::pair("nzmax", entries)})
    writer.integers(std::string("/fclib_local/W/") + name, {value});
  writer.integers("/fclib_local/W/p", {w.outerIndexPtr(), w.outerIndexPtr() + rows + 1});
  writer.integers("/fclib_local/W/i", {w.innerIndexPtr(), w.innerIndexPtr() + entries});
  writer.numbers("/fclib_local/W/x", Eigen::Map<const VectorXd>(w.valuePtr(), entries));
  writer.numbers("/fclib_local/vectors/q", problem.free_velocity);
  writer.numbers("/fclib_local/vectors/mu", problem.friction);
  writer.numbers("/solution/u", solution.velocity);
  writer.numbers("/solution/r", solution.impulse);
  file.write(writer.image());
  file.complete();
}

}  // namespace pbdcheck

// FCLIB's HDF5 layout: /fclib_local/{W, vectors/{q, mu}}, /fclib_global/{M, H, vectors/{f, w, mu}},
// /solution/{u, r}. A matrix has m, n, nz, nzmax, p, i, x: nz -1 by columns, -2 by rows, else nz triplets. Of
// these fclib.h calls p rows and i columns, but programs write CSparse's arrays, p columns and i rows, as
// they are: they are read so, or the header's way if only that fits.
#include <fmt/format.h>
#include <hdf5.h>

#include <Eigen/SparseCholesky>

#include "cones/cone_file.h"
#include "error.h"
#include "harness/files.h"

namespace pbdcheck {
namespace {

using Eigen::VectorXd;
using pbd::SetupError;

/// An HDF5 object, closed at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path)
      : path_(path.string()), file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose) {
    if (file_ < 0) refuse("an HDF5 file that cannot be opened", "a complete one");
  }

  [[noreturn]] void refuse(const std::string& got, const std::string& allowed) const {
    throw SetupError(path_, got, allowed);
  }

  bool has(const std::string& name) const {
    for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
      if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
      if (end == std::string::npos) return true;
    }
  }

  template <class Number>
  std::vector<Number> numbers(const std::string& name) const {
    constexpr bool integers = std::is_same_v<Number, int>;
    if (!has(name)) refuse("no " + name, "a whole FCLIB problem");
    const Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle type(set < 0 ? -1 : H5Dget_type(set), H5Tclose),
        space(set < 0 ? -1 : H5Dget_space(set), H5Sclose);
    if (type < 0 || space < 0 || H5Tget_class(type) != (integers ? H5T_INTEGER : H5T_FLOAT))
      refuse(name + " of another type", integers ? "integers" : "floating point numbers");
    const auto stored = static_cast<hsize_t>(std::filesystem::file_size(path_)) / H5Tget_size(type);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    if (count < 0 || (count > 0 && H5Dget_storage_size(set) == 0) ||
        static_cast<hsize_t>(count) > 1000 * stored)
      refuse(name + " of a size that the file cannot hold", "a complete file");
    std::vector<Number> all(static_cast<std::size_t>(count));
    if (count > 0 && H5Dread(set, integers ? H5T_NATIVE_INT : H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL,
                             H5P_DEFAULT, all.data()) < 0)
      refuse(name + " that cannot be read", "a complete file");
    return all;
  }

  int integer(const std::string& name) const {
    const auto all = numbers<int>(name);
    if (all.size() != 1) refuse(fmt::format("{} of {} numbers", name, all.size()), "one");
    return all.front();
  }

  VectorXd vector(const std::string& name) const {
    const auto all = numbers<double>(name);
    return Eigen::Map<const VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
  }

  Sparse matrix(const std::string& name) const {
    const int rows = integer(name + "/m"), columns = integer(name + "/n"), kind = integer(name + "/nz");
    const auto p = numbers<int>(name + "/p"), i = numbers<int>(name + "/i");
    const auto x = numbers<double>(name + "/x");
    const auto wrong = [&](const std::string& what) { refuse(name + " with " + what, "a sparse matrix"); };
    constexpr int most = 10000000;
    if (rows < 0 || rows > most || columns < 0 || columns > most || kind < -2)
      wrong(fmt::format("m = {}, n = {}, nz = {}", rows, columns, kind));
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int row, int column, std::size_t k) {
      if (row < 0 || row >= rows || column < 0 || column >= columns)
        wrong(fmt::format("an entry at ({}, {}) of {} x {}", row, column, rows, columns));
      entries.emplace_back(row, column, x[k]);
    };
    if (kind >= 0) {
      const auto count = static_cast<std::size_t>(kind);
      if (std::min({p.size(), i.size(), x.size()}) < count) wrong("fewer entries than nz");
      bool by_csparse = true;
      for (std::size_t k = 0; k < count; ++k) by_csparse = by_csparse && i[k] < rows && p[k] < columns;
      for (std::size_t k = 0; k < count; ++k) by_csparse ? add(i[k], p[k], k) : add(p[k], i[k], k);
    } else {
      const int lines = kind == -1 ? columns : rows;
      if (p.size() != static_cast<std::size_t>(lines) + 1 || p.front() != 0)
        wrong("pointers p that do not fit");
      for (int line = 0; line < lines; ++line) {
        const int first = p[static_cast<std::size_t>(line)], last = p[static_cast<std::size_t>(line) + 1];
        if (first > last || static_cast<std::size_t>(last) > std::min(i.size(), x.size()))
          wrong("pointers p that do not fit");
        for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k)
          kind == -1 ? add(i[k], line, k) : add(line, i[k], k);
      }
    }
    Sparse matrix(rows, columns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

 private:
  std::string path_;
  Handle file_;
};

void require_plain(const Reader& reader, const std::string& group,
                   std::initializer_list<const char*> bilateral) {
  if (const int dimension = reader.integer(group + "/spacedim"); dimension != 3)
    reader.refuse(fmt::format("spacedim = {}", dimension), "3");
  for (const char* name : bilateral)
    if (reader.has(group + "/" + name))
      reader.refuse(fmt::format("bilateral constraints ({}/{})", group, name), "contacts alone");
}

StoredCone read_global(const Reader& reader) {
  const std::string group = "/fclib_global";
  require_plain(reader, group, {"G"});
  const Sparse m = reader.matrix(group + "/M"), h = reader.matrix(group + "/H");
  const VectorXd f = reader.vector(group + "/vectors/f"), w = reader.vector(group + "/vectors/w");
  if (m.rows() != m.cols() || h.rows() != m.rows() || f.size() != m.rows() || w.size() != h.cols())
    reader.refuse(fmt::format("M of {} x {}, H of {} x {}, f of {} and w of {} numbers", m.rows(), m.cols(),
                              h.rows(), h.cols(), f.size(), w.size()),
                  "n x n, n x m, n and m");
  const Eigen::SimplicialLLT<Sparse> factor(Sparse(0.5 * (m + Sparse(m.transpose()))));
  if (factor.info() != Eigen::Success) reader.refuse("M that is not positive definite", "a mass matrix");
  StoredCone stored;
  stored.delassus = Sparse(h.transpose()) * Sparse(factor.solve(h));
  stored.free_velocity = w + h.transpose() * VectorXd(factor.solve(f));
  stored.friction = reader.vector(group + "/vectors/mu");
  stored.form = "FCLIB global, condensed";
  return stored;
}

/// Writes into a file that lives in memory.
class Writer {
 public:
  Writer() : access_(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), file_(created(access_), H5Fclose) {}

  void group(const char* name) {
    const Handle made(H5Gcreate2(file_, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
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
    const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const Handle set(H5Dcreate2(file_, name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                     H5Dclose);
    if (H5Dwrite(set, native, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
      throw std::runtime_error("HDF5 cannot write " + name);
  }

  Handle access_, file_;
};

}  // namespace

bool is_hdf5(const std::filesystem::path& path) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);  // what is wrong is said by SetupErrors
  return H5Fis_hdf5(path.c_str()) > 0;
}

StoredCone read_fclib(const std::filesystem::path& path) {
  const Reader reader(path);
  if (reader.has("/fclib_global")) return read_global(reader);
  const std::string group = "/fclib_local";
  if (!reader.has(group)) reader.refuse("an HDF5 file without a problem", "/fclib_local or /fclib_global");
  require_plain(reader, group, {"V", "R"});
  StoredCone stored;
  stored.delassus = reader.matrix(group + "/W");
  stored.free_velocity = reader.vector(group + "/vectors/q");
  stored.friction = reader.vector(group + "/vectors/mu");
  stored.form = "FCLIB local";
  return stored;
}

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

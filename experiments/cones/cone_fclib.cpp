// FCLIB's HDF5 layout: /fclib_local/{W, vectors/{q, mu}}, /fclib_global/{M, H, vectors/{f, w, mu}},
// /solution/{u, r}. A matrix has m, n, nz, nzmax, p, i, x: nz -1 by columns, -2 by rows, else nz triplets. Of
// these fclib.h calls p rows and i columns, but programs write CSparse's arrays, p columns and i rows, as
// they are: they are read so, or the header's way if only that fits. A square matrix fits both ways: written
// the header's way it is read transposed, of which a warning tells if it is unsymmetric.
#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "cones/cone_file.h"
#include "cones/hdf5_handle.h"
#include "error.h"

namespace pbdcheck {
namespace {

using Eigen::VectorXd;
using pbd::SetupError;

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
    const Hdf5Handle set(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
    const Hdf5Handle type(set < 0 ? -1 : H5Dget_type(set), H5Tclose),
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

  /// Tells `stored` which way triplets are read.
  Sparse matrix(const std::string& name, StoredCone& stored) const {
    const int rows = integer(name + "/m"), columns = integer(name + "/n"), kind = integer(name + "/nz");
    constexpr int most = 10000000;
    if (rows < 0 || rows > most || columns < 0 || columns > most || kind < -2)
      wrong(name, fmt::format("m = {}, n = {}, nz = {}", rows, columns, kind));
    SparseArrays arrays{name,
                        rows,
                        columns,
                        numbers<int>(name + "/p"),
                        numbers<int>(name + "/i"),
                        numbers<double>(name + "/x")};
    if (kind < 0) return compressed(arrays, kind == -1);
    const auto count = static_cast<std::size_t>(kind);
    if (std::min({arrays.p.size(), arrays.i.size(), arrays.x.size()}) < count)
      wrong(name, "fewer entries than nz");
    for (auto* indices : {&arrays.p, &arrays.i}) indices->resize(count);
    const bool by_csparse = arrays.fit(arrays.i, arrays.p), by_header = arrays.fit(arrays.p, arrays.i);
    const Sparse read =
        by_csparse ? triplets(arrays, arrays.i, arrays.p) : triplets(arrays, arrays.p, arrays.i);
    stored.form += fmt::format(", triplets of {} with p as {}", name, by_csparse ? "columns" : "rows");
    if (by_csparse && by_header && (rows != columns || asymmetry(read) > symmetric_within))
      stored.warnings.push_back(fmt::format(
          "the triplets of {} fit as CSparse has them, p the columns, and as fclib.h says, p the rows: p is "
          "read as columns",
          name));
    return read;
  }

 private:
  struct SparseArrays {
    std::string name;
    int rows, columns;
    std::vector<int> p, i;
    std::vector<double> x;

    bool fit(const std::vector<int>& row, const std::vector<int>& column) const {
      const auto below = [](int end) { return [=](int k) { return k >= 0 && k < end; }; };
      return std::ranges::all_of(row, below(rows)) && std::ranges::all_of(column, below(columns));
    }
  };

  [[noreturn]] void wrong(const std::string& name, const std::string& what) const {
    refuse(name + " with " + what, "a sparse matrix");
  }

  /// Of entries k at (row[k], column[k]).
  Sparse triplets(const SparseArrays& arrays, const std::vector<int>& row,
                  const std::vector<int>& column) const {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (row[k] < 0 || row[k] >= arrays.rows || column[k] < 0 || column[k] >= arrays.columns)
        wrong(arrays.name,
              fmt::format("an entry at ({}, {}) of {} x {}", row[k], column[k], arrays.rows, arrays.columns));
      entries.emplace_back(row[k], column[k], arrays.x[k]);
    }
    Sparse matrix(arrays.rows, arrays.columns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// Of lines that are columns or rows; p tells where each begins.
  Sparse compressed(const SparseArrays& arrays, bool by_columns) const {
    const auto& [name, rows, columns, p, i, x] = arrays;
    const auto lines = static_cast<std::size_t>(by_columns ? columns : rows);
    const auto stored = static_cast<int>(std::min(i.size(), x.size()));
    if (p.size() != lines + 1 || p.front() != 0 || p.back() > stored || !std::ranges::is_sorted(p))
      wrong(name, "pointers p that do not fit");
    const auto count = static_cast<std::size_t>(p.back());
    const std::vector<int> inner(i.begin(), i.begin() + p.back());
    std::vector<int> line_of(count);
    for (std::size_t line = 0; line < lines; ++line)
      std::fill(line_of.begin() + p[line], line_of.begin() + p[line + 1], static_cast<int>(line));
    return by_columns ? triplets(arrays, inner, line_of) : triplets(arrays, line_of, inner);
  }

  std::string path_;
  Hdf5Handle file_;
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
  StoredCone stored;
  stored.form = "FCLIB global, condensed";
  const Sparse m = reader.matrix(group + "/M", stored), h = reader.matrix(group + "/H", stored);
  const VectorXd f = reader.vector(group + "/vectors/f"), w = reader.vector(group + "/vectors/w");
  if (m.rows() != m.cols() || h.rows() != m.rows() || f.size() != m.rows() || w.size() != h.cols())
    reader.refuse(fmt::format("M of {} x {}, H of {} x {}, f of {} and w of {} numbers", m.rows(), m.cols(),
                              h.rows(), h.cols(), f.size(), w.size()),
                  "n x n, n x m, n and m");
  const Eigen::SimplicialLLT<Sparse> factor(Sparse(0.5 * (m + Sparse(m.transpose()))));
  if (factor.info() != Eigen::Success) reader.refuse("M that is not positive definite", "a mass matrix");
  stored.delassus = Sparse(h.transpose()) * Sparse(factor.solve(h));
  stored.free_velocity = w + h.transpose() * VectorXd(factor.solve(f));
  stored.friction = reader.vector(group + "/vectors/mu");
  return stored;
}

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
  stored.form = "FCLIB local";
  stored.delassus = reader.matrix(group + "/W", stored);
  stored.free_velocity = reader.vector(group + "/vectors/q");
  stored.friction = reader.vector(group + "/vectors/mu");
  return stored;
}

}  // namespace pbdcheck

// Block Gauss-Seidel: one constraint after the other, in the scene's order or by colours.
#pragma once

#include "linear/sweeps.h"

namespace pbd {

/// Block Gauss-Seidel in the scene's order: dp_i = -N_ii^-1 r_i, v updated at once; a contact with friction
/// goes to its own solution (`solve_contact`).
struct GaussSeidel {
  static constexpr std::string_view name = "gauss_seidel";
  static constexpr bool solves_any_rows = true;
  void begin(Rows&, const Points&, bool) {}
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);
};

/// The same in another order, on several threads: effect by effect, of each its chunks of constraints by
/// colours (rows/chunks.h), and within a chunk the scene's order. Blocks of one chunk go as by GaussSeidel.
struct ColouredGaussSeidel {
  using Reordered = GaussSeidel;
  static constexpr std::string_view name = "coloured_gauss_seidel";
  static constexpr bool solves_any_rows = true;
  void begin(Rows&, const Points&, bool) {}
  Sweep sweep(Rows& rows, Points& v, BlockSeconds seconds);
};

}  // namespace pbd

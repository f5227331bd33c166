#pragma once
// The library below libtorch that multiplies matrices.

#include "base/result.h"

namespace panache {

// To be called before libtorch computes anything: keeps the libraries from starting threads beside
// our own. OpenBLAS keeps a buffer of 128 MB of addresses for each thread that multiplies, and
// tries without end where there is no room for one; so it gets them here, or there is an error.
Result<void> prepare_matrix_products();

}  // namespace panache

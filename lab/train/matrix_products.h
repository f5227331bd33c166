#pragma once
// Prepares the matrix library below libtorch.

#include "base/result.h"

namespace panache {

// Call before libtorch computes anything: keeps the libraries from starting their own threads next
// to ours. OpenBLAS keeps a buffer of 128 MB of addresses for each multiplying thread, and retries
// forever if there is no room; this allocates the buffers now, or fails with an error.
Result<void> prepare_matrix_products();

}  // namespace panache

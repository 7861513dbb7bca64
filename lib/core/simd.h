// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Compiles a function for several instruction sets, of which the processor's best is taken when the program starts.
/// Only for code whose results are the same bits in each. Sanitizers start too late for that.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define COMPTONAUT_SIMD_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define COMPTONAUT_SIMD_CLONES
#endif

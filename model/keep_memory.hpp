// Runs follow each other, and each wants about as much memory as the one before it. The allocator
// of glibc gives it back to the kernel in between, which then clears every page anew: a tenth of
// the time of a storm. A program that runs many of them keeps some instead.
#pragma once

#include <cstdlib>  // says whether this is glibc

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace stormproof::model {

/// To be called once, when the program starts. Up to 64 MB that are free stay with the program.
inline void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
#endif
}

}  // namespace stormproof::model

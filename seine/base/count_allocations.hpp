#pragma once

#include <atomic>
#include <cstdlib>

// For tests: counts every way to get memory, in the whole program. To be included by one file of it. Under
// the sanitizers, which have their own allocator, nothing is counted.
namespace seine {
inline std::atomic<long> allocations{0};
}

#ifndef SEINE_SANITIZED
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);

// operator new ends in malloc.
void* malloc(std::size_t size) {
  ++seine::allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++seine::allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* old, std::size_t size) {
  ++seine::allocations;
  return __libc_realloc(old, size);
}
}
#endif

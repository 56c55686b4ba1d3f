#pragma once

// SEINE_WIDEST before a function: one binary serves every x86-64, the loader picks the version for the widest
// instruction set the machine has. Everything the function calls must be inlined into it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(SEINE_SANITIZED)
#define SEINE_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define SEINE_WIDEST
#endif

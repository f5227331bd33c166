#include "sandbox.h"

#include <sys/mman.h>

#ifdef PANACHE_SECCOMP
#include <cerrno>
#include <memory>

#include <seccomp.h>
#endif

namespace panache::cli {

#ifdef PANACHE_SECCOMP

bool has_lock() { return true; }

bool lock_down(int out) {
  const std::unique_ptr<void, decltype(&::seccomp_release)> rules(
      ::seccomp_init(SCMP_ACT_ERRNO(EPERM)), &::seccomp_release);
  if (!rules) return false;
  const auto allow = [&](int call) {
    return ::seccomp_rule_add(rules.get(), SCMP_ACT_ALLOW, call, 0) == 0;
  };
  // Memory, time, signals to the process itself, files that are already open, and exit.
  for (const int call :
       {SCMP_SYS(brk), SCMP_SYS(munmap), SCMP_SYS(mremap), SCMP_SYS(madvise), SCMP_SYS(futex),
        SCMP_SYS(clock_gettime), SCMP_SYS(gettimeofday), SCMP_SYS(getpid), SCMP_SYS(gettid),
        SCMP_SYS(rt_sigaction), SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn),
        SCMP_SYS(sigaltstack), SCMP_SYS(close), SCMP_SYS(fstat), SCMP_SYS(lseek), SCMP_SYS(exit),
        SCMP_SYS(exit_group)}) {
    if (!allow(call)) return false;
  }
  // No executable memory. 32-bit systems have mmap2 instead of mmap.
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mmap2), SCMP_SYS(mprotect)}) {
    if (::seccomp_rule_add(rules.get(), SCMP_ACT_ALLOW, call, 1,
                           SCMP_A2(SCMP_CMP_MASKED_EQ, PROT_EXEC, 0)) != 0) {
      return false;
    }
  }
  return ::seccomp_rule_add(rules.get(), SCMP_ACT_ALLOW, SCMP_SYS(write), 1,
                            SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(out))) == 0 &&
         ::seccomp_load(rules.get()) == 0;
}

#else

bool has_lock() { return false; }

bool lock_down(int) { return false; }

#endif

}  // namespace panache::cli

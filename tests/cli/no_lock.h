#pragma once
// The program where its processes cannot be locked away from files and networks, as in a container
// that forbids seccomp to those inside.

#include "cli/program.h"

#if defined(PANACHE_SECCOMP) && !defined(PANACHE_SANITIZED)  // Not under the sanitizers.
#include <seccomp.h>
#include <sys/prctl.h>
#endif

namespace panache::test {

// Expects a program that works on `input`, says that it cannot be locked, and writes nothing. The
// last argument is its output.
inline void expect_no_work_without_a_lock([[maybe_unused]] const ProgramTest& test,
                                          [[maybe_unused]] const Words& arguments,
                                          [[maybe_unused]] const std::string& input) {
#if defined(PANACHE_SECCOMP) && !defined(PANACHE_SANITIZED)
  const pid_t watcher = ::fork();
  if (watcher == 0) {
    scmp_filter_ctx rules = ::seccomp_init(SCMP_ACT_ALLOW);
    const bool done = rules &&
                      ::seccomp_rule_add(rules, SCMP_ACT_ERRNO(EPERM), SCMP_SYS(seccomp), 0) == 0 &&
                      ::seccomp_rule_add(rules, SCMP_ACT_ERRNO(EPERM), SCMP_SYS(prctl), 1,
                                         SCMP_A0(SCMP_CMP_EQ, PR_SET_SECCOMP)) == 0 &&
                      ::seccomp_load(rules) == 0;
    if (!done) ::_exit(77);
    const Ran ran = test.run(arguments);
    const std::string name = std::filesystem::path(PANACHE_PROGRAM).filename();
    const std::string expected =
        name + ": " + input +
        ": the process that works on it could not be locked away from files and networks; "
        "expected a system that permits seccomp, or this motion in another format\n";
    const bool good = ran.exit == 1 && ran.err == expected && ran.out.empty();
    if (!good) test.write("said.txt", std::to_string(ran.exit) + ran.err + ran.out);
    ::_exit(good ? 0 : 1);
  }
  int status = 0;
  ::waitpid(watcher, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == 77) GTEST_SKIP() << "this kernel has no filters";
  EXPECT_EQ(WEXITSTATUS(status), 0) << test.read("said.txt");
  EXPECT_FALSE(test.exists(arguments.back()));
#else
  GTEST_SKIP() << "without seccomp, or under the sanitizers";
#endif
}

}  // namespace panache::test

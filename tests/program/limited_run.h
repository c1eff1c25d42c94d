// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "program_run.h"
#include "support/own_user.h"

namespace wscvt::test {

/// The program under the limits that a machine sets.
class LimitedRun : public ProgramRun {
 protected:
  struct Limit {
    __rlimit_resource resource;
    rlim_t value;
  };

  /// Waits for its end. With `nobody` as a user without rights, who has no other process: root is
  /// not limited in the number of threads. Skips the test where the program cannot be run so.
  Outcome run_limited(const std::vector<std::string>& words, const std::vector<Limit>& limits,
                      bool nobody = false) const {
    const pid_t child = start_limited(words, limits, nobody);
    return outcome_of(child);
  }

  pid_t start_limited(const std::vector<std::string>& words, const std::vector<Limit>& limits,
                      bool nobody = false) const {
    std::vector<char*> argv = {const_cast<char*>("wscvt")};
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    if (nobody) {
      std::filesystem::permissions(folder_, std::filesystem::perms::all);
    }
    const std::string output = path("stdout.txt");
    const std::string errors = path("stderr.txt");
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(folder_.c_str()) != 0) _exit(99);
    if (std::freopen(output.c_str(), "w", stdout) == nullptr) _exit(97);
    if (std::freopen(errors.c_str(), "w", stderr) == nullptr) _exit(97);
    if (nobody && !become_own_user()) _exit(96);
    for (const Limit& limit : limits) {
      const rlimit both = {limit.value, limit.value};
      if (setrlimit(limit.resource, &both) != 0) _exit(95);
    }
    execv(WSCVT_PROGRAM, argv.data());
    _exit(98);
  }

  Outcome outcome_of(pid_t child) const {
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content("stdout.txt"),
            content("stderr.txt")};
  }

  /// Names of the files that writing leaves when it is broken off.
  std::vector<std::string> parts() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
      const std::string name = entry.path().filename().string();
      if (name.find(".part") != std::string::npos) names.push_back(name);
    }
    return names;
  }
};

}  // namespace wscvt::test

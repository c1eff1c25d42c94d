// SPDX-License-Identifier: GPL-3.0-or-later
// Starts a program of Windows in its own console, waits for FILE, presses Ctrl-C, and returns its
// exit code.
//   press_ctrl_c.exe FILE PROGRAM ARGUMENTS...
#include <windows.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  if (argc < 3) return 250;
  std::string call;
  for (int k = 2; k < argc; ++k) call += std::string(k == 2 ? "\"" : " \"") + argv[k] + "\"";
  STARTUPINFOA start{};
  start.cb = sizeof start;
  PROCESS_INFORMATION process{};
  if (CreateProcessA(nullptr, call.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &start,
                     &process) == 0) {
    std::fprintf(stderr, "%s cannot be started: %lu\n", argv[2], GetLastError());
    return 251;
  }
  while (GetFileAttributesA(argv[1]) == INVALID_FILE_ATTRIBUTES &&
         WaitForSingleObject(process.hProcess, 10) == WAIT_TIMEOUT) {
  }
  // From now on only the other program hears it.
  SetConsoleCtrlHandler(nullptr, TRUE);
  if (GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0) == 0) {
    std::fprintf(stderr, "There is no Ctrl-C: %lu\n", GetLastError());
    return 252;
  }
  WaitForSingleObject(process.hProcess, INFINITE);
  DWORD code = 253;
  GetExitCodeProcess(process.hProcess, &code);
  return static_cast<int>(code);
}

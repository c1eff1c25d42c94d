// SPDX-License-Identifier: GPL-3.0-or-later
#include "program/terminal/terminal.h"

#ifdef _WIN32
#include <windows.h>
// The header above comes first.
#include <io.h>

#include <atomic>
#endif
#include <fcntl.h>
#ifndef _WIN32
#include <sys/ioctl.h>
#endif
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>

#include "wscvt/base/text.h"

namespace wscvt::program {

#ifdef _WIN32

StandardStreams::StandardStreams() : code_page_(GetConsoleOutputCP()) {
  for (const int stream : {0, 1, 2}) {
    if (_get_osfhandle(stream) < 0) _open("NUL", stream == 0 ? _O_WRONLY : _O_RDONLY);
    // The same bytes as on other systems, also in a file or a pipe.
    _setmode(stream, _O_BINARY);
  }
  if (code_page_ != 0) SetConsoleOutputCP(CP_UTF8);
  const HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  constexpr DWORD takes_escapes = 4;  // ENABLE_VIRTUAL_TERMINAL_PROCESSING
  if (GetConsoleMode(console, &mode) != 0) SetConsoleMode(console, mode | takes_escapes);
}

StandardStreams::~StandardStreams() {
  if (code_page_ != 0) SetConsoleOutputCP(code_page_);
}

namespace {

// Windows calls the function below in a thread of its own.
std::atomic<int> noted = 0;

BOOL WINAPI note(DWORD event) {
  const int number = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT ? SIGINT : SIGTERM;
  // After the second one, Windows ends the program.
  if (int none = 0; !noted.compare_exchange_strong(none, number)) return FALSE;
  // When a console is closed, the program ends with this function. It has five seconds.
  if (number == SIGTERM) Sleep(5000);
  return TRUE;
}

}  // namespace

void note_signals() { SetConsoleCtrlHandler(note, TRUE); }

void ignore_file_size_signal() {}

namespace {

/// Returns the columns of a stream's terminal; negative if it has none, 0 if they are unknown.
int asked_columns(int stream) {
  CONSOLE_SCREEN_BUFFER_INFO console;
  const auto handle = reinterpret_cast<HANDLE>(_get_osfhandle(stream));
  if (GetConsoleScreenBufferInfo(handle, &console) == 0) return -1;
  return console.srWindow.Right - console.srWindow.Left + 1;
}

}  // namespace

#else

StandardStreams::StandardStreams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // open returns the lowest free number, which is this one. The mode is the wrong one for its
    // use.
    if (open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY) != stream) return;
  }
}

StandardStreams::~StandardStreams() = default;

namespace {

// A signal handler can only store into such a variable.
volatile std::sig_atomic_t noted = 0;

void note(int number) { noted = number; }

}  // namespace

void note_signals() {
  struct sigaction action {};
  action.sa_handler = note;
  sigemptyset(&action.sa_mask);
  // No restart, so that a wait for a pipe without a reader also ends.
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    // The limit of CPU time sends its signal every second, until the program ends.
    action.sa_flags = number == SIGXCPU ? 0 : static_cast<int>(SA_RESETHAND);
    struct sigaction before {};
    // If the program was started with a signal ignored (nohup, a shell's background), it stays
    // ignored.
    if (sigaction(number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(number, &action, nullptr);
  }
}

void ignore_file_size_signal() { std::signal(SIGXFSZ, SIG_IGN); }

namespace {

/// Returns the columns of a stream's terminal; negative if it has none, 0 if they are unknown.
int asked_columns(int stream) {
  if (isatty(stream) != 1) return -1;
  winsize size{};
  return ioctl(stream, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

#endif

int noted_signal() { return noted; }

std::size_t terminal_columns(Stream stream) {
  const int asked = asked_columns(static_cast<int>(stream));
  if (asked < 0) return 0;
  const char* const given = std::getenv("COLUMNS");
  const int columns = given == nullptr ? 0 : std::atoi(given);
  if (columns > 0) return static_cast<std::size_t>(columns);
  return asked > 0 ? static_cast<std::size_t>(asked) : 80;
}

std::string wrapped(std::string_view line, std::size_t width, std::size_t indent) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  std::string result(begin, ' ');
  line.remove_prefix(begin);
  std::size_t used = begin;  // characters in the last line
  bool is_begin = true;      // no word in the last line yet
  while (!line.empty()) {
    const std::size_t end = std::min(line.find(' '), line.size());
    if (!is_begin && used + 1 + end > width) {
      result.erase(result.find_last_not_of(' ') + 1);
      result += '\n' + std::string(indent, ' ');
      used = indent;
      is_begin = true;
    }
    if (!is_begin) result += ' ';
    if (!is_begin) ++used;
    result += line.substr(0, end);
    used += end;
    is_begin = is_begin && end == 0;
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return result;
}

namespace {

/// Returns the place behind the next gap of several spaces between words; npos if there is none.
std::size_t behind_gap(std::string_view line, std::size_t from) {
  return line.find_first_not_of(' ', line.find("  ", line.find_first_not_of(' ', from)));
}

/// A line of a log is "topic       text". Text below text begins where it does.
std::string broken(std::string_view line, std::size_t width) {
  if (line.size() <= width) return std::string(line);
  constexpr std::size_t widest_topic = 20;
  const std::size_t text = behind_gap(line, 0);
  const bool has_topic = text <= widest_topic;
  // Rows of a table have more gaps, or one behind a long label.
  const bool is_row = text != std::string_view::npos &&
                      (!has_topic || behind_gap(line, text) != std::string_view::npos);
  if (is_row) return std::string(line);
  if (!has_topic || 2 * text > width) {
    return wrapped(line, width, std::min(line.find_first_not_of(' '), line.size()) + 2);
  }
  std::string result = wrapped(std::string(text, ' ').append(line.substr(text)), width, text);
  return result.replace(0, text, line.substr(0, text));
}

}  // namespace

std::string shown_on(Stream stream, std::string_view text) {
  constexpr std::size_t narrowest = 20;
  constexpr std::size_t widest = 80;
  const std::size_t columns = terminal_columns(stream);
  if (columns == 0) return std::string(text);
  const std::size_t width = std::clamp(columns, narrowest, widest);
  std::string result;
  while (true) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    result += broken(text.substr(0, end), width);
    if (end == text.size()) return result;
    result += '\n';
    text.remove_prefix(end + 1);
  }
}

void print_error(std::string_view sentence) {
  std::fputs((shown_on(Stream::Error, readable(sentence)) + "\n").c_str(), stderr);
}

ProgressLine::ProgressLine(bool wanted) : is_shown_(wanted && isatty(STDERR_FILENO) == 1) {}

void ProgressLine::show(double fraction, const std::string& stage) {
  if (!is_shown_) return;
  const std::string text =
      std::to_string(static_cast<int>(100.0 * fraction)) + " %  " + wscvt::readable(stage, "");
  if (text == drawn_) return;
  // Carriage return, the text, and the rest of the line cleared.
  std::fprintf(stderr, "\r%s\033[K", text.c_str());
  std::fflush(stderr);
  drawn_ = text;
}

void ProgressLine::clear() {
  if (!is_shown_ || drawn_.empty()) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  drawn_.clear();
}

}  // namespace wscvt::program

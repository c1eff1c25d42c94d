// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QProcess>
#include <QSize>
#include <QString>
#include <QStringList>
#include <QTemporaryDir>
#include <functional>
#include <map>
#include <string>

namespace wscvt::host_test {

/// An X server without a screen, of width x height pixels, on a display number of its own choice.
/// Throws std::runtime_error when it does not start.
class VirtualDisplay {
 public:
  explicit VirtualDisplay(const QSize& size = QSize(1280, 1000));
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  QString name() const { return name_; }

 private:
  QProcess server_;
  QString name_;
};

/// Environment for a program on that display, with settings of its own in `home`.
QProcessEnvironment environment_on(const VirtualDisplay& display, const QString& home);

/// Of meshlabserver, when a filter returns false.
constexpr int exit_code_of_refusal = 255;

/// How a program ended.
struct Outcome {
  bool ended = false;    ///< within the time allowed
  bool crashed = false;  ///< by a signal, so also by a failed assertion
  int exit_code = 0;
  QString output;  ///< standard output and standard error
};

/// Runs the staged meshlabserver to its end, on a display of its own, in `folder`.
Outcome run_meshlabserver(const QStringList& arguments, const QString& folder);

/// Path of a script of the project, e.g. "wscvt_d.mlx".
QString script_path(const QString& name);

/// Writes a script of the project with other values for some of its parameters. Throws
/// std::runtime_error for a parameter that the script does not hold.
void write_script(const std::map<std::string, std::string>& values, const QString& path,
                  const QString& original = "wscvt_d.mlx");

/// Polls until the condition holds; false when `seconds` have passed.
bool wait_until(const std::function<bool()>& condition, double seconds);

}  // namespace wscvt::host_test

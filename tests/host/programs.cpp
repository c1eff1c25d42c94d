// SPDX-License-Identifier: GPL-3.0-or-later
#include "programs.h"

#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QRegularExpression>
#include <QThread>
#include <stdexcept>

namespace wscvt::host_test {

namespace {

constexpr int start_milliseconds = 60000;
constexpr int run_milliseconds = 300000;

}  // namespace

VirtualDisplay::VirtualDisplay(const QSize& size) {
  // -displayfd: the server finds a free number and tells it when it is ready.
  server_.start(
      QStringLiteral(XVFB_EXECUTABLE),
      {"-displayfd", "1", "-screen", "0",
       QStringLiteral("%1x%2x24").arg(size.width()).arg(size.height()), "-nolisten", "tcp"});
  while (!server_.canReadLine()) {
    if (!server_.waitForReadyRead(start_milliseconds)) {
      throw std::runtime_error("Xvfb does not start: " +
                               server_.readAllStandardError().toStdString());
    }
  }
  name_ = ":" + QString::fromLatin1(server_.readLine()).trimmed();
}

VirtualDisplay::~VirtualDisplay() {
  server_.terminate();
  if (!server_.waitForFinished(10000)) server_.kill();
  server_.waitForFinished(10000);
}

QProcessEnvironment environment_on(const VirtualDisplay& display, const QString& home) {
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  const QString runtime = home + "/runtime";
  QDir().mkpath(runtime);
  QFile::setPermissions(runtime, QFile::ReadOwner | QFile::WriteOwner | QFile::ExeOwner);
  environment.remove("QT_QPA_PLATFORM");
  environment.remove("WAYLAND_DISPLAY");
  environment.insert("DISPLAY", display.name());
  environment.insert("HOME", home);
  environment.insert("XDG_CONFIG_HOME", home + "/config");
  environment.insert("XDG_RUNTIME_DIR", runtime);
  // The same letters on every machine, whatever fonts it has.
  const QString fonts = home + "/fonts.conf";
  QFile file(fonts);
  if (!file.open(QIODevice::WriteOnly)) throw std::runtime_error("The fonts' file is not writable");
  file.write(
      ("<fontconfig><dir>/usr/share/fonts/truetype/dejavu</dir><cachedir>" + home +
       "/fonts</cachedir>"
       "<alias><family>courier</family><prefer><family>DejaVu Sans Mono</family></prefer></alias>"
       "<alias><family>sans-serif</family><prefer><family>DejaVu Sans</family></prefer></alias>"
       "<alias><family>monospace</family><prefer><family>DejaVu Sans Mono</family></prefer></alias>"
       "</fontconfig>\n")
          .toUtf8());
  environment.insert("FONTCONFIG_FILE", fonts);
  environment.insert("LIBGL_ALWAYS_SOFTWARE", "1");
  // Debian unstable's meshlab does not find its library without help.
  environment.insert("LD_LIBRARY_PATH", QStringLiteral(WSCVT_MESHLAB_LIBRARY_DIR));
  environment.insert("LC_ALL", "C.UTF-8");
  return environment;
}

Outcome run_meshlabserver(const QStringList& arguments, const QString& folder) {
  const VirtualDisplay display;
  QProcess program;
  program.setProcessEnvironment(environment_on(display, folder));
  program.setWorkingDirectory(folder);
  program.setProcessChannelMode(QProcess::MergedChannels);
  program.start(QStringLiteral(WSCVT_STAGE_DIR "/bin/meshlabserver"), arguments);
  Outcome outcome;
  outcome.ended = program.waitForFinished(run_milliseconds);
  if (!outcome.ended) {
    program.kill();
    program.waitForFinished(10000);
  }
  outcome.crashed = program.exitStatus() != QProcess::NormalExit;
  outcome.exit_code = program.exitCode();
  outcome.output = QString::fromUtf8(program.readAll());
  return outcome;
}

QString script_path(const QString& name) { return QStringLiteral(WSCVT_SCRIPTS_DIR "/") + name; }

void write_script(const std::map<std::string, std::string>& values, const QString& path,
                  const QString& original) {
  QFile file(script_path(original));
  if (!file.open(QIODevice::ReadOnly)) {
    throw std::runtime_error(original.toStdString() + " is not there");
  }
  QString script = QString::fromUtf8(file.readAll());
  for (const auto& [name, value] : values) {
    const QRegularExpression parameter(
        QStringLiteral("<Param name=\"%1\" type=\"\\w+\" value=\"([^\"]*)")
            .arg(QString::fromStdString(name)));
    const QRegularExpressionMatch match = parameter.match(script);
    if (!match.hasMatch()) {
      throw std::runtime_error(original.toStdString() + " has no parameter " + name);
    }
    script.replace(match.capturedStart(1), match.capturedLength(1), QString::fromStdString(value));
  }
  QFile changed(path);
  if (!changed.open(QIODevice::WriteOnly)) throw std::runtime_error("The script is not writable");
  changed.write(script.toUtf8());
}

bool wait_until(const std::function<bool()>& condition, double seconds) {
  QElapsedTimer timer;
  timer.start();
  while (!condition()) {
    if (static_cast<double>(timer.elapsed()) > 1000.0 * seconds) return false;
    QThread::msleep(100);
  }
  return true;
}

}  // namespace wscvt::host_test

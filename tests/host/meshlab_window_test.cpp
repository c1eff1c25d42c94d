// SPDX-License-Identifier: GPL-3.0-or-later
// The real meshlab in a window on a virtual display, driven by keys and clicks as a person would.
// Each step waits for what it should bring about: a window's title, or a line of MeshLab's log.
#include <common/interfaces.h>
#include <common/pluginmanager.h>
#include <gtest/gtest.h>

#include <QDomDocument>
#include <QFile>
#include <QThread>

#include "programs.h"
#include "sample_meshes.h"
#include "wscvt/scan/mesh_io.h"

namespace wscvt::host_test {
namespace {

const QString filter_menu_text = "Remeshing: Weighted Spherical Centroidal Voronoi";
constexpr double patience = 60.0;  // seconds for any one step

/// Entries of the Filters menu below "Remeshing, Simplification and Reconstruction".
constexpr int entries_after_remeshing = 12;

/// Place of the filter in its submenu, 0 first, by the rule with which MeshLab fills its menus.
int place_in_submenu() {
  PluginManager plugins;
  RichParameterList settings;
  plugins.loadPlugins(settings, QDir(QStringLiteral(WSCVT_PLUGIN_DIR)));
  int place = 0;
  for (auto entry = plugins.actionFilterMap.begin(); entry != plugins.actionFilterMap.end();
       ++entry) {
    if (entry.key() == filter_menu_text) return place;
    auto* filter = qobject_cast<MeshFilterInterface*>(entry.value()->parent());
    if ((filter->getClass(entry.value()) & MeshFilterInterface::Remeshing) != 0) ++place;
  }
  return -1;
}

/// MeshLab with one mesh open.
class Window {
 public:
  Window(const QString& scan, const QString& folder)
      : environment_(environment_on(display_, folder)) {
    meshlab_.setProcessEnvironment(environment_);
    meshlab_.setProcessChannelMode(QProcess::MergedChannels);
    meshlab_.start(QStringLiteral(WSCVT_STAGE_DIR "/bin/meshlab"), {scan});
  }

  ~Window() {
    meshlab_.kill();
    meshlab_.waitForFinished(10000);
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  QString log() {
    meshlab_.waitForReadyRead(1);
    log_ += QString::fromUtf8(meshlab_.readAll());
    return log_;
  }

  bool is_running() const { return meshlab_.state() == QProcess::Running; }

  bool wait_for_log(const QString& words) {
    return wait_until([&] { return log().contains(words); }, patience);
  }

  /// Identifier of the visible window with these words in its title; empty when there is none.
  QString window(const QString& title) {
    return xdotool({"search", "--onlyvisible", "--name", title}).section('\n', 0, 0);
  }

  bool wait_for_window(const QString& title, double seconds = patience) {
    return wait_until([&] { return !window(title).isEmpty(); }, seconds);
  }

  void focus(const QString& title) {
    xdotool({"windowfocus", "--sync", window(title)});
    QThread::msleep(200);
  }

  void fill_screen(const QString& title) {
    xdotool({"windowmove", window(title), "0", "0"});
    xdotool({"windowsize", window(title), "1280", "1000"});
    QThread::msleep(500);
  }

  void press(const QString& key, int times = 1) {
    for (int k = 0; k < times; ++k) {
      xdotool({"key", key});
      QThread::msleep(30);
    }
  }

  void type(const QString& text) { xdotool({"type", "--delay", "20", text}); }

  /// Clicks a window at a share of its width and a distance from its lower edge.
  void click(const QString& title, double across, int above_bottom) {
    const QString id = window(title);
    int width = 0;
    int height = 0;
    for (const QString& line : xdotool({"getwindowgeometry", "--shell", id}).split('\n')) {
      if (line.startsWith("WIDTH=")) width = line.section('=', 1).toInt();
      if (line.startsWith("HEIGHT=")) height = line.section('=', 1).toInt();
    }
    xdotool({"mousemove", "--window", id, QString::number(static_cast<int>(across * width)),
             QString::number(height - above_bottom)});
    QThread::msleep(200);
    xdotool({"click", "1"});
  }

  void screenshot(const QString& name) {
    run(QStringLiteral(IMPORT_EXECUTABLE),
        {"-window", "root", QStringLiteral(WSCVT_SCREENSHOT_DIR "/") + name});
  }

  /// Opens the filter's dialog through the menus; false when it does not come up.
  bool open_filter(int place) {
    for (int attempt = 0; attempt < 3; ++attempt) {
      press("Escape", 3);
      focus(main_title);
      press("alt+l");  // Filters
      QThread::msleep(700);
      // The first entry that is on is selected; the next one up is the last.
      press("Up", 1 + entries_after_remeshing);
      QThread::msleep(300);
      press("Right");
      QThread::msleep(700);
      press("Down", place);
      QThread::msleep(300);
      screenshot("menu.png");
      press("Return");
      if (wait_for_window(filter_menu_text, 10.0)) return true;
    }
    return false;
  }

  void apply_filter() { click(filter_menu_text, 0.75, 22); }

  const QString main_title = "^MeshLab 2020.09";

 private:
  QString run(const QString& program, const QStringList& arguments) {
    QProcess process;
    process.setProcessEnvironment(environment_);
    process.start(program, arguments);
    process.waitForFinished(20000);
    return QString::fromUtf8(process.readAllStandardOutput()).trimmed();
  }

  QString xdotool(const QStringList& arguments) {
    return run(QStringLiteral(XDOTOOL_EXECUTABLE), arguments);
  }

  VirtualDisplay display_;
  QProcessEnvironment environment_;
  QProcess meshlab_;
  QString log_;
};

TEST(Window, MenuEntryAddsALayerThatIsSavedWithTheProject) {
  const QString scan = sample("sand_7228.ply");
  ASSERT_TRUE(QFile::exists(scan)) << scan.toStdString();
  const int place = place_in_submenu();
  ASSERT_GE(place, 0);
  QTemporaryDir folder;
  Window meshlab(scan, folder.path());
  ASSERT_TRUE(meshlab.wait_for_log("All files opened")) << meshlab.log().toStdString();
  ASSERT_TRUE(meshlab.wait_for_window(meshlab.main_title));
  meshlab.fill_screen(meshlab.main_title);

  ASSERT_TRUE(meshlab.open_filter(place)) << meshlab.log().toStdString();
  meshlab.screenshot("dialog.png");
  meshlab.apply_filter();
  ASSERT_TRUE(meshlab.wait_for_log("Applied filter " + filter_menu_text))
      << meshlab.log().toStdString();
  meshlab.click(filter_menu_text, 0.25, 22);  // Close
  meshlab.screenshot("result.png");

  // Saving the project first asks for a file for each layer that has none, by the layer's name.
  meshlab.focus(meshlab.main_title);
  meshlab.press("ctrl+s");
  ASSERT_TRUE(meshlab.wait_for_window("Save \"sand_7228 WSCVT-D 1000\" Layer"))
      << meshlab.log().toStdString();
  const QString layer_file = folder.filePath("layer.ply");
  meshlab.focus("Save \"sand_7228");
  meshlab.type(layer_file);
  meshlab.press("Return");
  ASSERT_TRUE(meshlab.wait_for_window("Choose Saving Options"));
  meshlab.focus("Choose Saving Options");
  meshlab.press("Return");
  ASSERT_TRUE(meshlab.wait_for_window("Save Project File"));
  const QString project_file = folder.filePath("project.mlp");
  meshlab.focus("Save Project File");
  meshlab.type(project_file);
  meshlab.press("Return");
  ASSERT_TRUE(wait_until([&] { return QFile(project_file).size() > 0; }, patience));
  QThread::msleep(500);

  const IndexedMesh mesh = read_mesh(layer_file.toStdString());
  EXPECT_EQ(mesh.points.size(), 1000U);
  EXPECT_EQ(mesh.triangles.size(), 2U * 1000U - 4U);
  QFile file(project_file);
  ASSERT_TRUE(file.open(QIODevice::ReadOnly));
  QDomDocument project;
  ASSERT_TRUE(project.setContent(&file));
  const QDomNodeList layers = project.elementsByTagName("MLMesh");
  ASSERT_EQ(layers.count(), 2);
  EXPECT_TRUE(layers.at(0).toElement().attribute("label").startsWith("sand_7228"));
  EXPECT_EQ(layers.at(1).toElement().attribute("label").toStdString(), "sand_7228 WSCVT-D 1000");
  EXPECT_TRUE(meshlab.is_running());
}

TEST(Window, RefusalShowsAMessageAndMeshLabGoesOn) {
  const int place = place_in_submenu();
  ASSERT_GE(place, 0);
  QTemporaryDir folder;
  const QString scan = folder.filePath("open.ply");
  write_as_it_is(without_a_patch(), scan);
  Window meshlab(scan, folder.path());
  ASSERT_TRUE(meshlab.wait_for_log("All files opened")) << meshlab.log().toStdString();
  ASSERT_TRUE(meshlab.wait_for_window(meshlab.main_title));
  meshlab.fill_screen(meshlab.main_title);
  ASSERT_TRUE(meshlab.open_filter(place)) << meshlab.log().toStdString();
  meshlab.apply_filter();
  ASSERT_TRUE(meshlab.wait_for_window("Filter Failure")) << meshlab.log().toStdString();
  meshlab.screenshot("refusal.png");
  meshlab.focus("Filter Failure");
  meshlab.press("Return");
  ASSERT_TRUE(meshlab.wait_for_log("Filter failed:")) << meshlab.log().toStdString();
  EXPECT_TRUE(meshlab.log().contains("boundary", Qt::CaseInsensitive))
      << meshlab.log().toStdString();
  EXPECT_TRUE(meshlab.is_running());
}

}  // namespace
}  // namespace wscvt::host_test

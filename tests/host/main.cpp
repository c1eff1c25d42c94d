// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <QApplication>

#ifdef __SANITIZE_ADDRESS__
// What Qt's platform plugin and MeshLab keep until the process ends is not this project's to free;
// leaks of our own code, called straight from the tests, have no frame in these libraries.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libQt5\nleak:libqoffscreen\nleak:libmeshlab-common\nleak:libfontconfig\n";
}
#endif

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  // The filter lives in this process without a display; the programs it starts get one each.
  qputenv("QT_QPA_PLATFORM", "offscreen");
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}

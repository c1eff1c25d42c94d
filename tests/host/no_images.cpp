// SPDX-License-Identifier: GPL-3.0-or-later
// What documents of MeshLab link to for reading and writing images, which no test does.
#include <common/utilities/load_save.h>

#include <stdexcept>

namespace meshlab {

QImage loadImage(const QString& /*filename*/, GLLogStream* /*log*/,
                 vcg::CallBackPos* /*callback*/) {
  throw std::logic_error("The tests read no images.");
}

void saveImage(const QString& /*filename*/, const QImage& /*image*/, int /*quality*/,
               GLLogStream* /*log*/, vcg::CallBackPos* /*callback*/) {
  throw std::logic_error("The tests write no images.");
}

}  // namespace meshlab

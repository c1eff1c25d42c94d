#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Links MeshLab's own plugins into another folder, if their libraries are installed.
#   link_plugins.sh MESHLAB_LIBRARY_FOLDER FOLDER
set -eu
export LD_LIBRARY_PATH="$1"
for plugin in "$1"/plugins/*.so; do
  ldd "$plugin" | grep -q 'not found' || ln -s "$plugin" "$2"
done

#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes build/windows-libraries: what wscvt.exe is linked of. Debian has zlib for Windows only. The others are built
# from Debian's sources. ITK and HDF5 are left out, because their builds run programs of Windows and take an hour.
#   packages/windows/libraries.sh
# Needs g++-mingw-w64-x86-64-posix and libz-mingw-w64-dev. The folder appears whole, by a rename.
set -eu
here=$(realpath "$(dirname "$0")")
root=$(realpath "$here/../..")
folder=$root/build/windows-libraries
[ ! -d "$folder" ] || exit 0
sources=$root/build/windows-sources
part=$folder.part
rm -rf "$part"
mkdir -p "$part/include" "$part/lib/pkgconfig" "$part/lib/cmake" "$part/work"
host=x86_64-w64-mingw32
for package in openmesh zlib lz4 libpng1.6 tiff expat nifticlib; do
  "$root/packages/debian_source.sh" $package "$sources/$package"
done

# Headers that are the same on every machine. The others of /usr/include are of this one.
for name in eigen3 boost CGAL nlohmann CLI stb; do
  ln -s "/usr/include/$name" "$part/include/$name"
done
cp /usr/$host/lib/libz.a "$part/lib"
cp /usr/$host/include/zlib.h /usr/$host/include/zconf.h "$part/include"

archive() {  # NAME FLAGS FILES...
  name=$1
  flags=$2
  shift 2
  mkdir "$part/work/$name"
  for file in "$@"; do
    case $file in *.c) compiler=$host-gcc-posix ;; *) compiler=$host-g++-posix ;; esac
    # shellcheck disable=SC2086
    $compiler -O2 -w -I "$part/include" $flags -c "$file" -o "$part/work/$name/$(basename "$file").o"
  done
  $host-ar rcs "$part/lib/lib$name.a" "$part/work/$name"/*.o
}
describe() {  # NAME LIBRARY
  printf 'Name: %s\nDescription: %s\nVersion: 1\nLibs: -L%s -l%s\nCflags: -I%s\n' "$1" "$1" "$folder/lib" "$2" \
    "$folder/include" > "$part/lib/pkgconfig/$1.pc"
}
cd "$sources"
# Without OpenMesh's readers of files, which nothing asks for.
(
  cd openmesh/src/OpenMesh
  archive OpenMeshCore "-I$sources/openmesh/src" Core/Mesh/*.cc Core/Utils/BaseProperty.cc Core/Utils/Endian.cc \
    Core/System/omstream.cc
  mkdir "$part/include/OpenMesh"
  find Core Tools \( -name '*.h' -o -name '*.hh' -o -name '*.inl' \) -exec cp --parents -t "$part/include/OpenMesh" {} +
)
archive lz4 "" lz4/lib/*.c
cp lz4/lib/*.h "$part/include"
describe liblz4 lz4
archive minizip -Izlib/contrib/minizip zlib/contrib/minizip/unzip.c zlib/contrib/minizip/ioapi.c
cp zlib/contrib/minizip/unzip.h zlib/contrib/minizip/ioapi.h "$part/include"
describe minizip minizip
nifti=$(dirname "$(find nifticlib -name nifti2_io.c)")
znz=$(dirname "$(find nifticlib -name znzlib.c)")
nifti1=$(dirname "$(find nifticlib -name nifti1.h | head -n 1)")
archive nifti2 "-DHAVE_ZLIB -I$nifti -I$nifti1 -I$znz" "$nifti/nifti2_io.c" "$znz/znzlib.c"
mkdir "$part/include/nifti"
cp "$nifti"/*.h "$znz"/*.h "$part/include/nifti"

built() {  # FOLDER OPTIONS...
  source=$sources/$1
  name=$(basename "$1")
  shift
  cmake -S "$source" -B "$part/work/$name" -G Ninja -DCMAKE_TOOLCHAIN_FILE="$here/toolchain.cmake" \
    -DCMAKE_FIND_ROOT_PATH="$part" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$part" \
    -DBUILD_SHARED_LIBS=OFF -DZLIB_LIBRARY="$part/lib/libz.a" -DZLIB_INCLUDE_DIR="$part/include" "$@" \
    > "$part/work/$name.log" 2>&1
  cmake --build "$part/work/$name" -j "${JOBS:-$(nproc)}" --target install >> "$part/work/$name.log" 2>&1
}
built libpng1.6 -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF
built tiff -Dtiff-tools=OFF -Dtiff-tests=OFF -Dtiff-contrib=OFF -Dtiff-docs=OFF -Dcxx=OFF -Djpeg=OFF -Dold-jpeg=OFF \
  -Djbig=OFF -Dlerc=OFF -Dlzma=OFF -Dzstd=OFF -Dwebp=OFF -Dlibdeflate=OFF
built expat/expat -DEXPAT_SHARED_LIBS=OFF -DEXPAT_BUILD_TOOLS=OFF -DEXPAT_BUILD_TESTS=OFF -DEXPAT_BUILD_EXAMPLES=OFF \
  -DEXPAT_BUILD_DOCS=OFF

# What CMake looks for by the name of a package.
package() {  # NAME TEXT
  mkdir -p "$part/lib/cmake/$1"
  echo "$2" > "$part/lib/cmake/$1/$1Config.cmake"
}
header='INTERFACE IMPORTED)
set_target_properties('
of_headers() {  # NAME TARGET FOLDER OTHERS
  package "$1" "add_library($2 $header$2 PROPERTIES INTERFACE_INCLUDE_DIRECTORIES \"$folder/$3\" $4)"
}
of_headers Eigen3 Eigen3::Eigen include/eigen3 ""
of_headers nlohmann_json nlohmann_json::nlohmann_json include ""
of_headers CLI11 CLI11::CLI11 include ""
of_headers CGAL CGAL::CGAL include 'INTERFACE_COMPILE_OPTIONS -frounding-math
  INTERFACE_COMPILE_DEFINITIONS "CGAL_DISABLE_GMP;CGAL_HEADER_ONLY=1;CGAL_NDEBUG"'
package OpenMesh "add_library(OpenMeshCore STATIC IMPORTED)
set_target_properties(OpenMeshCore PROPERTIES IMPORTED_LOCATION \"$folder/lib/libOpenMeshCore.a\"
  INTERFACE_INCLUDE_DIRECTORIES \"$folder/include\")
add_library(OpenMeshTools INTERFACE IMPORTED)"
rm -rf "$part/work"
mv -T "$part" "$folder"
echo "The libraries are in $folder."

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "wscvt/base/indexed_mesh.h"

namespace wscvt::test {

/// A sand grain with any number of vertices, from 4 to millions: its formula on a Fibonacci
/// lattice, with scanner noise of a tenth of the spacing. Cheaper to make than a simulated scan of
/// that size, and as closed and uneven to the remesher.
IndexedMesh dense_grain(int vertices);

}  // namespace wscvt::test

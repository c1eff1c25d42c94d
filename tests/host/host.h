// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The version of MeshLab that a test program plays: WSCVT_HOST_HEADER, "host_2020_09.h" or another.
#include WSCVT_HOST_HEADER

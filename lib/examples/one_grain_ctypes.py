#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Remeshes a scan to 500 nodes by the interface for C, from any Python 3, without a module of wscvt.

    one_grain_ctypes.py LIBRARY SCAN OUTPUT

LIBRARY is libwscvt_c.so, or wscvt_c.dll on Windows.
"""
import ctypes
import sys

wscvt = ctypes.CDLL(sys.argv[1])
wscvt.wscvt_new.restype = ctypes.c_void_p
wscvt.wscvt_message.restype = ctypes.c_char_p
wscvt.wscvt_positions.restype = ctypes.POINTER(ctypes.c_double)
wscvt.wscvt_node_count.restype = ctypes.c_size_t
PROGRESS = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_double, ctypes.c_char_p, ctypes.c_void_p)


def done(outcome):
    if outcome != 0:
        sys.exit(wscvt.wscvt_message(grain).decode())


@PROGRESS
def show(fraction, stage, _):
    print(f"{100 * fraction:3.0f} %  {stage.decode()}")
    return 1  # 0 cancels


grain = ctypes.c_void_p(wscvt.wscvt_new())
wscvt.wscvt_set_progress(grain, show, None)
done(wscvt.wscvt_read_scan(grain, sys.argv[2].encode()))
done(wscvt.wscvt_set_option(grain, b"nodes", b"500"))
done(wscvt.wscvt_run(grain, 0))
x = wscvt.wscvt_positions(grain)[0 : 3 * wscvt.wscvt_node_count(grain) : 3]
print(f"{len(x)} nodes, x from {min(x)} to {max(x)}")
done(wscvt.wscvt_write_mesh(grain, sys.argv[3].encode()))
wscvt.wscvt_free(grain)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Labels of an array of grey values: those of the program."""
import os
import subprocess
import warnings
import zlib

import numpy as np
import pytest

import wscvt


def scan_of_balls():
    """Grey values (nz, ny, nx) of two balls that touch, one alone and one of a second mineral."""
    z, y, x = np.indices((34, 36, 70)) + 0.5
    grey = np.full(z.shape, 60.0)
    for middle, radius, value in (((14, 17, 16), 9, 150), ((31, 18, 17), 9, 150), ((54, 9, 9), 7, 150),
                                  ((55, 26, 25), 8, 230)):
        grey[(x - middle[0]) ** 2 + (y - middle[1]) ** 2 + (z - middle[2]) ** 2 < radius ** 2] = value
    grey += np.random.default_rng(3).normal(0, 6, grey.shape)
    return np.round(grey).astype(np.uint16)


@pytest.mark.parametrize("given, call, grains", [
    ({}, [], 4), ({"phases": 1}, ["--phases", "1"], 1), ({"separate": 0, "smallest": 50},
                                                         ["--separate", "0", "--smallest", "50"], 3)])
def test_segment_gives_the_labels_of_the_program(tmp_path, given, call, grains):
    scan = scan_of_balls()
    np.save(tmp_path / "scan.npy", scan)
    subprocess.run([os.environ["WSCVT_PROGRAM"], "segment", "scan.npy", "labels.mha", "-q", "--voxel-size", "0.5,0.5,0.75"]
                   + call, cwd=tmp_path, check=True)
    with open(tmp_path / "labels.mha", "rb") as file:
        header, data = file.read().split(b"ElementDataFile = LOCAL\n", 1)
    theirs = np.frombuffer(zlib.decompress(data), "<u2").reshape(scan.shape)
    assert b"MET_USHORT" in header
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        result = wscvt.segment(scan, (0.5, 0.5, 0.75), **given)
    # Three peaks are told as long as nobody has chosen.
    assert any("3 peaks" in str(warning.message) for warning in told) == ("phases" not in given)
    np.testing.assert_array_equal(result["labels"], theirs)
    assert result["grains"] == result["labels"].max() == grains
    assert 60 < result["threshold"] < 230 and len(result["peaks"]) >= 2


def test_segment_of_a_mask_warns_of_what_the_program_names():
    mask = scan_of_balls() > 100
    result = wscvt.segment(mask)
    assert result["threshold"] is None and result["grains"] == 4
    # A volume that is full is inverted.
    with pytest.warns(UserWarning, match="dark"):
        wscvt.segment(~mask)


def test_segment_refuses_what_has_no_grain():
    with pytest.raises(wscvt.Error):
        wscvt.segment(np.ones((9, 9, 9)))
    with pytest.raises(wscvt.Error, match="separate|neck"):
        wscvt.segment(scan_of_balls(), separate=2)
    with pytest.raises(TypeError):
        wscvt.segment("scan.tif")

# SPDX-License-Identifier: GPL-3.0-or-later
"""Labels of an array of grey values: those of the program."""
import csv
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


def packing():
    """Labels (nz, ny, nx) of balls in a row, of which the first is at the border."""
    z, y, x = np.indices((30, 30, 64)) + 0.5
    labels = np.zeros(z.shape, np.uint16)
    for label, middle, radius in ((7, (2, 15, 15), 9), (3, (18.6, 15.4, 15), 9), (12, (36.1, 14, 15.7), 9.6),
                                  (5, (51, 16, 14), 8)):
        labels[(x - middle[0]) ** 2 + (y - middle[1]) ** 2 + (z - middle[2]) ** 2 < radius ** 2] = label
    return labels


def test_fabric_has_the_numbers_of_the_program(tmp_path):
    labels = packing()
    grey = labels > 0
    scan = np.where(grey, 160, 60).astype(np.float32)
    scan = (scan + np.roll(scan, 1, 0) + np.roll(scan, 1, 1) + np.roll(scan, 1, 2)) / 4
    np.save(tmp_path / "labels.npy", labels)
    np.save(tmp_path / "scan.npy", scan)
    for given, call in ((None, []), (scan, ["scan.npy"])):
        result = wscvt.fabric(labels, (0.5, 0.25, 1.0), scan=given)
        subprocess.run([os.environ["WSCVT_PROGRAM"], "describe", "labels.npy", "-o", "out", "-q", "--voxel-size",
                        "0.5,0.25,1"] + call, cwd=tmp_path, check=True)
        for name, table in (("contacts", "contacts.csv"), ("grains", "grains.csv")):
            with open(tmp_path / "out" / table, newline="") as file:
                rows = list(csv.DictReader(file))
            columns = result[name]
            assert len(rows) == len(columns["at_border"]) > 2
            for column, values in columns.items():
                if values.ndim == 1:
                    np.testing.assert_array_equal(values.astype(float), [float(row[column]) for row in rows])
                else:
                    prefix = "" if column == "centre" else column + "_"
                    np.testing.assert_array_equal(values, [[float(row[prefix + a]) for a in "xyz"] for row in rows])
        normals = result["contacts"]["normal"][result["contacts"]["contact"]]
        np.testing.assert_allclose(result["tensor"], normals.T @ normals / len(normals), atol=1e-12)
        assert (result["blur"] is None) == (given is None)


def test_fabric_refuses_what_is_no_volume_of_labels():
    labels = packing().astype(np.int64)
    with pytest.raises(wscvt.Error, match="whole numbers"):
        wscvt.fabric(labels + 0.5)
    with pytest.raises(wscvt.Error, match="three dimensions"):
        wscvt.fabric(labels[0])
    with pytest.raises(wscvt.Error, match="-3"):
        wscvt.fabric(labels - 3)
    with pytest.raises(wscvt.Error, match="one label"):
        wscvt.fabric((labels > 0).astype(int))
    with pytest.raises(wscvt.Error, match="64 x 30 x 29"):
        wscvt.fabric(labels, scan=np.zeros((29, 30, 64)))
    # Another background gives the same contacts.
    moved = np.where(labels == 0, 50, labels)
    np.testing.assert_array_equal(wscvt.fabric(moved, background=50)["contacts"]["area"],
                                  wscvt.fabric(labels)["contacts"]["area"])

# SPDX-License-Identifier: GPL-3.0-or-later
"""Contacts of an array of labels: the numbers of the program."""
import csv
import os
import subprocess

import numpy as np
import pytest

import wscvt


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

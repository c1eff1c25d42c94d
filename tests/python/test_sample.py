# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of grains as structured arrays, and the statistics of samples."""
import json
import math
import os
import subprocess

import numpy as np
import pytest

import wscvt

TABLE = ("grain,status,error,file,scan.volume [mm^3],scan.axis_i_box [mm],scan.convexity\r\n"
         "b.ply,done,,b.stl,8,2,0.9\r\nc.ply,failed,\"It is open.\",,,,\r\na.ply,done,,a.stl,27,3,\r\n")


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "shape.csv"
    path.write_text(TABLE, newline="")
    return path


def test_a_table_is_a_structured_array(table):
    array = wscvt.read_table(table)
    assert array.dtype.names == ("grain", "file", "scan.volume", "scan.axis_i_box", "scan.convexity")
    assert array["grain"].tolist() == ["b.ply", "a.ply"] and array["file"][1] == "a.stl"
    assert array["scan.volume"].tolist() == [8.0, 27.0] and math.isnan(array["scan.convexity"][1])
    assert wscvt.read_table(table.parent).tobytes() == array.tobytes()
    with pytest.raises(wscvt.Error, match="line 2"):
        table.write_text("grain,v\na\n")
        wscvt.read_table(table)


def test_a_sample_is_that_of_the_program(table):
    report = wscvt.sample(table.parent, density=2.0, report=[table.parent / "page.html"])
    subprocess.run([os.environ["WSCVT_PROGRAM"], "sample", table.parent, "-q", "--density", "2",
                    "--report", table.parent / "program.json"], check=True)
    assert json.loads((table.parent / "program.json").read_text()) == report
    assert report["samples"][0]["mass"] == 70.0
    assert "<svg" in (table.parent / "page.html").read_text()
    # Arrays have no units; the numbers are the same.
    for given in (wscvt.read_table(table), {name: wscvt.read_table(table)[name]
                                            for name in wscvt.read_table(table).dtype.names}):
        size = wscvt.sample(given, threads=1)["samples"][0]["size"]
        assert size == report["samples"][0]["size"]


def test_two_samples_are_compared():
    sizes = np.arange(1.0, 21.0)
    one = {"axis_i_box": sizes, "volume": sizes**3}
    other = {"axis_i_box": sizes + 0.25, "volume": sizes**3}
    comparison = wscvt.sample(one, other, repetitions=99)["comparison"]
    assert comparison["size"]["by_number"]["wasserstein"] == pytest.approx(0.25)
    assert comparison["volume"]["by_number"]["kolmogorov_smirnov"] == pytest.approx(0.0, abs=1e-12)
    pandas = pytest.importorskip("pandas")
    assert wscvt.sample(pandas.DataFrame(one), pandas.DataFrame(other),
                        repetitions=99)["comparison"] == comparison


def test_what_is_no_sample_is_refused():
    with pytest.raises(TypeError, match="no columns of numbers"):
        wscvt.sample({"grain": ["a", "b"]})
    with pytest.raises(wscvt.Error, match="axis_i_box"):
        wscvt.sample({"volume": [1.0, 2.0]})
    with pytest.raises(wscvt.Error, match="size"):
        wscvt.sample({"axis_i_box": [1.0, 2.0]}, size="weight")

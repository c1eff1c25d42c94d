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


def test_a_family_of_remeshes_has_levels(table):
    folder = table.parent / "family"
    for nodes, off in [(100, 1.04), (400, 1.01)]:
        (folder / f"n{nodes}").mkdir(parents=True)
        (folder / f"n{nodes}" / "shape.csv").write_text(
            "grain,nodes,contact_error_mean [%],scan.axis_i_box,scan.area,remesh.area\r\n" + "".join(
                f"{name},{nodes},{-50.0 / nodes},{size},10,{10 * off}\r\n"
                for name, size in [("a", 2), ("b", 3)]), newline="")
    levels = wscvt.sample(folder, max_error=0.25)["levels"]
    assert levels["descriptors"]["area"]["errors"][1]["median_percent"] == pytest.approx(1.0)
    assert levels["descriptors"]["contact_error_mean"]["nodes_needed"] == 200.0
    with pytest.raises(wscvt.Error, match="n100"):
        wscvt.read_table(folder)
    empty = folder / "empty"
    empty.mkdir()
    with pytest.raises(wscvt.Error, match="has no shape.csv"):
        wscvt.sample(empty)


def test_columns_have_one_number_for_each_grain():
    sizes = np.arange(1.0, 31.0)
    table = {"axis_i_box": sizes, "volume": sizes ** 3}
    size = wscvt.sample(table, repetitions=9)["samples"][0]["size"]
    for name in ("grain", "file"):
        for count in (1, 29, 100):
            with pytest.raises(wscvt.Error, match=f'"{name}" has {count} rows'):
                wscvt.sample({name: ["a"] * count, **table})
    # A point for each grain, as fabric gives it, is three columns.
    centre = np.arange(90.0).reshape(30, 3)
    with_centre = wscvt.sample({"centre": centre, **table}, repetitions=9)["samples"][0]
    assert with_centre["size"] == size
    with pytest.raises(wscvt.Error, match=r"shape \(30, 2\)"):
        wscvt.sample({"centre": centre[:, :2], **table})


def test_masses_come_from_the_table_or_the_density():
    sizes = np.array([1.0, 2.0, 3.0])
    one = {"axis_i_box": sizes, "volume": sizes}
    def mass(*tables, **options):
        return [sample["mass"] for sample in wscvt.sample(*tables, **options)["samples"]]
    assert mass(one, one, density=(2.0, 3.0), repetitions=9) == [12.0, 18.0]
    assert mass({**one, "density": sizes}) == [14.0]
    assert mass({**one, "density": sizes, "mass": [1.0, 1.0, 2.0]}) == [4.0]
    assert mass({**one, "density": sizes}, density=2.0) == [12.0]
    with pytest.raises(TypeError, match="one per sample"):
        mass(one, density=(2.0, 3.0))


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
    with pytest.raises(TypeError, match="no numeric columns"):
        wscvt.sample({"grain": ["a", "b"]})
    with pytest.raises(wscvt.Error, match="axis_i_box"):
        wscvt.sample({"volume": [1.0, 2.0]})
    with pytest.raises(wscvt.Error, match="size"):
        wscvt.sample({"axis_i_box": [1.0, 2.0]}, diameter="weight")

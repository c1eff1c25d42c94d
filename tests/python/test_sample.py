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
    with pytest.raises(wscvt.Error, match="has no shape.csv.*without shard"):
        wscvt.sample(empty)


def test_other_files_are_refused_as_by_the_program(tmp_path):
    volume = tmp_path / "labels.npy"
    np.save(volume, np.ones((3, 4, 5), np.uint8))
    zarr = tmp_path / "ct.zarr"
    zarr.mkdir()
    (zarr / ".zarray").write_text("{}")
    for read in (wscvt.sample, wscvt.read_mesh):
        with pytest.raises(wscvt.Error, match=r"wscvt\.batch\(FILE, output=FOLDER\)"):
            read(volume)
        with pytest.raises(wscvt.Error, match="numpy.save"):
            read(zarr)
    clump = tmp_path / "clump.csv"
    clump.write_text("x;y;z;r\n0;0;0;1,5\n")
    with pytest.raises(wscvt.Error, match="wscvt describe CLUMP.csv"):
        wscvt.describe(clump)


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


def coefficients(count, seed=5):
    """Random series of degree 6, long and rough."""
    rng = np.random.default_rng(seed)
    degrees = np.repeat(np.arange(7), 2 * np.arange(7) + 1)
    grains = []
    for _ in range(count):
        c = rng.uniform(-0.5, 0.5, 49) / (1.0 + degrees) ** 2
        c[0] = 2.0 * np.sqrt(np.pi)
        grains.append(c * rng.uniform(1.0, 2.0))
    return grains


def test_templates_of_all_kinds_have_their_weights():
    kind = np.repeat([0, 1, 2], [2, 5, 3])
    table = np.zeros(10, [("sphericity", "f8"), ("convexity", "f8")])
    table["sphericity"] = np.array([0.9, 0.7, 0.4])[kind]
    table["convexity"] = np.array([0.8, 0.9, 0.6])[kind]
    chosen, distances = wscvt.templates(table, np.array([4.0, 1.0, 2.0])[kind], 3)
    assert sorted(kind[chosen["grain"]]) == [0, 1, 2]
    assert np.allclose(chosen["weight_by_number"], np.array([0.2, 0.5, 0.3])[kind[chosen["grain"]]])
    assert np.allclose(chosen["weight_by_mass"],
                       np.array([8.0, 5.0, 6.0])[kind[chosen["grain"]]] / 19.0)
    assert np.allclose(distances["by_number"], 0.0, atol=1e-6)
    assert (kind[chosen["grain"][distances["stands_for"]]] == kind).all()
    matrix = np.column_stack([table["sphericity"], table["convexity"]])
    again, _ = wscvt.templates(matrix, np.array([4.0, 1.0, 2.0])[kind], 3, threads=2)
    assert (again == chosen).all()
    with pytest.raises(wscvt.Error, match="11 templates"):
        wscvt.templates(matrix, np.ones(10), 11)


def test_grown_grains_are_those_of_the_seed(tmp_path):
    grains = coefficients(9)
    meshes, table = wscvt.grow(grains, 11, nodes=70, degree=6, seed=3, threads=1)
    assert len(meshes) == len(table) == 11
    assert all(v.shape == (70, 3) and f.shape == (136, 3) for v, f in meshes)
    assert sorted(table["base_grain"][:9]) == list(range(9))
    assert (table["nearest_distance"] > 0.0).all() and (table["collage"] <= 1.0).all()
    for (vertices, faces), diameter in zip(meshes, table["equivalent_diameter"]):
        a, b, c = (vertices[faces[:, k]] for k in range(3))
        assert np.isclose(np.einsum("ij,ij->", a, np.cross(b, c)) / 6, np.pi / 6 * diameter ** 3)
    again, other = wscvt.grow(grains, 11, nodes=70, degree=6, seed=3, threads=2)
    assert (table == other).all() and (again[10][0] == meshes[10][0]).all()
    from_meshes, _ = wscvt.grow(meshes, 2, nodes=50, degree=4)
    assert from_meshes[1][0].shape == (50, 3)
    for k, mesh in enumerate(meshes):
        wscvt.write_mesh(tmp_path / f"{k:02}.ply", *mesh)
    from_files, _ = wscvt.grow(tmp_path, 2, nodes=50, degree=4)
    np.testing.assert_allclose(from_files[1][0], from_meshes[1][0], atol=1e-6)
    with pytest.raises(wscvt.Error, match="at least 8"):
        wscvt.grow(grains[:7], 2, degree=6)

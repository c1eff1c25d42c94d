# SPDX-License-Identifier: GPL-3.0-or-later
"""Templates of a sample and virtual grains."""
import numpy as np
import pytest

import wscvt


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


def test_grown_grains_are_those_of_the_seed():
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
    with pytest.raises(wscvt.Error, match="at least 8"):
        wscvt.grow(grains[:7], 2, degree=6)

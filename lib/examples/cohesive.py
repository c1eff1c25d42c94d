#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts cohesive elements of no thickness between the bodies of a packing, for Abaqus.

    wscvt extract labels.nrrd packing --tetrahedra packing.inp
    cohesive.py packing.inp cohesive.inp

wscvt fragment --tetrahedra makes such a file too. In it two bodies share the nodes of their wall. Here each
body gets nodes of its own, and each triangle of a wall a COH3D6: its nodes 1, 2, 3 belong to the first body,
4, 5, 6 to the second, at the same places, and the normal of 1, 2, 3 points to the second. The elements of the
wall wall_3_7 are the set joints_3_7, all of them the set joints. Surfaces keep their names. Give joints a
*COHESIVE SECTION with a thickness, because theirs is 0. CalculiX has no such elements.
"""
import pathlib
import sys

FACES = {"S1": (0, 1, 2), "S2": (0, 3, 1), "S3": (1, 3, 2), "S4": (2, 3, 0)}  # inward


def read(path):
    """Returns the nodes by number as text, the elements of each set, and the rows of each surface."""
    nodes, bodies, surfaces, block, name = {}, {}, {}, "", ""
    for line in path.read_text(encoding="utf-8").splitlines():
        words = [word.strip() for word in line.split(",")]
        if line.startswith("*"):
            block = words[0]
            name = next((word.split("=")[1] for word in words if word.split("=")[0] in ("ELSET", "NAME")), "")
        elif block == "*NODE":
            nodes[int(words[0])] = ", ".join(words[1:])
        elif block == "*ELEMENT":
            bodies.setdefault(name, {})[int(words[0])] = [int(word) for word in words[1:]]
        elif block == "*SURFACE":
            surfaces.setdefault(name, []).append((int(words[0]), words[1]))
    return nodes, bodies, surfaces


def walls_between(bodies, surfaces):
    """Returns of each wall its two bodies and the nodes of its triangles, outward of the first."""
    body_of = {number: body for body, elements in bodies.items() for number in elements}
    walls = {}
    for name, rows in surfaces.items():
        if name.startswith("wall_"):
            first, second = name.split("_")[1:]
            inner = body_of[rows[0][0]]
            triangles = [[bodies[inner][number][k] for k in reversed(FACES[face])] for number, face in rows]
            walls[first + "_" + second] = (inner, inner[:-len(first)] + second, triangles)
    return walls


def part(nodes, bodies):
    """Gives each body nodes of its own. Returns them by body and common node."""
    own, taken = {}, set()
    for body, elements in bodies.items():
        for corners in elements.values():
            for k, node in enumerate(corners):
                if (body, node) not in own:
                    own[body, node] = len(nodes) + 1 if node in taken else node
                    nodes[own[body, node]] = nodes[node]
                    taken.add(node)
                corners[k] = own[body, node]
    return own


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    source, target = map(pathlib.Path, sys.argv[1:])
    nodes, bodies, surfaces = read(source)
    walls = walls_between(bodies, surfaces)
    own = part(nodes, bodies)
    number = sum(len(elements) for elements in bodies.values())
    lines = ["*HEADING", "packing with cohesive elements", "*NODE, NSET=all_nodes"]
    lines += [f"{node}, {place}" for node, place in nodes.items()]
    for body, elements in bodies.items():
        lines.append("*ELEMENT, TYPE=C3D4, ELSET=" + body)
        lines += [", ".join(map(str, [element, *corners])) for element, corners in elements.items()]
    for name, (first, second, triangles) in walls.items():
        lines.append("*ELEMENT, TYPE=COH3D6, ELSET=joints_" + name)
        for triangle in triangles:
            number += 1
            corners = [own[body, node] for body in (first, second) for node in triangle]
            lines.append(", ".join(map(str, [number, *corners])))
    if walls:
        lines.append("*ELSET, ELSET=joints")
        lines += ["joints_" + name for name in walls]
    for name, rows in surfaces.items():
        lines.append(f"*SURFACE, NAME={name}, TYPE=ELEMENT")
        lines += [f"{element}, {face}" for element, face in rows]
    target.write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(f"{sum(len(wall[2]) for wall in walls.values())} cohesive elements in {len(walls)} walls, {len(nodes)} nodes")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that LIGGGHTS inserted the grains of liggghts.in, and that they are at rest on the bottom.

    liggghts_packing_test.py INPUT OUTPUT COUNT
"""
import re
import sys

text = open(sys.argv[2]).read()
inserted = re.search(r"inserted (\d+) particle templates", text)
assert inserted, "LIGGGHTS inserted no grains: " + text[-500:]
assert int(inserted.group(1)) >= 0.8 * int(sys.argv[3]), inserted.group(0)
table = [line.split() for line in text.splitlines()]
rows = [[float(cell) for cell in row] for row in table
        if len(row) == 4 and all(re.fullmatch(r"-?[0-9.eE+-]+", cell) for cell in row)]
assert rows[-1][0] == 100000, rows[-1]
first, last = rows[1][3], rows[-1][3]
assert last < first, "The lowest sphere did not fall: %g, %g" % (first, last)
side = float(re.search(r"variable side equal ([0-9.eE+-]+)", open(sys.argv[1]).read()).group(1))
assert -0.02 * side < last < 0.2 * side, "The lowest sphere lies at %g" % last
print("LIGGGHTS: %s grains of the templates, the lowest sphere at %.3g" % (inserted.group(1), last))

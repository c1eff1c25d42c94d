# SPDX-License-Identifier: GPL-3.0-or-later
# python3 liggghts_test.py OUTPUT TRIANGLES: checks that LIGGGHTS read every triangle, and that the balls
# did not fall through the mesh. After a free fall they would be at -0.005 m.
import re
import sys

output = open(sys.argv[1]).read()
read = re.search(r"mesh grain containing (\d+) triangle\(s\) successful", output)
assert read and read[1] == sys.argv[2], read
rows = [line.split() for line in output.split("\n") if re.match(r" *16000 ", line)]
assert rows, "the run did not end"
balls, lowest = int(rows[0][1]), float(rows[0][3])
assert balls == 2 and lowest > 0.02, rows
print("LIGGGHTS: %s triangles, balls at %.3f m or above" % (read[1], lowest))

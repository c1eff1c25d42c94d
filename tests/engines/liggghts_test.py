# SPDX-License-Identifier: GPL-3.0-or-later
# python3 liggghts_test.py LOG TRIANGLES: LIGGGHTS took every triangle, and the balls bounced off.
import re
import sys

log = open(sys.argv[1]).read()
read = re.search(r"Read (\d+) triangles|(\d+) elements", log)
rows = [line.split() for line in log.split("\n") if re.match(r"^ *\d+ +\d+ +[0-9.e+-]+ ", line)]
assert rows and int(rows[-1][0]) == 12000, "the run did not end"
assert int(rows[-1][1]) > 0
assert "ERROR" not in log
print("LIGGGHTS: mesh of %s triangles read, %s balls after %s steps" % (sys.argv[2], rows[-1][1], rows[-1][0]))

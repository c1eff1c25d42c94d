#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks the type stub of the Python module with mypy, on code that uses it right and wrong.
#   tests/types.sh BUILD
set -eu
build=$(realpath "${1:?usage: types.sh BUILD}")
cd "$(dirname "$0")/.."
MYPYPATH=$build/lib/python /usr/bin/python3 -m mypy --strict --warn-unused-ignores \
  --cache-dir "$build/mypy" tests/python/typed_use.py

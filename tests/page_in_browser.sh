#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Shows a report's page in headless Chromium: on a telephone (400 pixels wide), in a wide window
# (1400) and printed. Fails if the page is wider than a window, a picture does not load, the pictures do
# not turn where the browser has WebGL, or a printed page ends with a heading. Then the page of a batch.
#   tests/page_in_browser.sh PROGRAM FOLDER
# PROGRAM is wscvt. Leaves the page, the pictures page-400.png and page-1400.png and page.pdf in FOLDER.
# Needs chromium and poppler-utils; tests/run_all.sh page installs them and runs this.
set -eu
program=$(realpath "${1:?usage: page_in_browser.sh PROGRAM FOLDER}")
folder=$(realpath -m "${2:?usage: page_in_browser.sh PROGRAM FOLDER}")
meshes=$(realpath "$(dirname "$0")/../meshes")
mkdir -p "$folder"
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
browser() {  # width, height, further arguments
  size=$1,$2
  shift 2
  # Without a sandbox, which root cannot have; the page is our own.
  HOME=$home timeout 120 chromium --headless --no-sandbox --disable-dev-shm-usage \
    --hide-scrollbars --user-data-dir="$home/profile" --window-size="$size" "$@" 2> "$home/log" || {
    cat "$home/log" >&2
    exit 1
  }
}

# With an allowed error, so that every figure is there.
"$program" -q "$meshes/sand_7228.ply" "$folder/remesh.ply" -n 300 --max-error 2 --error-measure distance \
  --report "$folder/page.html"

# A window of Chromium is never narrower than 500 pixels, but a frame in it is.
for width in 400 1400; do
  cat > "$home/frame.html" << END
<body style="margin: 0"><iframe src="file://$folder/page.html" width="$width" style="border: 0"
  onload="
    const page = this.contentDocument, images = [...page.images];
    this.height = page.documentElement.scrollHeight;
    document.title = 'asked: ' + page.documentElement.scrollWidth + ' by ' + this.height + ' pixels, ' +
      images.filter(i => i.complete && i.naturalWidth > 0).length + ' pictures, ' +
      page.querySelectorAll('svg').length + ' drawings';"></iframe></body>
END
  answer=$(browser 1400 1000 --allow-file-access-from-files --dump-dom "file://$home/frame.html" |
    grep -o 'asked: [^<]*drawings' | head -n 1)
  echo "In a frame $width wide $answer"
  wide=$(echo "$answer" | sed 's/asked: \([0-9]*\) by.*/\1/')
  high=$(echo "$answer" | sed 's/.* by \([0-9]*\) pixels.*/\1/')
  [ "$wide" -le "$width" ] || {
    echo "The page is wider than its frame." >&2
    exit 1
  }
  case $answer in *" 3 pictures, 6 drawings") ;; *)
    echo "A picture or a drawing is missing." >&2
    exit 1 ;;
  esac
  browser "$width" "$high" --allow-file-access-from-files \
    --screenshot="$folder/page-$width.png" "file://$home/frame.html"
done
# With WebGL each picture becomes a view that turns; without, all stay as they are.
turning() { browser 1400 1000 "$@" --virtual-time-budget=8000 --dump-dom "file://$folder/page.html" | grep -c "<canvas" || true; }
with=$(turning --use-gl=angle --use-angle=swiftshader --enable-unsafe-swiftshader)
without=$(turning --disable-gpu --disable-3d-apis)
echo "Pictures that turn: $with with WebGL, $without without."
[ "$with" -gt 0 ] && [ "$without" -eq 0 ] || {
  echo "The views are not as they should be." >&2
  exit 1
}
browser 1400 1000 --no-pdf-header-footer --print-to-pdf="$folder/page.pdf" "file://$folder/page.html"
# On paper no heading ends a page.
sed -n 's/^<h2>\(.*\)<\/h2>$/\1/p' "$folder/page.html" > "$home/headings"
pdftotext -layout "$folder/page.pdf" "$home/page.txt"
awk 'BEGIN { RS = "\f" } NF { sub(/[ \n]+$/, ""); sub(/.*\n */, ""); print }' "$home/page.txt" > "$home/last_lines"
echo "On $(wc -l < "$home/last_lines") pages of paper."
if grep -n -x -F -f "$home/headings" "$home/last_lines"; then
  echo "The page above ends with a heading." >&2
  exit 1
fi
# The page of a batch, narrow: its script draws, tells the day of the file, and opens all tables for print.
"$program" batch "$meshes" -q -o "$folder/batch" -n 100 > "$home/log"
touch -d 2026-01-02 "$folder/batch/summary.html"
cat > "$home/frame.html" << END
<body style="margin: 0"><iframe src="file://$folder/batch/summary.html" width="400" height="9000" style="border: 0"
  onload="document.title = 'asked: ' + this.contentDocument.documentElement.scrollWidth;"></iframe></body>
END
wide=$(browser 1400 1000 --allow-file-access-from-files --dump-dom "file://$home/frame.html" |
  grep -o 'asked: [0-9]*' | head -n 1 | tr -dc 0-9)
[ "$wide" -le 400 ] || {
  echo "The page of a batch is $wide pixels wide in a frame of 400." >&2
  exit 1
}
browser 1400 1000 --virtual-time-budget=4000 --dump-dom "file://$folder/batch/summary.html" > "$home/drawn.html"
browser 1400 1000 --no-pdf-header-footer --print-to-pdf="$folder/batch.pdf" "file://$folder/batch/summary.html"
pdftotext -layout "$folder/batch.pdf" "$home/batch.txt"
for words in 'File of 2026-01-02.' 'Form after Zingg' '<details><summary>All'; do
  grep -q "$words" "$home/drawn.html" || {
    echo "The page of a batch has no \"$words\"." >&2
    exit 1
  }
done
grep -q 'Kong-Fonseca' "$home/batch.txt" || {
  echo "In print, the page of a batch leaves out its collapsed tables." >&2
  exit 1
}
echo "The page of a batch is $wide pixels wide in a frame of 400, and its tables are printed."
echo "The page and its pictures are in $folder."

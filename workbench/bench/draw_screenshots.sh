#!/bin/bash
# draw_screenshots.sh WORKBENCH [OUT] [NAME...]: draws the pictures of the pages anew, into screenshots/ or OUT; all, or
# those named. By `shot`, without a display, the same every time; report.png by chromium, where it is installed.
W=$(realpath "$1"); ROOT=$(realpath "$(dirname "$0")/../..")
OUT=$(realpath -m "${2:-$ROOT/screenshots}"); shift; shift; ONLY=" $* "; failed=0
TMP=$(mktemp -d); trap 'rm -rf "$TMP"' EXIT
export XDG_CONFIG_HOME=$TMP/config XDG_DATA_HOME=$TMP/data
cd "$ROOT" || exit 2; mkdir -p "$OUT"
# draw NAME ARGUMENT...: OUT/NAME.png by `shot`.
draw() {
  local name=$1; shift
  [ "$ONLY" = "  " ] || [[ "$ONLY" == *" $name "* ]] || return
  "$W" shot "$@" --out "$OUT/$name.png" >"$TMP/log" 2>&1 || { echo "$name: not drawn"; tail -3 "$TMP/log"; failed=1; }
}
for view in overview light iterations map-iterations map-touch-radius map-gain-margin planar time-machine tick-by-tick \
    solve-here why sweep heat-map slice palette monitor plots plots-values plots-xy plots-spectrum \
    plots-histogram control-net planes both-surfaces cone cylinder cube sphere tetrahedron octagon triangle hexagon; do
  draw $view --view $view
done
draw tune --view tune --width 1600 --height 1000
draw parameters --view parameters --height 960
draw inspect fin_on_plate --view inspect
draw speed_against_error --script workbench/bench/speed_window.txt --width 1600 --height 900
if [ "$ONLY" = "  " ] || [[ "$ONLY" == *" compare-recordings "* ]]; then
  cd "$TMP" || exit 2
  "$W" record --seconds 2 --without-waiting --out stiff.sqlite >log 2>&1
  "$W" record --seconds 2 --without-waiting --stiffness-n-per-m 410 --out soft.sqlite >log 2>&1
  printf '%s\n' 'tab record' 'panel Compare recordings' 'first recording stiff.sqlite' 'second recording soft.sqlite' \
    'compare recordings' 'wait 2' 'compared tick 900' 'wait 1' > compare.txt
  draw compare-recordings --script compare.txt --width 1280 --height 900
fi
if [ "$ONLY" = "  " ] || [[ "$ONLY" == *" report "* ]]; then
  cd "$TMP" || exit 2
  "$W" make torus --out torus.obj >log 2>&1
  "$W" record torus.obj --seconds 2 --without-waiting --method paper --gain-curvature-m 0.005 \
    --out trouble.sqlite >log 2>&1
  "$W" report trouble.sqlite --ticks 500 --rounds 3 --out report >log 2>&1 || failed=1
  style='position:absolute; top:-2000px; left:-2px; width:1100px; height:6000px'
  echo "<iframe src=report/report.html style='$style'>" > frame.html
  chromium --headless --no-sandbox --hide-scrollbars --window-size=1100,2400 --screenshot="$OUT/report.png" \
    "file://$TMP/frame.html" >log 2>&1 || failed=1
fi
cd "$ROOT" || exit 2
B=${TANGENT_BUNNY:-}  # stanford-bunny.obj, 69,451 triangles; without it the picture stays
[ -f "$B" ] && cd "$(dirname "$B")" && draw bunny "$(basename "$B")" --fit-mm 80 --up y --view overview
exit $failed

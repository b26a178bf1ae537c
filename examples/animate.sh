#!/bin/sh
# animate.sh -- sixty poses of one model out of one pipe, each a picture; usage: animate.sh [MODEL [FRAMES]]
# Everything before mr-pose is done once.  Each frame after the first is a delta: handles, then positions.
set -e
model=${1:-bumpy.off}
frames=${2:-${MR_SMALL:+6}}
[ -n "$1" ] || [ -e "$model" ] || mr-make bumpy -n "${MR_SMALL:-40000}" | mr-export "$model"
mkdir -p frames

mr-import "$model" |
    mr-smooth |
    mr-remesh |
    mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
    mr-solve --basis |
    mr-encode |
    mr-pose -H 1 --rotate 0,1,0,60 --frames "${frames:-60}" |
    mr-decode |
    mr-render --size 320x320 frames/%d.png

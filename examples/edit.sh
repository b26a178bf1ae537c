#!/bin/sh
# edit.sh -- bend a detailed model with its detail kept, by one pipe of small tools; usage: edit.sh [MODEL [OUT]]
# Without a model: one that mr-make makes.  See man 7 mr.
set -e
model=${1:-bumpy.off}
out=${2:-bent.obj}
[ -n "$1" ] || [ -e "$model" ] || mr-make bumpy -n "${MR_SMALL:-40000}" | mr-export "$model"

# The steps, in order: read; take the detail away; give what is left good triangles; the bottom fifth stays, the top
# fifth is the handle (y is up; of a model that stands along z, z); store the detail over the base; tilt the handle;
# bend the surface after it; put the detail back; write.
mr-import "$model" |
    mr-smooth |
    mr-remesh |
    mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
    mr-encode |
    mr-pose -H 1 --rotate 0,0,1,30 |
    mr-solve |
    mr-decode |
    mr-export "$out"

#!/bin/sh
# pack.sh -- a mesh or scan in as few bytes as give an error; usage: pack.sh MODEL OUT.mrz [ERROR]
#
# Tries control meshes of several sizes, each by the pipe of mr-pack(1), and one level more of the best; keeps the
# smallest file that reaches ERROR (default 0.01%), or where none does the nearest.  Prints a line for each.
# Without a model packs a bumpy sphere as bumpy.mrz.
set -e
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ $# -eq 0 ]; then
	mr-make bumpy -n ${MR_SMALL:-30000} | mr-export "$work/bumpy.ply"
	set -- "$work/bumpy.ply" bumpy.mrz 0.05%
fi
out=$2 error=${3:-0.01%}
want=$(echo "$error" | awk '{ print /%/ ? $1 / 100 : $1 }')
figure() { # file, key
	sed -n 's/.*"'"$2"'":\([^,}]*\).*/\1/p' "$1"
}

mr-import -q --repair "$1" -o "$work/model.mrs"
if mr-info "$work/model.mrs" | grep -q 'mesh:'; then
	control() {
		mr-simplify -q --to control "$@" "$work/model.mrs"
	}
else
	mr-shrinkwrap -q "$work/model.mrs" -o "$work/wrap.mrs"
	control() {
		mr-simplify -q "$@" "$work/wrap.mrs"
	}
fi
control --stats "$work/control" | mr-fit -q -o "$work/fit.mrs"
faces=$(figure "$work/control" faces)
level=0 best=
attempt() { # faces, options of mr-sample: is kept where it is the best so far
	mr-sample -q --stats "$work/sample" "$2" "$3" "$work/fit.mrs" |
	    mr-pack -q -e "$error" --stats "$work/pack" - "$work/try.mrz"
	now="$(figure "$work/pack" error) $(figure "$work/pack" bytes)"
	echo "$1 $(figure "$work/sample" level) $now" |
	    awk '{ printf "%s faces, level %s: %.4f %%, %d bytes\n", $1, $2, 100 * $3, $4 }'
	if echo "$now ${best:-1 0} $want" | awk '{ limit = 1.01 * $5; a = $1 <= limit; b = $3 <= limit
	    exit !(a && b ? $2 < $4 : a || b ? a : $1 < $3) }'; then
		best=$now level=$(figure "$work/sample" level)
		mv "$work/try.mrz" "$work/best.mrz"
		cp "$work/fit.mrs" "$work/best.mrs"
		size=$1
	fi
}
attempt "$faces" --refine 3
for n in $((faces / 3)) $((faces * 2)); do
	control -n "$n" | mr-fit -q -o "$work/fit.mrs"
	attempt "$n" --refine 3
done
mv "$work/best.mrs" "$work/fit.mrs"
attempt "$size" --level $((level + 1))
mv "$work/best.mrz" "$out"

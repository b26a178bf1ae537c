#!/bin/sh
# pack.sh -- a mesh or scan in as few bytes as give an error; usage: pack.sh MODEL OUT.mrz [ERROR]
#
# Tries control meshes of 300 faces, twice as many, and so on until the file grows, each by the pipe of mr-pack(1)
# on the level that mr-sample chooses and on finer ones; keeps the smallest file that reaches ERROR (default 0.01%),
# or where none does the nearest.  Prints a line for each.
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
level=0 best=
attempt() { # options of mr-sample: kept where it is the best so far; $reached, $bytes
	mr-sample -q --stats "$work/sample" "$@" "$work/fit.mrs" |
	    mr-pack -q -e "$error" --stats "$work/pack" - "$work/try.mrz"
	level=$(figure "$work/sample" level) bytes=$(figure "$work/pack" bytes)
	now="$(figure "$work/pack" error) $bytes"
	echo "$n $level $now" | awk '{ printf "%s faces, level %s: %.4f %%, %d bytes\n", $1, $2, 100 * $3, $4 }'
	reached=$(echo "$now $want" | awk '{ print $1 <= 1.01 * $3 }')
	if echo "$now ${best:-1 0} $want" | awk '{ limit = 1.01 * $5; a = $1 <= limit; b = $3 <= limit
	    exit !(a && b ? $2 < $4 : a || b ? a : $1 < $3) }'; then
		best=$now
		mv "$work/try.mrz" "$work/best.mrz"
	fi
}
smallest=
for n in 300 600 1200 2400 4800 9600; do
	control -n "$n" | mr-fit -q -o "$work/fit.mrs"
	attempt --refine 3
	least= error_before=1
	while
		[ "$reached" -eq 0 ] || [ "$bytes" -ge "${least:-$((bytes + 1))}" ] || least=$bytes
		better=$(echo "$now $error_before" | awk '{ print $1 < 0.9 * $3 }')
		[ "$error_before" = 1 ] || [ "$reached" -eq 0 -a "$better" -eq 1 ]
	do
		error_before=${now% *}
		attempt --level $((level + 1))
	done
	[ -z "$least" ] || [ "${smallest:-$least}" -ge "$least" ] || break
	smallest=${least:-$smallest}
done
mv "$work/best.mrz" "$out"

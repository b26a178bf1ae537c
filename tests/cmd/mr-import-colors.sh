# Where the type of colours does not tell their range, their values do, by one rule for all formats.
colors() {
	for values in "$@"; do
		set -- $values
		{ echo '# x y z red green blue'; printf '0 0 0 %s %s %s\n' "$@"; } >c.xyz
		printf 'v 0 0 0 %s %s %s\n' "$@" >c.obj
		{ printf 'COFF\n%d 0 0\n' $(($# / 3)); printf '0 0 0 %s %s %s 1\n' "$@"; } >c.off
		{
			printf '%d\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 -1 1\n' $(($# / 3))
			printf '0 0 1 0 %s %s %s\n' "$@"
		} >c.ptx
		for type in float int; do
			{
				printf 'ply\nformat ascii 1.0\nelement vertex %d\n' $(($# / 3))
				printf 'property double %s\n' x y z
				printf "property $type %s\n" red green blue
				echo end_header
				printf '0 0 0 %s %s %s\n' "$@"
			} >c-$type.ply
		done
		echo "-- $values"
		for file in c.xyz c.obj c-float.ply c-int.ply c.off c.ptx; do
			mr-import --no-history $file -o out.mrs 2>err
			mr-export -q -i out.mrs -f ply-ascii - | sed '1,/end_header/d; s/^0 0 0//; s/ 0 0 -1 0$//' | tr -d '\n'
			echo "  $file $(sed 's/.*warning: //' err)"
		done
	done
}
colors '1 0 1' '0.9 1 1.0000001 0 0 0' '0.5 1.5 -1' '0 1 2' '255 0.5 0' '255.1 0 1' '65535 256 0' '70000 65535 0' '256 1 0'

echo '-- types that tell'
ply() {
	printf 'ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n'
	printf "property $1 %s\n" red green blue
	printf 'end_header\n0 0 0 %s\n' "$2"
}
rgb() {
	mr-import -q "$@" | mr-export -q -f ply-ascii - | sed '1,/end_header/d'
}
ply uchar '1 0 1' | rgb
ply ushort '65535 32896 127' | rgb
ply char '-1 1 127' | rgb
ply uchar '300 0 -1' | mr-import 2>&1 >/dev/null

echo '-- of a PCD: a negative whole number, alpha, and what is no colour'
pcd() {
	printf 'VERSION .7\nFIELDS x y z %s\nSIZE 4 4 4 %s\nTYPE F F F %s\nWIDTH 1\nHEIGHT 1\nDATA ascii\n0 0 0 %s\n' "$@"
}
pcd rgb 4 I -16711423 | rgb
pcd rgba 4 U 2147549441 | rgb
pcd rgba 4 U 66051 | rgb
pcd rgb 8 U 66051 | mr-import | mr-info | grep -o 'rgb'

echo '-- alpha that a format has not'
pcd rgba 4 U 2147549441 | mr-import 2>&1 >alpha.mrs
printf 'COFF\n1 0 0\n0 0 0 1 1 1 128\n' | mr-import -q -o alpha.mrs
for format in xyz pts obj; do
	mr-export -f $format -i alpha.mrs out 2>&1
done
echo '-- colours that are no numbers'
printf 'x y z red green blue\n0 0 0 1 nan 0\n' | mr-import 2>&1 >/dev/null
printf '3\n1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n3 0 0 0\n1 0 0 0 0 nan 1\n2 0 0\n' >c.ptx
mr-import c.ptx 2>&1 >/dev/null
echo '-- points of a PTX without a colour beside one that has it'
sed 's/nan/0.5/' c.ptx | mr-import -q | mr-export -q -f ply-ascii - | sed '1,/end_header/d'
echo '-- seven columns that could be read either way' >&2
printf '0 0 0 12 200 100 50\n1 0 0 30 200 100 50\n0 1 0 99 200 100 50\n' >seven.pts
mr-import seven.pts >/dev/null
{ echo '# x y z intensity red green blue'; cat seven.pts; } >named.pts
mr-import named.pts | mr-export -q -f xyz -

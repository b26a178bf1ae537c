# Real models: out and in again, in text and in binary, every bit of every column comes back.
[ -d "$DATA/meshes" ] || exit 77
differ() { # file, file
	! cmp -s "$1" "$2" && echo "$format: ${file##*/} differs"
}
n=0
for file in "$DATA"/meshes/*.* "$DATA"/points/*.*; do
	n=$((n + 1))
	[ $((n % SPARSE)) -eq 0 ] || continue
	[ "$(wc -c <"$file")" -lt 1000000 ] || continue
	case $file in
	*.mtl) continue ;;
	esac
	mr-import -q "$file" -o a.mrs || continue
	mr-export -q -i a.mrs -f ply a
	for format in ply-ascii; do
		mr-export -q -i a.mrs -f $format b
		mr-import -q b | mr-export -q -f ply c
		differ a c
	done
	format=obj # has no alpha, and no groups without faces: compared by what OFF keeps
	mr-export -q -i a.mrs -f obj b
	mr-export -q -i a.mrs -f off a
	mr-import -q b | mr-export -q -f off c
	differ a c
done
echo done

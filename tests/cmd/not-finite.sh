# A number that is not finite goes into no file, and into no column that a tool makes.
mr-make sphere --points 300 -o points.mrs
python3 - <<'END' # the normal of point 4 without its last number, and the checksum of that
import records, struct
def inf(layer, name, shape, rows, data):
    if (layer, name) == (b"points", b"normal"):
        data = data[:4 * 24 + 16] + struct.pack("<d", float("inf")) + data[5 * 24:]
    return layer, name, shape, rows, data
open("inf.mrs", "wb").write(records.changed(open("points.mrs", "rb").read(), inf))
END
mr-cat --no-history inf.mrs | cmp - inf.mrs && echo 'what is only passed on stays'
for format in obj ply ply-ascii stl off xyz pts pwn glb; do
	mr-export -f $format out <inf.mrs 2>err
	echo "$format: exit $?, $(ls out 2>/dev/null | wc -l) files, $(cut -d: -f2- err)"
done
mr-transform --scale 2 inf.mrs >out
mr-cat out 2>/dev/null >&2 || echo 'no whole stream'
mr-crop --keep above:x,0.2 inf.mrs >out
mr-normals inf.mrs | mr-export -f xyz - | grep -ciE 'inf|nan'

echo '-- coordinates of corners: none, or finite'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 7.5 0\nvt 1 1\nvt 0 1\nvt 1 0\nf 1/1 2/2 3/3\nf 1/4 3 2/3\n' >corners.obj
mr-import -q corners.obj -o corners.mrs && mr-export -f obj - -i corners.mrs | grep -c vt
python3 - <<'END'
import records, struct
def inf(layer, name, shape, rows, data):
    if name == b"corner_texcoord":
        data = data.replace(struct.pack("<d", 7.5), struct.pack("<d", float("inf")), 1)
    return layer, name, shape, rows, data
stream = open("corners.mrs", "rb").read()
open("corners.mrs", "wb").write(records.changed(stream, inf))
END
mr-export -f obj - -i corners.mrs
mr-info --check corners.mrs | grep -o 'mesh: column.*'

echo '-- what a float does not hold'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1e300 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\n' >far.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 1e300 0 0\nf 1//1 2//1 3//1\n' >steep.obj
for model in far steep; do
	mr-import $model.obj -o model.mrs
	for format in obj ply-ascii off glb; do
		mr-export -f $format out -i model.mrs 2>err
		echo "$format: exit $?, $(cut -d: -f2- err)"
	done
done
exit 0

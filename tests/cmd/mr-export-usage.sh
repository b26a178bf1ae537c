# Wrong command lines: exit 2, nothing on stdout.
mr-make cube -n 100 -o cube.mrs
export_cube() {
	mr-export -i cube.mrs "$@"
	echo "exit $?" >&2
}
export_cube
export_cube a.obj b.obj
export_cube a.nonsense
export_cube a
export_cube -f nonsense a.obj
export_cube a.las
export_cube -
export_cube 'a%x.obj'
export_cube -o a.obj -f obj -
export_cube --float a.obj
export_cube --no-normals a.obj
export_cube --quantize a.ply
export_cube --compress a.ply
export_cube --lods a.ply
export_cube --lods 'a%d.glb'
ls a.* 2>/dev/null
mr-cat cube.mrs cube.mrs | mr-export two.obj
echo "exit $?" >&2
mr-cat cube.mrs cube.mrs | mr-export 'name-%s.obj'
echo "exit $?" >&2
mr-cat cube.mrs cube.mrs | mr-export 'name-%s-%d.obj'
ls name-*
echo '-- frames with odd names' >&2
mkdir odd && cd odd || exit
for name in - . ..; do
	mr-export -f obj -i ../cube.mrs - >"$name.obj"
	mr-import "./$name.obj" | mr-export -f off %s
done
ls -A

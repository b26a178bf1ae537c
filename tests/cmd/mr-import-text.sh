# Lines, rows and columns of text: what is not as it was counted is refused or said.
try() {
	printf "$1" | mr-import -q $2 >out.mrs 2>err && mr-export -q -i out.mrs -f ply-ascii - | sed '1,/^element/d; /_header/d'
	sed "s/^mr-import: stdin: //" err
}
said() {
	printf "$1" | mr-import 2>&1 >/dev/null
}
ply='ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n'
face='element face 1\nproperty list uchar int vertex_indices\n'
echo '-- rows of a PLY end with their lines'
try "${ply}end_header\n0 0 0 255\n1 0 0 255\n"
try "${ply}${face}end_header\n0 0 0\n1 0 0\n3 0 1 0 7\n"
try "${ply}end_header\n0 0\n0\n1 0 0"
echo '-- CR LF and LF end lines'
try '1 2 3 # one\n4 5 6\n'
try '1 2 3\r\n4 5 6\r\r\n7 8 9\n'
printf 'ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\nproperty uchar z\nend_header\n\r\r\r' >lf.ply
mr-import lf.ply | mr-export -f xyz -
echo '-- a binary STL may begin with anything'
python3 - <<'END'
import struct
for name, mark in ("utf8.stl", b"\xef\xbb\xbf"), ("utf16.stl", b"\xff\xfe"):
    open(name, "wb").write(mark.ljust(80) + struct.pack("<I12fH", 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0))
END
for file in utf8 utf16; do
	mr-import $file.stl | mr-export -f obj - | grep ^f
done
echo '-- an empty cell is no column less'
try '1,,3,4\n5,6,,8\n'
try '1, ;3,4\n'
try ',1,2,3\n'
try '1,2,3,\n5,6,7,\n'
try ',,x,y,z\n7,8,1,2,3\n'
echo '-- names and columns'
said '# x y z of points\n1 2 3\n'
try 'x y z of points\n1 2 3\n'
try '//X Y Z R G B Scalar field Nx Ny Nz\n0 0 0 9 9 9 0.5 0 0 1\n'
try '//X Y Z R G B I\n2\n0 0 0 9 9 9 0.5\n1 0 0 9 9 9 0.5\n'
try '"x","y","z","Scalar field","Scalar field #2"\n0,0,0,1,2\n'
echo '-- several clouds of a PTS'
try '2\n0 0 0 9 1 2 3\n1 0 0 9 1 2 3\n1\n2 0 0 9 1 2 3\n'
echo '-- words that are no numbers'
for word in nan -NaN 'nan(ind)' inf -Infinity infra nancy 1.#x; do
	try "1 2 3 0.5\n1 2 3 $word\n" | grep -v property
	printf 'OFF\n1 0 0\n0 0 %s\n' "$word" | mr-import 2>&1 >/dev/null
done
echo '-- rows beyond the count'
said "${ply}end_header\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n\n"
said "${ply}end_header\n0 0 0\n1 0 0\n\n"
pcd='VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 1\nDATA ascii\n'
said "${pcd}0 0 0\n1 0 0 7 8\n2 0 0\n"
said "${pcd}0 0 0\n1 0 0\n# end\n\n"
said 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n'
said 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 # a face\n# end\n'
echo '-- normals are known from colours by their length'
try '0 0 0 0.5 0.25 1 0 0 1\n1 0 0 0 0 1 0 0.6 0.8\n'
try '0 0 0 0 0 1 0.5 0.25 1\n1 0 0 0 0.6 0.8 0 0 1\n'
try '0 0 0 0.5 0.25 1 1 2 3\n'
try '0 0 0 9 0 1 0 0 1\n'
said '0 0 0 0.5 0.25 1\n1 0 0 0 0 1\n'
said '0 0 0 0 0.6 0.8\n1 0 0 0 0 1\n2 0 0 0 0 0\n'
said '# x y z red green blue\n0 0 0 1 0.2 1\n1 0 0 0 0 1\n'
said '0 0 0 0.1 0.2 0.3 0 0 2\n1 0 0 0.5 0.5 0.5 0 3 4\n'
echo '-- zeros that have a name are kept'
try 'x y z label\n0 0 0 0\n1 0 0 0\n'
try '0 0 0 0\n1 0 0 0\n'
echo '-- infinities of a column are no nan'
try '4 0 0 1\n0 0 0 -inf\n1 0 0 inf\n2 0 0 nan\n3 0 0 +Infinity\n'
echo '-- an OFF without its keyword'
printf '3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >bare.off
mr-import -f off bare.off | mr-export -f off -
mr-import <bare.off 2>&1 | strings -n 20 | tail -n 1
echo '-- an STL of several statements a line, and of a facet without its normal'
printf 'solid a facet\nfacet normal 0 0 1 outer loop vertex 0 0 1 vertex 1 0 1\rvertex 0 1 1 endloop endfacet\nFACET\nNORMAL 0 0 1 OUTER\nLOOP\nvertex 0 0 1 7\nvertex 1 0 1\nvertex 0 1 2\nendloop endfacet endsolid facet\n' >lines.stl
mr-import lines.stl | mr-export -q -f obj -
printf 'solid\nfacet\nouter loop\nvertex 0 0 1 vertex 1 0 1 endloop' | mr-import -f stl - 2>&1 >/dev/null
echo '-- an OFF with its texture coordinates behind its colours, and one that is not known'
printf 'CSTOFF\n3 1 0\n0 0 0 255 0 0 255 .5 .25\n1 0 0 255 0 0 255 1 1\n0 1 0 1 2 3 4 1 0\n3 0 1 2\n' | mr-import -f off - | mr-export -f ply-ascii - | grep '^[01] '
printf 'NCOFF\n1 0 0\n0 0 0\n' | mr-import -f off - 2>&1 >/dev/null

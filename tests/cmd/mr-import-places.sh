# Points without a place are left out and counted, with their faces, in every format; where all are, the file is refused.
python3 - <<'END'
import struct
nan = float("nan")
rows = [(nan, nan, nan) if (i * 7) % 5 == 0 else (0.5 * (i % 10), 0.25 * (i // 10), 1.5) for i in range(50)]
head = "VERSION .7\nFIELDS x y z normal_x normal_y normal_z rgb label\nSIZE 4 4 4 4 4 4 4 4\nTYPE F F F F F F U U\n" \
    "COUNT 1 1 1 1 1 1 1 1\nWIDTH 10\nHEIGHT 5\nPOINTS 50\nDATA %s\n"
with open("binary.pcd", "wb") as f:
    f.write((head % "binary").encode())
    for i, p in enumerate(rows):
        f.write(struct.pack("<6fII", *p, *((0, 0, 1) if p[0] == p[0] else p), i, 5))
with open("text.pcd", "w") as f:
    f.write(head % "ascii")
    for i, p in enumerate(rows):
        f.write("%r %r %r %s %d 5\n" % (*p, "0 0 1" if p[0] == p[0] else "nan nan nan", i))
head = "ply\nformat binary_little_endian 1.0\nelement vertex 5\n" + "".join(
    "property %s\n" % p for p in ("float x", "float y", "float z", "float nx", "float ny", "float nz", "uchar red", "uchar green", "uchar blue"))
places = [(0, 0, 0), (nan, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
data = b"".join(struct.pack("<6f3B", *p, 0, 0, nan if p[0] != p[0] else 1, 1, 2, i) for i, p in enumerate(places))
open("points.ply", "wb").write((head + "end_header\n").encode() + data)
faces = b"".join(struct.pack("<B%di" % len(c), len(c), *c) for c in ((0, 2, 3), (2, 4, 3), (0, 1, 2, 3), (1, 2, 3)))
open("faces.ply", "wb").write((head + "element face 4\nproperty list uchar int vertex_indices\nend_header\n").encode() + data + faces)
open("nan.stl", "wb").write(bytes(80) + struct.pack("<I", 2) + struct.pack("<12fH", 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
    + struct.pack("<12fH", 0, 0, 1, 1, 0, 0, 1, nan, 0, 0, 1, 0, 0))
END
printf 'v 0 0 0\nv 1 0 0\nv nan 0 0\nv 0 1 0\nv 1 1 inf\nf 1 2 4\nf 1 2 5 4\nf 1 3 4\n' >in.obj
printf 'NOFF\n4 2 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\nnan nan nan nan nan nan\n3 0 1 2\n3 1 3 2\n' >in.off
printf '3\n2\n1 2 3\n1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 5 1\n1 1 1 0.25\n0 0 0 0\n1 2 1 0.5\n0 0 0 0.5\n1 3 1 1\n2 3 1 1\n' >in.ptx
printf 'nan nan nan 0 0 0\n1 2 3 200 100 50\nnan nan nan nan nan nan\n2 2 3 200 100 51\n' >in.xyz
printf 'x,y,z,label\n1,2,3,4\n,,,\n2,3,4,5\n' >in.csv
for file in binary.pcd text.pcd points.ply faces.ply nan.stl in.obj in.off in.ptx in.xyz in.csv; do
	echo "-- $file"
	mr-import -f "$(case $file in in.csv) echo xyz ;; *) echo "${file##*.}" ;; esac)" $file 2>said | mr-export -q -f ply-ascii - | sed '/^ply\|^format\|^property\|^end/d' | head -n 8
	grep -o 'points without.*' said | tr -d '[]'
done
echo '-- none is left'
printf 'nan nan nan\nnan 0 0\n' | mr-import 2>&1
printf 'v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | mr-import 2>&1 >/dev/null

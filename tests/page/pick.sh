# A click on a known place tells the vertex that is there, its numbers as the stream has them; of a million triangles in
# 50 ms.
. "$TOP/tests/page/begin"
python3 - <<'X'
import math
# A body whose corner 0 looks at the eye, far from the origin; and three points.
d = [x / math.sqrt(0.5 ** 2 + 0.35 ** 2 + 1) for x in (0.5, 0.35, 1)]
r = [d[2] / math.hypot(d[0], d[2]), 0, -d[0] / math.hypot(d[0], d[2])]
u = [d[1] * r[2] - d[2] * r[1], d[2] * r[0] - d[0] * r[2], d[0] * r[1] - d[1] * r[0]]
corners = [d, r, u, [-x for x in r], [-x for x in u], [-x for x in d]]
faces = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (5, 2, 1), (5, 3, 2), (5, 4, 3), (5, 1, 4)]
with open("body.ply", "w") as f:
    f.write("ply\nformat ascii 1.0\nelement vertex 6\nproperty double x\nproperty double y\nproperty double "
        "z\nproperty double quality\n"
            "element face 8\nproperty list uchar int vertex_indices\nproperty double worth\nend_header\n")
    for i, c in enumerate(corners):
        f.write("%.17g %.17g %.17g %g\n" % (c[0] + 500000, c[1] + 4000000, c[2] - 300000, i + 0.25))
    for i, face in enumerate(faces):
        f.write("3 %d %d %d %g\n" % (*face, 10 * i))
with open("three.xyz", "w") as f:
    f.write("0 0 0\n1 0 0\n0 1 0.5\n")
X
mr-import body.ply -o body.mrs && mr-view -i body.mrs body.html || exit
mr-import three.xyz -o three.mrs && mr-view -i three.mrs three.html || exit
mr-make bumpy -n 8000 | mr-smooth | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 |
	mr-encode -o bumpy.mrs || exit
mr-view -l mesh -i bumpy.mrs bumpy.html || exit
mr-make sphere -n 1000000 -o million.mrs && mr-view -i million.mrs million.html || exit
exec python3 "$TOP/tests/page/pick.py"

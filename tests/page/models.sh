# Real models, far from the origin, with colours, non-manifold, in 122 parts, clouds: each is drawn without a word.
. "$TOP/tests/page/begin"
[ -d "$DATA/meshes" ] || { echo "no real models"; exit 77; }
for file in meshes/bunny00.off.gz meshes/boeing.off meshes/cactus.off meshes/beetle.obj meshes/dodecahedron_poly.obj \
	meshes/1002_tray_bottom.STL.gz \
	meshes/colored_tetra.ply points/urban.las points/point_set_3.xyz.gz points/spheres.ply; do
	name=$(basename "${file%%.*}")
	mr-import -q "$DATA/$file" -o model.mrs && mr-view -q -i model.mrs "$name.html" || exit
done
exec python3 "$TOP/tests/page/models.py" *.html

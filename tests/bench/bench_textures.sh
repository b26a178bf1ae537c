# Textured meshes with fewer faces, ours beside meshoptimizer's simplifyWithAttributes at the same number: the mean absolute difference of
# pictures from six sides, laid over with the same grid of squares, from the original's (texture_yardstick.c).  The peer is measured as it is
# by default, which keeps seams and may leave more faces than asked for, and `Permissive`.
# Knobs: MODELS (files of $DATA/meshes), RATIOS (default 0.25 0.1 0.03), MESHOPTIMIZER (the folder of the npm package; without it, or without
# node, ours alone).
MESHOPTIMIZER=${MESHOPTIMIZER:-$BUILD/node_modules/meshoptimizer}
[ -d "$MESHOPTIMIZER" ] && command -v node >/dev/null ||
    echo "no meshoptimizer: npm install --prefix $BUILD meshoptimizer" >&2
texture_yardstick grid grid.png || exit
judge() { # case, who, simplified
	mr-cat -q mesh.mrs "$3" -o both.mrs
	for view in front back left right top bottom; do
		mr-render -q -l mesh --same --sheet --columns 2 --no-labels --size 400x400 --view $view --texture grid.png both.mrs $view.png
	done
	echo "$1 $2 $(texture_yardstick compare front.png back.png left.png right.png top.png bottom.png) of-255"
}
compare() { # case, ratio, flags
	case=$1 ratio=$2
	shift 2
	if faces=$(node "$TOP/tests/bench/peer_textures.mjs" "$MESHOPTIMIZER" mesh.glb peer.glb "$ratio" "$@" 2>err); then
		mr-import -q peer.glb -o peer.mrs
		mr-simplify -q -n "$faces" mesh.mrs -o ours.mrs
		judge "$case" meshoptimizer peer.mrs
	else
		mr-simplify -q -r "$ratio" mesh.mrs -o ours.mrs
	fi
	judge "$case" mr ours.mrs
}
for file in ${MODELS:-spot.obj.gz fuze.obj pirate.obj.gz camel_b.obj chair_model.obj.gz spider.obj WusonOBJ.obj}; do
	[ -f "$DATA/meshes/$file" ] || { echo "no model $file in $DATA/meshes" >&2; continue; }
	name=${file%%.*}
	mr-import -q --repair --weld auto "$DATA/meshes/$file" -o mesh.mrs && mr-export -q mesh.mrs mesh.glb || exit
	for ratio in ${RATIOS:-0.25 0.1 0.03}; do
		compare "$name-$ratio" "$ratio"
		compare "$name-$ratio-permissive" "$ratio" Permissive
	done
done

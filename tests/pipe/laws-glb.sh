# GLB: what is read of a file is written again as the same bytes; another program, where it is there, reads the same
# surface.
fail=0
bad() {
	echo "$*"
	fail=1
}
figure() { # name, of the JSON on stdin
	grep -o "\"$1\":[^,}]*" | head -n 1 | cut -d : -f 2
}

mr-make sphere -n 300 --texcoords -o sphere.mrs
mr-make torus -n 500 --texcoords | mr-export torus.obj
sed 's/^\(f .*\)/\1/; 0,/^f /s//o ring\nusemtl gold\nf /' torus.obj >named.obj
mr-import named.obj -o torus.mrs
mr-make bumpy -n 2500 -o bumpy.mrs
mr-make knot --points 100 -o knot.mrs
models='sphere torus bumpy knot'
for model in spot.obj.gz spider.obj chair_model.obj.gz quadknot.obj mesh_with_colors.off pirate.obj.gz; do
	[ -n "$DATA" ] || continue
	mr-import -q "$DATA/meshes/$model" -o "${model%%.*}.mrs"
	models="$models ${model%%.*}"
done

for model in $models; do
	mr-export -q -i $model.mrs $model.glb
	mr-import -q $model.glb -o back.mrs
	mr-export -q -i back.mrs back.glb
	mr-import -q back.glb | mr-export -q -f obj - >twice.obj
	mr-export -q -i back.mrs -f obj - >once.obj
	cmp -s once.obj twice.obj || bad "$model: read twice, it is another"
	mr-compare --samples 10000 --json $model.mrs <back.mrs >distance 2>&1 || bad "$model: $(cat distance)"
	awk -v d="$(sed 's/.*"both_relative":{"hausdorff"://; s/[,}].*//' distance)" 'BEGIN { exit !(d < 1e-6) }' ||
	    bad "$model: $(cat distance)"
done

# Every corner of a face has its coordinates, wherever they are stored.
corners() { # OBJ
	awk '/^v / { p[++n] = $2 " " $3 " " $4 } /^vt / { t[++m] = $2 " " $3 }
		/^f / { for (i = 2; i <= 4; i++) { split($i, k, "/"); print p[k[1]], t[k[2]] } }' "$1"
}
for model in sphere torus ${DATA:+spot}; do
	mr-export -q -i $model.mrs a.obj
	mr-import -q $model.glb | mr-export -q b.obj
	corners a.obj >a
	corners b.obj >b
	paste -d ' ' a b | awk '{ for (i = 1; i <= 5; i++) if ($i - $(i + 5) > 1e-6 || $(i + 5) - $i > 1e-6) exit bad = 1 }
		END { exit bad || NR == 0 || NF != 10 }' || bad "$model: corners differ"
done

# Frames in one file.
mr-smooth bumpy.mrs | mr-select --free all --fixed below:y,0.3 --handle 0=above:y,0.7 | mr-solve --basis | mr-encode |
    mr-pose --rotate 0,0,1,30 --frames 4 | mr-decode | mr-export poses.glb
mr-cat sphere.mrs bumpy.mrs | mr-export several.glb
models="$models poses several"

if command -v assimp >/dev/null; then
	for model in $models; do
		[ $model = knot ] || assimp info $model.glb >info 2>&1 || { bad "assimp does not read $model.glb"; continue; }
		case $model in knot | poses | several | chair_model) continue ;; esac # of the chair it drops faces without area
		faces=$(mr-info --json --no-intersections $model.mrs | figure faces)
		read=$(awk '/^Faces:/ { print $2 }' info)
		[ "$faces" = "$read" ] || bad "assimp reads $read faces of $model.glb, not $faces"
	done
	assimp export torus.glb theirs.obj >/dev/null 2>&1
	grep -q '^usemtl gold' theirs.obj || bad 'assimp finds no material gold'
	mr-import -q --weld 0 theirs.obj | mr-compare --json torus.mrs >distance
	awk -v d="$(sed 's/.*"both_relative":{"hausdorff"://; s/[,}].*//' distance)" 'BEGIN { exit !(d < 1e-5) }' ||
	    bad "assimp's torus is elsewhere: $(cat distance)"
	assimp export torus.obj theirs.glb >/dev/null 2>&1 && mr-import -q theirs.glb | mr-compare --json torus.mrs >distance
	awk -v d="$(sed 's/.*"both_relative":{"hausdorff"://; s/[,}].*//' distance)" 'BEGIN { exit !(d < 1e-5) }' ||
	    bad "the torus that assimp writes is elsewhere: $(cat distance)"
	grep -q '^Animations:  *1' info || assimp info poses.glb 2>&1 | grep -q '^Animations:  *1' || bad 'assimp finds no animation'
fi

exit $fail

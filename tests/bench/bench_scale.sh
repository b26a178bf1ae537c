# The whole pipeline on large scans: seconds and peak memory of each step, and what the remeshing and the detail are like.
figure() { # name, file: a number of a line of JSON, the last of that name
	grep -o "\"$1\":[^,}]*" "$2" | tail -n 1 | cut -d : -f 2
}
edit() { # model, file, order of the solve
	mr-import --stats import.json "$2" -o 0.mrs && mr-smooth --stats smooth.json 0.mrs -o 1.mrs &&
	    mr-remesh --stats remesh.json 1.mrs -o 2.mrs &&
	    mr-select --free all --fixed below:y,0.3 --handle 0=above:y,0.8 --stats select.json 2.mrs -o 3.mrs &&
	    mr-encode --stats encode.json 3.mrs -o 5.mrs &&
	    mr-pose --rotate 0,1,0,30 5.mrs -o 6.mrs && mr-solve -k ${3:-2} --stats pose.json 6.mrs -o 7.mrs &&
	    mr-decode --stats decode.json 7.mrs -o 8.mrs || exit
	for step in import smooth remesh select encode pose decode; do
		echo "$1-$step mr $(figure seconds $step.json) s"
	done
	for step in import smooth remesh select encode pose decode; do
		figure peak_bytes $step.json
	done | sort -n | tail -n 1 | awk -v m="$1" '{ print m "-memory mr " $1 / 1e6 " MB" }'
	mr-info --json --no-intersections -l base 2.mrs >base.json || exit
	echo "$1: $(figure vertices remesh.json) base vertices, area error $(figure voronoi_error base.json)," \
	    "angle error $(figure angle_error base.json), valence 6 $(figure valence6 base.json)," \
	    "heights $(figure heights encode.json), offsets $(figure offsets encode.json), rcond $(figure rcond pose.json)," \
	    "folded edges $(figure folded remesh.json)," \
	    "flipped triangles $(figure flipped remesh.json)," \
	    "remeshing $(figure peak_bytes remesh.json) bytes"
}
mr-make bumpy -n 200000 -o bumpy.mrs && mr-export bumpy.ply -i bumpy.mrs && edit bumpy-400k bumpy.ply
real() { # model, file, order
	[ ! -f "$DATA/meshes/$2" ] || edit "$1" "$DATA/meshes/$2" "$3"
}
real igea igea.ply.gz 2
real dragon dragon_vrip.ply.gz 2
real embryo ct_embryo_A_1.1M.ply.gz 1 # its thousands of slivers are too much for the thin plate

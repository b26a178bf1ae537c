# What benches share: to be sourced.

# Of $DATA, the files to measure: $MODELS (patterns of names in $DATA/meshes, default all); without that directory, shapes of mr-make.
every_model() { # shapes
	if [ -d "$DATA/meshes" ]; then
		set -f # the patterns are for find
		for pattern in ${MODELS:-*}; do
			find "$DATA/meshes" -type f -name "$pattern" ! -name '*.mtl'
		done | sort -u
		set +f
		return
	fi
	for shape; do
		mr-make "$shape" | mr-export "$shape.ply" && echo "$PWD/$shape.ply"
	done
}

# Of a model the name, if it can be imported, to $out/models/NAME.mrs and .json (what mr-info says), and has the figures.
sound_model() { # file, figures of the JSON
	name=$(basename "$1" .gz)
	[ -e "$out/models/$name.mrs" ] || mr-import -q --repair "$1" -o "$out/models/$name.mrs" 2>/dev/null || return
	[ -e "$out/models/$name.json" ] || mr-info -q --json "$out/models/$name.mrs" >"$out/models/$name.json" || return
	shift
	for figure; do
		grep -q "$figure" "$out/models/$name.json" || return
	done
	echo "$name"
}

is_old() { # row, what it depends on
	row=$1
	shift
	[ ! -e "$row" ] || [ -n "$(find "$@" -newer "$row")" ]
}
timed() { # command line, for $LIMIT seconds: leaves err, $code, $seconds
	begin=$(date +%s.%N)
	timeout -k 5 "$LIMIT" sh -c "$1" 2>err
	code=$?
	seconds=$(echo "$(date +%s.%N) $begin" | awk '{ print $1 - $2 }')
}

# Pictures $out/NAME-a.png, ... of 40 each of the results in $out/results/NAME that are named on stdin and there, under NAME's
# line of the file `table`.
sheets() { # name
	rm -f "$out/$1"-*.png
	(cd "$out/results/$1" && while read -r result; do [ ! -e "$result" ] || echo "$result"; done) | split -l 40 -a 1 - page-
	for page in page-*; do
		(cd "$out/results/$1" && mr-cat $(cat "$OLDPWD/$page")) | mr-render --sheet --columns 8 --size 240x220 -c harm \
		    "$out/$1-${page#page-}.png"
	done
	rm page-*
}

# The Python that has Open3D, or nothing.
python_of_open3d() {
	for python in python3 /usr/bin/python3; do
		"$python" -c 'import open3d' 2>/dev/null && echo "$python" && return
	done
}

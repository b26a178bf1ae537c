# A layer of the library includes itself and the layers below it, nothing else; a foreign library has one place.
cd "$TOP" || exit
fail=0

# file:include, for each include of the sources
includes() {
	grep -rnE '^[ \t]*#[ \t]*include[ \t]*[<"]' --include='*.c' --include='*.h' --include='*.cc' "$@" |
	    sed -E 's/^([^:]*):[0-9]*:[^<"]*[<"]([^>"]*)[>"].*/\1:\2/'
}

# The rooms, in the order of the table in lib/README.md.
rooms=$(sed -nE 's/^\| `([a-z]+)` .*/\1/p' lib/README.md | tr '\n' ' ')
for room in lib/*/; do
	case " $rooms" in *" $(basename "$room") "*) ;; *) echo "$room is not in lib/README.md"; fail=1 ;; esac
done
house="($(echo $rooms | tr ' ' '|')|formats|cmd)/"
# What each may include of the house.
check() { # directory, pattern of what it may include
	bad=$(includes "$1" | grep -E ":($house|cmd\.h|options\.h)" | grep -vE ":($2)")
	[ -z "$bad" ] || { echo "$1 includes what is above it:"; echo "$bad"; fail=1; }
}
below=
for layer in $rooms; do
	below="$below${below:+|}$layer/"
	check lib/$layer "$below"
done
check formats "$below|formats/"

# Within a room there is an order, too: no circle of files, but for a source, its header and the private ones between
# them.
for room in $rooms; do
	bad=$(includes lib/$room | sed -nE "s|^lib/$room/([a-z0-9_]+)\.[a-z]+:$room/([a-z0-9_]+)\.h\$|\1 \2|p" | awk '
		$1 != $2 { reaches[$1, $2] = 1; file[$1]; file[$2] }
		END {
			for (k in file) for (i in file) if ((i, k) in reaches)
				for (j in file) if ((k, j) in reaches) reaches[i, j] = 1
			for (i in file) {
				circle = ""
				for (j in file) if ((i, j) in reaches && (j, i) in reaches) circle = circle " " j
				if (split(circle, files, " ") > 3) print circle
			}
		}' | head -n 1)
	[ -z "$bad" ] || { echo "lib/$room: files that include each other in a circle:$bad"; fail=1; }
done

# So do the rooms of the page, the modules beside them see all.
climbs() { # room, pattern of the rooms it may import from
	bad=$(grep -nE 'from "\.' formats/page/$1/*.js | grep -vE "from \"(\./[a-z_]+|\.\./($2)/[a-z_]+)\.js\"")
	[ -z "$bad" ] || { echo "formats/page/$1 imports what is above it:"; echo "$bad"; fail=1; }
}
climbs library none
climbs stream library
climbs mesh 'library|stream'
climbs draw 'library|stream|mesh'
climbs deform 'library|stream|mesh|draw'
climbs paint 'library|stream|mesh|draw'

# Quoted includes name their layer, so that the rule can be seen: no file beside the file, no climbing.
bad=$(grep -rnE '^[ \t]*#[ \t]*include[ \t]*"' --include='*.[ch]' --include='*.cc' lib formats |
	grep -vE "\"(${house}([a-z]+/)*[a-z0-9_]+\.(h|inc)|mr\.h)\"")
[ -z "$bad" ] || { echo "an include that does not name its layer:"; echo "$bad"; fail=1; }

# A header that says it is private to its room is included by that room alone.
for header in $(grep -l 'Private to this room' lib/*/*.h); do
	room=${header%/*} name=${header#lib/}
	bad=$(includes lib formats cmd | grep ":$name\$" | grep -v "^$room/")
	[ -z "$bad" ] || { echo "$header is private to $room:"; echo "$bad"; fail=1; }
done

# Foreign libraries: header, where it may be included.
foreign() {
	bad=$(includes lib formats cmd | grep -E ":($1)" | grep -vE "^($2):")
	[ -z "$bad" ] || { echo "$1 belongs to $2:"; echo "$bad"; fail=1; }
	places=$(includes lib formats cmd | grep -cE ":($1)")
	[ "$places" -le "$3" ] || { echo "$1 is included in $places places, not $3"; fail=1; }
}
foreign 'cholmod.*' 'lib/solve/[a-z_]+\.[ch]' 1
foreign 'camd.*' 'lib/solve/[a-z_]+\.[ch]' 1
foreign 'umfpack.*' 'lib/solve/[a-z_]+\.[ch]' 1
foreign 'flann/.*' 'lib/space/near_shim\.cc' 2
foreign 'zlib\.h' 'lib/stream/[a-z0-9_]+\.[ch]|formats/[a-z_]+\.[ch]' 4
foreign 'dmumps_c\.h' 'lib/solve/mumps\.c' 1
foreign 'mpi\.h' 'lib/solve/mumps\.c|cmd/mpi\.c' 2
foreign 'png\.h' '(lib/render|formats)/[a-z_]+\.[ch]' 1
foreign 'jansson\.h' 'formats/gltf\.h' 1
foreign 'jpeglib\.h' 'formats/jpeg\.c' 1
foreign 'tiny_obj_loader\.h' 'formats/obj_shim\.cc' 1
foreign 'meshoptimizer\.h' 'formats/(gltf_meshopt\.c|meshopt_shim\.cc)' 2
foreign 'draco/.*' 'formats/draco_shim\.cc' 1

# The shims and the numbers of text are the only C++ of the tools; and nothing outside the tests is in another language.
for f in $(find lib formats cmd -name '*.cc' -o -name '*.cpp' -o -name '*.cxx' -o -name '*.hpp'); do
	case $f in
	formats/draco_shim.cc | formats/meshopt_shim.cc | formats/obj_shim.cc) ;;
	formats/numbers.cc | lib/space/near_shim.cc) ;;
	*) echo "$f: C++"; fail=1 ;;
	esac
done

# The top level is the house's.
extra=$(git ls-files 2>/dev/null | cut -d/ -f1 | sort -u |
    grep -vxE 'Makefile|cmd|lib|formats|tests|examples|man|README\.md|LICENSE|\..*')
[ -z "$extra" ] || { echo "top level: $extra"; fail=1; }

# A file opens by what it does, or whose method it is.
for f in lib/*.h lib/*/*.[ch] formats/*.[ch] cmd/*.[ch]; do
	head -c 2 "$f" | grep -qF '/*' || { echo "$f opens without a sentence"; fail=1; }
done

# Files that a person can hold in mind.
long=$(find lib formats cmd tests -name '*.[ch]' -exec wc -l {} + |
    awk '$2 != "total" && $1 > ($2 == "lib/mr.h" ? 1050 : 950)') # it has all tools
[ -z "$long" ] || { echo "over 950 lines: $long"; fail=1; }
long=$(wc -l cmd/mr-*.c | awk '$2 != "total" && $1 > 160')
[ -z "$long" ] || { echo "a command with more than options and calls in it: $long"; fail=1; }
exit $fail

# models.sh -- real models for the examples: `model NAME` and `cloud NAME` print a file to import.
# They are those of Debian's package libcgal-demo, fetched and unpacked into ./cache, not installed.  Where it cannot be
# had, or MR_SMALL=N asks for it, a generated model (of N vertices) takes the place of each.

fetch_models() {
	[ ! -d cache/points_3 ] || return 0
	[ -z "$MR_SMALL" ] || return 1
	echo "fetching models (libcgal-demo, 24 MB)"
	(
		root=
		[ "$(id -u)" -eq 0 ] || root=sudo
		cd cache && mkdir -p unpacked &&
		    { apt-get download -q=2 libcgal-demo || { $root apt-get update -qq && apt-get download -q=2 libcgal-demo; }; } &&
		    dpkg-deb -x libcgal-demo_*.deb unpacked && rm libcgal-demo_*.deb &&
		    tar -xzf unpacked/usr/share/doc/libcgal-dev/data.tar.gz data/meshes data/points_3 &&
		    rm -rf unpacked meshes && mv data/meshes data/points_3 . && rmdir data
	) 2>cache/fetch.log
}

mkdir -p cache
if fetch_models; then
	# The armadillo turns its back on the eye: it is turned about y, digit for digit.
	mkdir -p cache/turned
	awk 'function minus(x) { return x ~ /^-/ ? substr(x, 2) : "-" x }
		NR > 2 && NF == 3 { $1 = minus($1); $3 = minus($3) } 1' cache/meshes/armadillo.off >cache/turned/armadillo.off
	model() { [ -e "cache/turned/$1.off" ] && echo "cache/turned/$1.off" || echo "cache/meshes/$1.off"; }
	cloud() { [ -e "cache/points_3/$1.xyz" ] && echo "cache/points_3/$1.xyz" || model "$1"; }
else
	echo "no models: the package libcgal-demo cannot be had here; a generated one takes their place"
	mr-make bumpy ${MR_SMALL:+-n $MR_SMALL} -o cache/bumpy.mrs
	model() { mr-export "cache/$1.off" <cache/bumpy.mrs && echo "cache/$1.off"; }
	cloud() { model "$1"; }
fi

# models.sh -- real models for the examples: `model NAME` and `cloud NAME` print a file to import.
# They are those of Debian's package libcgal-demo, fetched and unpacked into ./cache, not installed.  Where it cannot be
# had, with NOSETUP, or where MR_SMALL=N asks for it, $real is empty and every name means a creature that mr-make
# makes (of N vertices).

fetch_models() {
	[ ! -e cache/points_3/kitten.xyz ] || [ -e cache/unpacked ] || return 0
	[ -z "$MR_SMALL$NOSETUP" ] || return 1
	echo "fetching models (libcgal-demo, 24 MB)"
	(
		root=
		[ "$(id -u)" -eq 0 ] || root=sudo
		cd cache && mkdir -p unpacked &&
		    { apt-get download -q=2 libcgal-demo || { $root apt-get update -qq &&
		    	apt-get download -q=2 libcgal-demo; }; } &&
		    dpkg-deb -x libcgal-demo_*.deb unpacked && rm libcgal-demo_*.deb &&
		    tar -xzf unpacked/usr/share/doc/libcgal-dev/data.tar.gz --strip-components=1 \
		    	data/meshes/bunny00.off \
			data/meshes/armadillo.off data/meshes/elephant.off data/meshes/lion-head.off \
				data/points_3/kitten.xyz &&
		    rm -r unpacked
	) 2>cache/fetch.log
}

mkdir -p cache
real=
if fetch_models; then
	real=yes
	# The armadillo turns its back on the eye: it is turned about y, digit for digit.
	mkdir -p cache/turned
	awk 'function minus(x) { return x ~ /^-/ ? substr(x, 2) : "-" x }
		NR > 2 && NF == 3 { $1 = minus($1); $3 = minus($3) } 1' cache/meshes/armadillo.off \
			>cache/turned/armadillo.off
	model() { [ -e "cache/turned/$1.off" ] && echo "cache/turned/$1.off" || echo "cache/meshes/$1.off"; }
	cloud() { [ -e "cache/points_3/$1.xyz" ] && echo "cache/points_3/$1.xyz" || model "$1"; }
else
	echo "no real models here: a creature that mr-make makes takes their place"
	mr-make bumpy ${MR_SMALL:+-n $MR_SMALL} | mr-export cache/creature.off
	model() { echo cache/creature.off; }
	cloud() { model "$1"; }
fi

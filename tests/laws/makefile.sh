# A changed header rebuilds what includes it and nothing else; changed flags rebuild everything; a staged install is
# whole; make help-all tells of every target.
command -v make >/dev/null || { echo "no make"; exit 77; }
here=$PWD
cd "$TOP" || exit
fail=0
make() { command make --no-print-directory BUILD="${BUILD#"$TOP"/}" SAN="$SAN" "$@"; }

if make -n all | grep -q ' -c -o '; then
	echo "the sources have changed since they were built"
	exit 77
fi
make help-all >"$here/help" 2>&1
for target in $(sed -n 's/^\.PHONY: \(all units help help-all \)*//p' Makefile .ci/*.mk); do
	grep -q "^make $target  *[^ ]" "$here/help" || { echo "make help-all does not tell of $target"; fail=1; }
done
would=$(make -n -W lib/space/bvh.h all | grep -oE '[^ ]*\.cc?$' | sort -u)
for source in $(echo "$would"); do
	grep -qs 'lib/space/bvh.h' "$BUILD/$source.d" "$BUILD/wasm/$source.d" ||
		{ echo "rebuilt without reason: $source"; fail=1; }
done
for source in $(grep -lE 'include "space/bvh.h"' lib/*/*.c cmd/*.c); do
	case " $(echo $would) " in
	*" $source "*) ;;
	*) echo "not rebuilt: $source"; fail=1 ;;
	esac
done
again=$(make -n -W lib/space/bvh.h BUILD="$(realpath --relative-to=. "$BUILD")" all | grep -oE '[^ ]*\.cc?$' | sort -u)
[ "$again" = "$would" ] || { echo "another way to spell BUILD rebuilds something else"; fail=1; }

make DESTDIR="$here/stage" PREFIX=/usr install >"$here/log" 2>&1 || { cat "$here/log"; exit 1; }
for source in cmd/mr-*.c; do
	tool=$(basename "$source" .c)
	[ -x "$here/stage/usr/bin/$tool" ] || { echo "not installed: $tool"; fail=1; }
	[ -f "$here/stage/usr/share/man/man1/$tool.1" ] || { echo "not installed: $tool.1"; fail=1; }
	grep -q -- --help "$here/stage/usr/share/bash-completion/completions/$tool" ||
		{ echo "no completion: $tool"; fail=1; }
done
[ -f "$here/stage/usr/share/man/man7/mr.7" ] || { echo "not installed: mr.7"; fail=1; }
# What solves nothing loads no solver, which takes longer than a small frame does.
for tool in mr-cat mr-import mr-remesh mr-simplify mr-shrinkwrap mr-subdivide mr-decode mr-export; do
	ldd "$BUILD/bin/$tool" | grep -q cholmod && { echo "$tool loads CHOLMOD"; fail=1; }
done
exit $fail

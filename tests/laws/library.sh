# The library as a stranger has it: installed, one header, in C and in C++, linked either way; what it gives is what
# the pipe gives; and it can be taken away again.
[ -z "$SAN" ] || { echo "a library with sanitizers is not for programs without"; exit 77; }
prefix=$PWD/usr
export PKG_CONFIG_PATH="$prefix/lib/pkgconfig" LD_LIBRARY_PATH="$prefix/lib"
build() {
	make -s -C "$TOP" BUILD="$BUILD" PREFIX="$prefix" "$@" >make.log 2>&1 || { cat make.log; exit 1; }
}
bad() {
	echo "$@"
	exit 1
}
build install

warn='-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror'
cc -std=c11 $warn "$TOP/examples/bend.c" $(pkg-config --cflags --libs mr) -o bend || exit
c++ -std=c++17 $warn -x c++ "$TOP/examples/bend.c" -x none $(pkg-config --cflags --libs mr) -o bend++ || exit
cc -std=c11 "$TOP/examples/bend.c" -I"$prefix/include" "$prefix/lib/libmr.a" \
	$(pkg-config --static --libs mr | sed 's/-lmr\b//') -o bend-static || exit

# The header stands alone, and takes nothing away from who includes it.
printf '#include <mr.h>\n#include <string.h>\n#include <stdlib.h>\n%s\n' \
	'int main(void) { char s[4]; strcpy(s, "1"); return atoi(s) != 1; }' >alone.c
cc -std=c11 $warn alone.c $(pkg-config --cflags mr) -o alone && ./alone || bad "mr.h poisons"
[ "$(ls "$prefix/include")" = mr.h ] || bad "installed headers: $(ls "$prefix/include")"

# Exported is what mr.h declares, and nothing else.
nm -D --defined-only "$prefix/lib/libmr.so" | awk '{ print $3 }' | sort >exported
sed -nE 's/^MR_API [^(]*[ *](mr_[a-z_0-9]+)\(.*/\1/p; /^MR_API [^(]*$/{ n; s/^[ \t]*(mr_[a-z_0-9]+)\(.*/\1/p; }' \
	"$prefix/include/mr.h" | sort >declared
diff declared exported || bad "libmr.so does not export what mr.h declares"
sed -n 's/^ \(.*\)@Base .*/\1/p' "$TOP/.debian/libmr1.symbols" | diff - exported ||
	bad ".debian/libmr1.symbols does not list what libmr.so exports"

mr-make bumpy -n 3000 | mr-export model.obj
mr-import model.obj | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.5 --handle 1=above:y,0.85 |
	mr-encode | mr-pose -H 1 --rotate 0,0,1,30 | mr-solve | mr-decode | mr-export pipe.obj
for program in bend bend++ bend-static; do
	./$program model.obj $program.obj || exit
	cmp pipe.obj $program.obj || bad "$program differs from the pipe"
done
./bend absent.obj x.obj 2>err && bad "bend reads what is not there"
grep -q absent.obj err || bad "no sentence: $(cat err)"

# Pictures too.
cat >draw.c <<'END'
#include <mr.h>
int main(void)
{
	mr_ctx *ctx = mr_ctx_new(0);
	mr_frame *f;
	return mr_import(ctx, "pipe.obj", NULL, &f, NULL) < 0 || mr_render(ctx, f, NULL, "drawn.png") < 0;
}
END
cc -std=c11 $warn draw.c $(pkg-config --cflags --libs mr) -o draw && ./draw && mr-import pipe.obj |
	mr-render tool.png || exit
cmp drawn.png tool.png || bad "mr_render draws something else"

build uninstall
left=$(find "$prefix" -type f -o -type l)
[ -z "$left" ] || bad "uninstall leaves $left"

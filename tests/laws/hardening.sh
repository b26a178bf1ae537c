# What is linked: tools with their addresses at random, tables of the linker that nobody writes to, no stack that can be
# run, checked stacks and copies where they were asked for; nothing that opens a connection or starts a program; and
# nothing at all where the machine is not the stream's.
[ -z "$SAN" ] || { echo "a sanitizer has checks of its own"; exit 77; }
command -v readelf >/dev/null && command -v nm >/dev/null || { echo "no readelf"; exit 77; }
fail=0
bad() {
	echo "$*"
	fail=1
}

check() { # file
	readelf -hldW "$1" >elf
	grep -q 'Type: *DYN' elf || bad "$1 stands at an address that is known"
	grep -q GNU_RELRO elf && grep -q BIND_NOW elf || bad "$1: the linker's tables can be written to"
	grep -q 'GNU_STACK.* RW ' elf || bad "$1: its stack can be run"
	nm -D --undefined-only "$1" | awk '{ sub(/@.*/, "", $2); print $2 }' >calls
	case $(cat "$BUILD/flags") in *-fstack-protector*) grep -qx __stack_chk_fail calls ||
		bad "$1: its stack is not checked" ;; esac
	case $(cat "$BUILD/flags") in *-D_FORTIFY_SOURCE*) grep -q '_chk$' calls ||
		bad "$1: its copies are not checked" ;; esac
	network='socket|socketpair|connect|bind|listen|accept4?|send(to|msg)?|recv(from|msg)?|getaddrinfo|gethostby.*'
	called=$(grep -xE "$network|(v?fork|clone)|exec[lv].*|fexecve|posix_spawnp?|system|popen|wordexp|dlopen" calls)
	[ -z "$called" ] || bad "$1 calls $(echo $called)"
}
for tool in "$BUILD"/bin/mr-*; do
	check "$tool"
done
for library in "$BUILD"/libmr.so*[0-9]; do
	check "$library"
done
# Machines that are refused: as this compiler can be told, and by theirs where these are installed.
refused() { # what the sentence says, compiler
	says=$1
	shift
	"$@" -std=c11 -D_POSIX_C_SOURCE=200809L -I"$TOP/lib" -fsyntax-only -x c "$TOP/lib/stream/record.h" 2>err &&
		bad "$1 is not refused"
	grep -q "$says" err || bad "$1: no reason: $(cat err)"
}
refused 'values are used as they stand in the stream' cc -Wno-builtin-macro-redefined \
	-D__BYTE_ORDER__=__ORDER_BIG_ENDIAN__
refused 'is for machines of 64 bits' cc -Dsize_t=unsigned
for compiler in s390x-linux-gnu-gcc powerpc64-linux-gnu-gcc; do
	! command -v $compiler >/dev/null || refused 'values are used as they stand in the stream' $compiler
done
for compiler in arm-linux-gnueabihf-gcc i686-linux-gnu-gcc; do
	! command -v $compiler >/dev/null || refused 'is for machines of 64 bits' $compiler
done
exit $fail

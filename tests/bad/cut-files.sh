# A file that is cut off while it is read: one sentence that says so, exit 1, whatever was mapped of it.
bad() { echo "$*"; exit 1; }
[ -z "$SAN" ] || { echo "a sanitizer has signals of its own"; exit 77; }

# Streams: the output is not taken until the input, which is larger than a pipe, has been cut.
mr-make sphere -n 60000 -o one.mrs
cut_while() { # bytes left, command
	left=$1
	shift
	cat one.mrs one.mrs one.mrs one.mrs >big.mrs
	mkfifo pipe
	"$@" >pipe 2>err &
	exec 3<pipe
	head -c 64 <&3 >/dev/null
	truncate -s $left big.mrs
	cat <&3 >/dev/null
	exec 3<&-
	wait $!
	code=$?
	rm pipe
	[ $code = 1 ] || bad "$*, cut to $left: exit $code: $(cat err)"
	[ "$(wc -l <err)" = 1 ] || bad "$*, cut to $left: $(cat err)"
	grep -q "cut off\|checksum" err || bad "$*, cut to $left: $(cat err)"
}
size=$(wc -c <one.mrs)
for left in 0 64 4096 $((size + 5000)) $((3 * size + 100000)) $((3 * size + 409600)); do
	cut_while $left mr-cat --no-history big.mrs
	cut_while $left mr-cat -z big.mrs
	cut_while $left mr-transform --translate 1,0,0 big.mrs
	cut_while $left mr-smooth -m taubin big.mrs
done

# gzip: a last member that is cut anywhere; zeros behind it are nothing.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >a.obj
gzip -n <a.obj >a.gz
n=$(wc -c <a.gz)
cat a.gz a.gz >two.obj.gz
k=1
while [ $k -lt $n ]; do
	head -c $((n + k)) two.obj.gz >cut.obj.gz
	mr-import cut.obj.gz >out 2>err && bad "$k bytes of the second member are not missed"
	grep -q 'end early' err || bad "$k bytes: $(cat err)"
	k=$((k + 1))
done
{ cat two.obj.gz; head -c 512 /dev/zero; } >zeros.obj.gz
mr-import zeros.obj.gz >out 2>err && [ ! -s err ] || bad "zeros: $(cat err)"

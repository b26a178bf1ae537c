# --stats: the file gets its name at the end, and is neither an input nor the output.
mr-make plane -n 50 -o a.mrs
cp a.mrs b.mrs
cp a.mrs kept.mrs
refused() {
	"$@" <"${input:-/dev/null}" >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err | sed "s,$PWD/,,")"
	cmp a.mrs kept.mrs
}
refused mr-cat --stats a.mrs a.mrs
refused mr-cat --stats ./a.mrs b.mrs a.mrs
input=a.mrs refused mr-cat --stats a.mrs
refused mr-compare -i a.mrs --stats a.mrs b.mrs
refused mr-import --stats a.mrs a.mrs
refused mr-cat --stats b.mrs -o ./b.mrs a.mrs
refused mr-cat --stats new -o "$PWD/new" a.mrs
refused mr-export -i a.mrs --stats new.ply new.ply
mr-cat --stats /dev/stdout a.mrs 2>&1 | head -n 1
refused mr-cat --stats no/such/folder/s a.mrs
refused mr-cat --stats /dev/full -o out.mrs a.mrs

# What fails leaves the old file as it was.
echo old >old.json
refused mr-cat --stats old.json a.mrs no-such.mrs
cat old.json

# Devices, links and what is open already are written to as they are.
first() {
	cut -d, -f1-3
}
mr-cat --stats /dev/null -o /dev/null a.mrs
mr-cat --stats /dev/stderr -o /dev/null a.mrs 2>&1 | first
mr-cat --stats - -o /dev/null a.mrs 2>&1 | first
{
	echo before
	mr-cat --stats /dev/stdout -o /dev/null a.mrs
	mr-export -i a.mrs --stats /dev/stdout out.ply
	echo after
} >log
first <log
ln -s old.json link.json
mr-cat --stats link.json -o /dev/null a.mrs b.mrs
first <old.json
mr-make sphere --stats sphere -o /dev/null
first <sphere
ls
# A file that is there keeps its mode; so does an output.
chmod 640 old.json && cp a.mrs mode.mrs && chmod 600 mode.mrs
mr-cat --stats old.json -o mode.mrs a.mrs
ls -l old.json mode.mrs | cut -c1-10

# The peak is the tool's own, not that of the program which starts it.
python3 -c 'import os; much = b"x" * 300000000; os.execvp("mr-cat", ["mr-cat", "--stats", "peak", "-o", "/dev/null", "a.mrs"])'
grep -o '"peak_bytes":[0-9]*' peak | awk -F: '{ print ($2 > 1e6 && $2 < 2e8 ? "a peak of its own" : $2) }'

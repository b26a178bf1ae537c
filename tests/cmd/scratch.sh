# Large memory in files: the same bytes, whatever reads and writes, and nothing is left in the folder.
[ -z "$SAN" ] || { echo "millions of points take minutes with sanitizers"; exit 77; }
mkdir scratch
n=2800000
mr-make torus -n 100 --points $n -o cloud.mrs
both() { # command: the same with and without
	"$@" >good && "$@" --scratch scratch >out && cmp good out && echo "$1: the same"
}
both mr-make torus -n 100 --points $n
# Zeros are packed in no time.
{
	printf 'ply\nformat binary_little_endian 1.0\nelement vertex %d\n' $n
	printf 'property double %s\n' x y z
	echo end_header
	head -c $((24 * n)) /dev/zero
} >cloud.ply
both mr-import cloud.ply
mv good zeros.mrs
gzip -1 <cloud.ply >cloud.ply.gz
both mr-import cloud.ply.gz
both mr-cat -z zeros.mrs
mv good packed.mrs
both mr-cat -u packed.mrs
both mr-crop --keep spaced:0.05 cloud.mrs
mr-crop --keep spaced:0.05 <cloud.mrs >good
cat cloud.mrs | mr-crop --scratch scratch --keep spaced:0.05 | cmp - good && echo 'from a pipe: the same'
ls -A scratch
mr-import --scratch nowhere cloud.ply >out
echo "exit $?, $(wc -c <out) bytes"
ulimit -v 400000
mr-make torus -n 100 --points 30000000 >out
echo "exit $?, $(wc -c <out) bytes"

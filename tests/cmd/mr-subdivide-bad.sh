# Wrong command lines, and meshes that cannot be subdivided: no output.
refused() {
	mr-subdivide "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes"
	head -n 1 err
}
mr-make sphere -n 42 -o sphere.mrs
refused -n -1 sphere.mrs
refused -n 16 sphere.mrs
refused -n x sphere.mrs
refused --crease 181 sphere.mrs
refused --crease nan sphere.mrs
refused -l base sphere.mrs
refused -n 15 sphere.mrs
printf '0 0 0\n1 0 0\n0 1 0\n' >cloud.xyz
mr-import cloud.xyz -o cloud.mrs
refused cloud.mrs
for faces in '0 1 2,0 1 3,0 1 4' '0 1 2,0 1 3' '0 1 2,0 3 4' '0 1 1,1 2 3'; do
	{
		echo OFF
		echo "5 $(echo "$faces" | awk -F, '{ print NF }') 0"
		printf '0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 -1\n'
		echo "$faces" | tr ',' '\n' | sed 's/^/3 /'
	} >bad.off
	mr-import bad.off -o bad.mrs
	refused bad.mrs
done
head -c 2000 sphere.mrs >cut.mrs
mr-subdivide cut.mrs >out 2>err
echo "exit $?: $(cat err)"

echo 'with -k a frame that fails leaves the others as they are'
mr-cat sphere.mrs bad.mrs sphere.mrs | mr-subdivide -k -o kept.mrs 2>err
echo "exit $?: $(cat err)"
mr-subdivide sphere.mrs | mr-export -f off - >alone.off
mr-export -i kept.mrs kept-%d.off
for f in kept-*.off; do
	cmp "$f" alone.off && echo "$f same"
done
echo 'detail goes with the vertices that had it'
mr-smooth sphere.mrs | mr-encode | mr-subdivide --longest 0.2 2>&1 >finer.mrs

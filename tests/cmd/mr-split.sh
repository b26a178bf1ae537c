# Parts of surfaces and clouds, largest first; put together again they are what they were.
figures() { # of one frame
	mr-split --stats stats.json "$@" >out.mrs
	echo "$* exit $?: $(sed 's/.*\("parts".*\)}/\1/' stats.json | tr -d '"')"
}
mr-make boxes --genus 2 -n 2000 -o boxes.mrs
mr-make sphere -n 500 -o sphere.mrs
mr-make torus -n 900 | mr-transform --translate 4,0,0 -o torus.mrs
mr-cat --append sphere.mrs torus.mrs -o two.mrs

echo 'surfaces'
figures boxes.mrs
figures two.mrs
figures --least 501 two.mrs
mr-split two.mrs | mr-info | grep -E 'frame|mesh:|topology'
mr-split two.mrs | mr-cat --append | mr-export again.off
mr-import again.off | mr-split | mr-cat --append | mr-export third.off
cmp again.off third.off && echo 'the same'

echo 'clouds: two balls'
{
	mr-make sphere --points 3000
	mr-make sphere --points 1000 | mr-transform --scale 0.5 --translate 1.8,0,0
} >balls.mrs
mr-cat --append balls.mrs -o cloud.mrs
figures cloud.mrs
figures --distance 0.01 cloud.mrs
figures --distance 0.5 cloud.mrs
figures --distance 20% --least 1 cloud.mrs
mr-split cloud.mrs | mr-shrinkwrap -r 6 -m cube | mr-cat --append | mr-info | grep -E 'frame|control:|topology'

echo 'colours, names and polygons go with their rows'
cat >cubes.obj <<'OBJ'
g far
v 5 0 0 1 0 0
v 6 0 0 1 0 0
v 6 1 0 1 0 0
v 5 1 0 1 0 0
f 1 2 3 4
g near
v 0 0 0 0 0 1
v 1 0 0 0 0 1
v 1 1 0 0 0 1
f 5 6 7
OBJ
mr-import cubes.obj | mr-split | mr-export part-%d.obj
cat part-1.obj part-2.obj
mr-import cubes.obj | mr-split | mr-cat --append | mr-export all.obj
cat all.obj

echo 'what is left out is said'
mr-smooth boxes.mrs | mr-split -l base >out.mrs

echo 'and what refers to it goes with it'
mr-smooth boxes.mrs | mr-remesh | mr-encode -o encoded.mrs
for layer in mesh base; do
	mr-split -q -l $layer encoded.mrs | mr-info --check >out; echo "$layer: exit $?"
done

echo 'refusals'
refused() {
	mr-split "$@" >out 2>err
	echo "exit $?, $(wc -c <out) bytes: $(head -n 1 err)"
}
refused --distance -1 cloud.mrs
refused --distance x cloud.mrs
refused --least -1 cloud.mrs
refused --distance 1 boxes.mrs
refused --least 3001 cloud.mrs
refused -l base cloud.mrs
printf '0 0 0\n' >one.xyz
mr-import one.xyz | mr-split | mr-info | head -n 1

echo 'vertices without a face are no parts, unless they are asked for'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 6 6 6\nf 1 2 3\n' >stray.obj
mr-import -q stray.obj | mr-split 2>&1 >out.mrs
mr-export -f ply-ascii 'stray-%d.ply' <out.mrs && ls stray-*
mr-import -q stray.obj | mr-split -n 1 | mr-info | grep -c '^stray'

echo 'parts have the names of all, and together they have them once'
for i in 1 2 3; do printf 'o o%s\nusemtl m%s\nv %s 0 0\nv %s 1 0\nv %s 0 1\nf -3 -2 -1\n' $i $((i % 2)) $i $i $i; done >named.obj
mr-split named.obj -o named.mrs && mr-export -f obj 'named-%d.obj' <named.mrs && grep -h '^o \|^usemtl' named-*.obj
mr-cat --append named.mrs | mr-export -f obj - | grep '^o \|^usemtl'

# Files that a command reads and writes, under one name or two: none is lost.
mr-make sphere -n 100 -o s.mrs
mr-make torus -n 100 --texcoords -o t.mrs
mr-export -q -i t.mrs t.obj
mr-render -q -s 20x20 -i t.mrs t.png
mr-smooth s.mrs | mr-select --free all --handle 0=above:z,0.8 | mr-encode -o e.mrs
printf '1 0 0 0  0 1 0 0  0 0 1 0\n' >matrix
printf '1\n2\n' >vertices
printf 'frame\n0 translate=1,0,0\n' >script
mkdir kept
cp s.mrs t.mrs e.mrs t.obj t.png matrix vertices script kept
refused() { # command line
	eval "$1" >stdout
	echo "exit $?, $(wc -c <stdout) bytes"
	for file in kept/*; do
		cmp "$file" "${file#kept/}"
	done
}
echo 'what is read' >&2
refused 'mr-info -o t.obj t.obj'
refused 'mr-info -o s.mrs <s.mrs'
refused 'mr-compare -o t.mrs s.mrs t.mrs'
refused "mr-export -i t.obj '%s.obj'"
refused 'mr-export -i t.obj ./t.obj'
refused 'mr-transform --matrix matrix -o matrix s.mrs'
refused 'mr-select --free all --fixed vertices:vertices -o vertices s.mrs'
refused 'mr-select --free all --fixed vertices:vertices --stats vertices s.mrs'
refused 'mr-pose --script script -o script e.mrs'
refused 'mr-render --texture t.png -i t.mrs t.png'
refused 'mr-view --texture t.png --stats t.png -i t.mrs page.html'
echo 'what is written' >&2
refused "mr-export -i s.mrs --stats 1.obj '%d.obj'"
echo 'a protected file' >&2
[ "$(id -u)" -ne 0 ] || protect='setpriv --reuid=65534 --clear-groups --inh-caps=-all'
chmod a+rwx .
cp s.mrs protected && chmod a=r protected
$protect mr-cat -o protected t.mrs 2>&1 | grep -o 'protected.*'
cmp s.mrs protected
echo 'a stream in its own place' >&2
mr-smooth -o t.mrs t.mrs && mr-smooth -o s.mrs <s.mrs && mr-info t.mrs s.mrs | grep -c latest
echo 'standard output by its name' >&2
(echo first; mr-export -f off /dev/stdout <s.mrs; echo last) >log
grep -c -e first -e last -e OFF log
(echo first; mr-cat -o /dev/stdout s.mrs; mr-info -o /dev/stdout s.mrs; echo last) >log
grep -a -c -e first -e last -e mrmesh1 -e vertices log
echo 'a pipe by the name of a model' >&2
mkfifo pipe.ply
mr-export pipe.ply <s.mrs & mr-import pipe.ply | mr-info | grep vertices
wait
echo 'what is neither read nor a stream, and figures in the place of a stream or a model' >&2
echo precious >scene.fbx
cp s.mrs t.mrs t.obj scene.fbx kept
mr-export -q -i t.mrs t.txt
echo newmtl >t.mtl
cp t.txt t.mtl kept
refused 'mr-smooth -o scene.fbx t.mrs'
refused 'mr-smooth --stats t.obj -o out.mrs t.mrs'
refused 'mr-info --stats s.mrs t.mrs'
refused 'mr-smooth --stats s.mrs -o out.mrs t.mrs'
refused 'mr-smooth --stats s.mrs t.mrs'
refused 'mr-info -o t.obj t.mrs'
refused 'mr-compare -o s.mrs t.mrs t.mrs'
refused 'mr-info -o t.txt t.txt'
refused 'mr-export -f obj t.mtl -i t.mrs'
refused 'mr-export -f ply s.mrs -i t.mrs'
mr-info -o figures.txt t.mrs && mr-info -o figures.txt --stats figures.csv t.mrs && grep -c vertices figures.*
echo 'what mr-map reads' >&2
mr-make cube -n 8 | mr-export -q -f obj cube.obj
mr-make sphere -n 900 | mr-export -q sphere.obj
mr-import -q -l control cube.obj -o control.mrs
mr-import -q sphere.obj | mr-cat --merge - control.mrs | mr-sample -q -n 1 -o a.mtl
cp a.mtl b-height.png
cp a.mtl c.mtl
cp a.mtl b-height.png c.mtl kept
refused 'mr-map -w a a.mtl -o out.mrs'
refused 'mr-map -w b b-height.png -o out.mrs'
refused 'mr-map -w b a.mtl -o out.mrs'
refused 'mr-map -w c -o out.mrs <c.mtl'

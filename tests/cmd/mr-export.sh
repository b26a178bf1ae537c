# Layers, names, whole files.
same() { # what, file, file
	cmp "$2" "$3" && echo "ok $1" || echo "bad $1"
}
mr-make torus -n 300 -o torus.mrs
mr-make sphere -n 300 -o sphere.mrs

echo '-- every format that keeps doubles gives the positions back, bit for bit'
mr-export -i torus.mrs first.ply
mr-import first.ply -o first.mrs
for format in obj ply ply-ascii off; do
	mr-export -i first.mrs -f $format out
	mr-import out | mr-export -f ply second.ply
	same $format first.ply second.ply
done
mr-export -i first.mrs -f xyz - | sort >a
mr-export -i first.mrs -f stl-ascii - | sed -n 's/^vertex //p' | sort -u >b
same 'stl-ascii' a b

echo '-- patterns'
mr-cat sphere.mrs torus.mrs torus.mrs | mr-export 'out-%03d-%s.obj'
ls out-*
same 'the same frame' out-002-torus.obj out-003-torus.obj
mr-export -i torus.mrs '100%%.obj'
ls 100*

echo '-- the layer'
mr-make sphere -n 500 --points 50 | mr-export points.xyz
wc -l <points.xyz
mr-make knot --points 70 -o points.mrs
mr-cat --merge torus.mrs points.mrs >both.mrs
mr-export -i both.mrs -l points -f pts - | sed -n 1p
mr-export -i both.mrs -f off - | sed -n 1p

echo '-- what fails leaves no file, and an old one as it was'
echo precious >old.pwn
mr-export -i torus.mrs old.pwn
echo "exit $?"
cat old.pwn
mr-export -i torus.mrs new.pwn
echo "exit $?"
ls new.pwn* 2>/dev/null
mr-cat torus.mrs | head -c 3000 | mr-export cut.obj 2>/dev/null
echo "exit $?"
ls cut.obj* 2>/dev/null
head -c -64 torus.mrs >endless.mrs # all of the frame, but no END
mr-export -i endless.mrs cut.obj 2>/dev/null
echo "exit $?"
mr-export -i endless.mrs old.pwn 2>/dev/null
mr-cat torus.mrs torus.mrs | mr-export cut.obj 2>/dev/null
echo "exit $?"
ls cut.obj* 2>/dev/null
cat old.pwn
mr-export -i points.mrs points.stl
echo "exit $?"
mr-export -i torus.mrs -l control x.obj
echo "exit $?"
mr-export -i torus.mrs -f ply /dev/full
echo "exit $?"
mr-export -i torus.mrs no/such/folder.obj
echo "exit $?"

echo '-- a link stays one, and the file keeps its mode'
echo >real.obj
chmod 640 real.obj
ln -s real.obj link.obj
mr-export -i torus.mrs link.obj
ls -l real.obj | cut -c1-10
[ -L link.obj ] && head -c 2 real.obj && echo

echo '-- a layer without a vertex'
python3 - <<'X'
from records import START, END, frame, record
open("empty.mrs", "wb").write(START + frame(b"key empty", record(b"points", b"position", b"vd\3", 0)) + END)
open("none.mrs", "wb").write(START + END)
X
for suffix in obj ply off glb xyz pts pwn; do
	mr-export -i empty.mrs empty.$suffix || ls empty.$suffix 2>/dev/null
done
echo '-- a stream without a frame'
for out in one.obj %d.obj %d.glb; do
	mr-export -i none.mrs "$out"
	echo "exit $?"
done

echo '-- floats'
mr-make torus -n 50 --texcoords | mr-export --float small.ply
head -n 9 small.ply | grep -a property
mr-make torus -n 50 --texcoords | mr-export -f ply-float - | cmp - small.ply && mr-import small.ply | mr-info | grep -E 'vertices|texcoord'

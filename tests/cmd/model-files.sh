# Filters and sinks take a model's file where they take a stream's, as mr-import reads it.
mr-make torus -n 300 | mr-export torus.obj
mr-make torus --points 300 | mr-export cloud.ply.gz
mr-import torus.obj >torus.mrs
mr-smooth --no-history torus.mrs -o are.mrs
mr-smooth --no-history torus.obj | mr-export -l base -f off - >a.off
mr-export -l base -f off - <are.mrs | cmp - a.off && echo 'a filter'
mr-info torus.obj | sed -n '1,2p'
mr-info --json cloud.ply.gz torus.mrs torus.obj | grep -o '"name":"[a-z]*"'
mr-export -i torus.obj -f off - >b.off
mr-export -i torus.mrs -f off - | cmp - b.off && echo 'a sink'
mr-render -s 80x60 -i cloud.ply.gz cloud.png && echo 'a picture'
mr-cat --merge torus.mrs cloud.ply.gz | mr-info | grep -E '^  [a-z]*: [0-9]'

echo '-- two models'
mr-compare torus.obj torus.obj | head -n 1
mr-compare --json torus.obj cloud.ply.gz | grep -o '"a":"[a-z]*","b":"[a-z]*"'
mr-compare torus.mrs torus.obj >two
mr-compare torus.obj <torus.mrs | cmp - two && echo 'a stream and a model'
mr-cat torus.mrs torus.mrs | mr-compare torus.obj | grep -c frame
mr-compare -i torus.mrs torus.obj torus.obj
echo "exit $?"

echo '-- what is none'
cp torus.mrs stream.obj
mr-info stream.obj | head -n 1
printf 'v 1 2\n' >bad.obj
mr-info bad.obj
echo "exit $?"
mr-smooth missing.obj | mr-remesh | mr-export out.obj
echo "exit $?"
cp torus.obj kept.obj
mr-export -i kept.obj kept.obj
echo "exit $?"
cmp kept.obj torus.obj && echo kept

echo '-- a stream under gzip, and under its name' >&2
mr-make cube -n 8 | gzip >s.mrs.gz
mr-smooth s.mrs.gz -o out.mrs
mr-smooth <s.mrs.gz >out.mrs
ls out.mrs.gz 2>/dev/null
true

echo '-- with -k what cannot be read is left out'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >ok.obj
echo garbage >bad.obj
for tool in import smooth; do
	mr-$tool -k ok.obj bad.obj absent.obj ok.obj -o kept.mrs
	echo "exit $?, $(mr-info kept.mrs | grep -c '^ok: frame') frames"
	mr-$tool ok.obj bad.obj -o none.mrs
	echo "exit $?, $(ls none.mrs 2>/dev/null | wc -l) files"
done
